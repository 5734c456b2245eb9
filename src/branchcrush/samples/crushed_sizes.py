"""Rule crushing_results: what the grains of a state are like beside the first ones."""

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from branchcrush.branches.mixing import mixing_path
from branchcrush.branches.random_contacts import random_contact_moment
from branchcrush.crushing.breakage import (
    SILT,
    crushing_parameter,
    einav_breakage,
    hardin_breakage,
)
from branchcrush.errors import FitError
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.forms import fractal
from branchcrush.gradings.mixtures import from_radii
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.samples.measured import EXPONENT
from branchcrush.statistics.power_law import power_law_fit

# Sizes over the largest first one at which percent finer is told, by the names of their columns.
SIZES: Mapping[str, float] = {"eighth": 0.125, "quarter": 0.25, "half": 0.5, "three_quarters": 0.75}
# Diameters at which grains are counted for alpha, and how wide their range must be.
_COUNTED, _RANGE = 16, 2.0
_BOTH_ENDS = np.array([0.0, 1.0])


class Crushable(NamedTuple):
    """What is asked of a sample whose grains break, as far as its results need it."""

    limit: float  # comminution limit: diameter of the finest grains that break [m]
    size_exponent: float  # b, strength goes as d^-b [-]
    ultimate_alpha: float  # of the ultimate grading, from the largest first grain to the limit [-]
    law: LinearContact | HertzContact

    def ultimate(self, first: Grading) -> Grading | None:
        """Return the fractal grading down to the limit, or None where no first grain is larger."""
        largest = first.support()[1]
        if largest <= self.limit / 2.0:
            return None
        return fractal(self.limit / 2.0, largest, self.ultimate_alpha)


def grading_row(first: NDArray, now: NDArray, sample: Crushable) -> dict[str, float]:
    """Return what the grains of a state are like beside the first ones.

    Parameters
    ----------
    first, now : ndarray, shape (N,)
        Radii [m].
    sample : Crushable

    Returns
    -------
    dict
        Breakage by every measure, phi_J, S and d_Q over its first value by rods, alpha, percent
        finer [-, %].
    """
    before, after = from_radii(first), from_radii(now)
    ultimate = sample.ultimate(before)
    largest = before.support()[1]
    ends = mixing_path(before, after, sample.law, crushing=_BOTH_ENDS)
    way = (before, after, sample.ultimate_alpha, largest)
    row = {
        "einav_breakage": np.nan,
        "einav_breakage_down_to_0": einav_breakage(*way),
        "crushing_by_random_contacts": np.nan,
        "hardin_breakage": hardin_breakage(before, after) if largest > SILT else np.nan,
        "number_exponent": number_exponent(2.0 * now, sample.limit, 2.0 * float(first.min())),
        "jamming_before": float(ends.solid_fraction[0]),
        "jamming_by_rods": float(ends.solid_fraction[1]),
        "stiffness_ratio": float(ends.modulus[1] / ends.modulus[0]),
        "contact_diameter_ratio": float(ends.contact_diameter[1] / ends.contact_diameter[0]),
    }
    if ultimate is not None:
        row["einav_breakage"] = einav_breakage(*way, sample.limit / 2.0)
        moments = [random_contact_moment(each, EXPONENT) for each in (before, after, ultimate)]
        row["crushing_by_random_contacts"] = crushing_parameter(*moments)
    finer = 100.0 * after.mass_cdf(largest * np.array(list(SIZES.values())))
    return row | {
        f"percent_finer_{name}": float(share) for name, share in zip(SIZES, finer, strict=True)
    }


def number_exponent(diameter: NDArray, low: float, high: float) -> float:
    r"""Return the exponent of the number of grains that are larger than a size.

    .. math:: N(> d) \sim d^{-\alpha}

    Counted at sizes between two, even in their logarithm; every size counts alike.

    Parameters
    ----------
    diameter : ndarray, shape (N,)
        [m]
    low, high : float
        Between which there are fragments alone: the comminution limit, and the smallest first
        grain [m].

    Returns
    -------
    float
        alpha [-]; nan where the range is narrower than a factor of 2.

    Examples
    --------
    >>> sizes = np.arange(1.0, 20001.0) ** -0.5  # the k-th largest is k^(-1/2)
    >>> round(number_exponent(sizes, 0.01, 0.1), 2)
    2.0
    """
    ordered = np.sort(diameter)
    return exponent_of_larger(
        lambda size: len(ordered) - np.searchsorted(ordered, size, side="right"), low, high
    )


def exponent_of_larger(larger: Callable[[NDArray], NDArray], low: float, high: float) -> float:
    """Return the exponent with which the number of larger grains falls between two sizes.

    Parameters
    ----------
    larger : callable
        Takes diameters [m] and returns how many grains are larger, or their share.
    low, high : float
        As for `number_exponent` [m].

    Returns
    -------
    float
        alpha [-]; nan where the range is narrower than a factor of 2.

    Examples
    --------
    >>> round(exponent_of_larger(lambda size: size**-2.5, 0.01, 0.1), 2)
    2.5
    """
    if not high > _RANGE * low:
        return float("nan")
    sizes = np.geomspace(low, high, _COUNTED)
    try:
        return -float(power_law_fit(sizes, np.asarray(larger(sizes), dtype=float)).exponent)
    except FitError:
        return float("nan")
