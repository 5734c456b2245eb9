"""Whether a number of grains can stand for a grading, and how near the drawn ones come to it."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.gradings.curves import grading_summary
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.mixtures import from_radii
from branchcrush.packings.geometry import UNIT_SPHERE

# The coarsest 10 % of the mass carry most of the load; few grains of them make a packing a sample
# of its own. A box of few diameters is made of its walls.
_REFUSED_GRAINS, _ENOUGH_GRAINS = 5, 10
_REFUSED_DIAMETERS, ENOUGH_DIAMETERS = 3, 5
_COARSE_SHARE = 0.1
# A truncated tail reaches far beyond its last grain: the largest is where this mass is finer.
_MASS_OF_LARGEST = 0.999


@dataclass(frozen=True)
class Representativity:
    """How well a number of grains stands for a grading, expected before they are drawn."""

    grains: int  # N
    coarse_grains: float  # expected in the coarsest 10 % of the mass [-]
    largest_diameter: float  # that 99.9 % of the mass is finer than [m]
    expected_largest_diameter: float  # of the largest of N grains drawn, the median [m]
    box_edge: float  # of a cube of N mean grains [m]
    grains_needed: int  # for no warning
    verdict: Literal["accept", "warn", "refuse"]
    message: str  # what it rests on

    @property
    def edge_over_diameter(self) -> float:
        """Edge of the box over the largest diameter, D99.9 [-]."""
        return self.box_edge / self.largest_diameter


def representativity(grading: Grading, grains: int, solid_fraction: float) -> Representativity:
    r"""Return whether N grains can stand for a grading in a box of a solid fraction.

    .. math:: N_{10} = N \,(1 - F_n(R_{90}^-)), \qquad
        L = \left(\frac{4 \pi N \langle R^3 \rangle}{3 \phi}\right)^{1/3}

    Of single sizes all grains of the size that 90 % of the mass end in are counted.

    Parameters
    ----------
    grading : Grading
    grains : int
        N.
    solid_fraction : float
        phi, at the end of the loading [-].

    Returns
    -------
    Representativity
        Refused below 5 grains in the coarsest 10 % of the mass or a box of 3 largest diameters,
        with a warning below 10 or 5.

    Examples
    --------
    >>> from branchcrush.gradings.forms import fractal
    >>> from branchcrush.gradings.mixtures import single
    >>> representativity(single(1e-3), 1000, 0.6).verdict
    'accept'
    >>> few = representativity(fractal(5e-6, 1e-3, 2.6), 1000, 0.74)
    >>> few.verdict, few.grains_needed > 1_000_000
    ('refuse', True)
    """
    # Of a grading that is narrower than rounding no grain is coarser: it has one size.
    coarse_share = _share_from(grading, grading.mass_ppf(1.0 - _COARSE_SHARE)) or _COARSE_SHARE
    diameter = 2.0 * float(grading.mass_ppf(_MASS_OF_LARGEST))
    bulk = UNIT_SPHERE * grading.moment(3) / solid_fraction
    edge = float(np.cbrt(grains * bulk))
    coarse = float(grains * coarse_share)
    needed = grains_needed(coarse_share, bulk / diameter**3)
    verdict: Literal["accept", "warn", "refuse"]
    if coarse < _REFUSED_GRAINS or edge < _REFUSED_DIAMETERS * diameter:
        verdict = "refuse"
    elif grains < needed:
        verdict = "warn"
    else:
        verdict = "accept"
    message = (
        f"{grains} grains put {coarse:.3g} grains in the coarsest 10 % of the mass and make a box "
        f"of {edge / diameter:.3g} largest diameters at solid fraction {solid_fraction:.3g}"
    )
    if verdict != "accept":
        judged = "too few for this grading" if verdict == "refuse" else "few for this grading"
        message += (
            f": {judged}; {_ENOUGH_GRAINS} grains and {ENOUGH_DIAMETERS} diameters need "
            f"{needed:.0f} grains, or a narrower grading"
        )
    return Representativity(
        grains=grains,
        coarse_grains=coarse,
        largest_diameter=diameter,
        expected_largest_diameter=2.0 * float(grading.number_ppf(0.5 ** (1.0 / grains))),
        box_edge=edge,
        grains_needed=int(needed),
        verdict=verdict,
        message=message,
    )


def grains_needed(coarse_share: ArrayLike, bulk_over_largest: ArrayLike) -> NDArray:
    r"""Return how many grains stand for a grading without a warning.

    .. math:: \max\left(\left\lceil \frac{10}{N_{10}/N} \right\rceil,
        \left\lceil 5^3 \frac{\phi D_{99.9}^3}{4 \pi \langle R^3 \rangle/3} \right\rceil\right)

    Parameters
    ----------
    coarse_share : array_like, shape (...)
        Share of the grains in the coarsest 10 % of the mass, N_10/N [-].
    bulk_over_largest : array_like, shape (...)
        Volume that a mean grain takes up, with its voids, over the cube of the largest diameter
        [-].

    Returns
    -------
    ndarray, shape (...)
        nan where there are no grains.

    Examples
    --------
    >>> grains_needed([0.1, 0.01], [1.0, 1.0]).tolist()
    [125.0, 1000.0]
    """
    # A whole number that rounding lifted a little needs no grain more.
    return np.maximum(
        np.ceil(_ENOUGH_GRAINS / np.asarray(coarse_share) * (1 - 1e-9)),
        np.ceil(ENOUGH_DIAMETERS**3 / np.asarray(bulk_over_largest) * (1 - 1e-9)),
    )


def realised_gap(grading: Grading, radii: ArrayLike) -> float:
    r"""Return the largest gap between the realised and the target sieve curve.

    .. math:: \max_r \left| F_{\mathrm{realised}}(r) - F(r) \right|

    Both sides of every step are looked at, so nothing between them is larger.

    Parameters
    ----------
    grading : Grading
        Target.
    radii : array_like, shape (N,)
        Radii of the grains [m].

    Returns
    -------
    float
        In percent finer by mass [%].

    Examples
    --------
    >>> from branchcrush.gradings.mixtures import from_radii
    >>> from branchcrush.gradings.forms import uniform
    >>> realised_gap(from_radii([1.0, 2.0]), [1.0, 2.0, 1.0, 2.0])
    0.0
    >>> realised_gap(uniform(1.0, 3.0), [3.0])
    100.0
    """
    realised, number = np.unique(np.asarray(radii, dtype=float), return_counts=True)
    volume = number * realised**3
    single, share = grading.discrete_part
    steps = np.union1d(realised, single)
    rise = _at(steps, realised, volume / volume.sum())
    rise_of_target = _at(steps, single, share * single**3 / grading.moment(3))
    after = grading.mass_cdf(steps) - np.cumsum(rise)
    before = after - rise_of_target + rise
    return 100.0 * float(np.abs([after, before]).max())


def representativity_report(
    standing: Representativity, grading: Grading, radii: Sequence[ArrayLike]
) -> dict[str, dict]:
    """Return what a packing of these grains stands for: expected, and realised by every seed.

    Parameters
    ----------
    standing : Representativity
    grading : Grading
        Target.
    radii : list of array_like
        Radii of each seed's grains [m].

    Returns
    -------
    dict
        target (diameters, coefficients and moments of the grading), realised (means of the same
        over the seeds) and representativity, with `warnings` to be repeated wherever results are.

    Examples
    --------
    >>> from branchcrush.gradings.mixtures import single
    >>> size = single(1e-3)
    >>> report = representativity_report(representativity(size, 1000, 0.6), size, [[1e-3, 1e-3]])
    >>> report["realised"]["D50_m"], report["representativity"]["largest_gap_percent_max"]
    (0.002, 0.0)
    """
    realised = [grading_summary(from_radii(seed)) for seed in radii]
    gaps = [realised_gap(grading, seed) for seed in radii]
    return {
        "target": grading_summary(grading),
        "realised": {
            key: float(np.mean([summary[key] for summary in realised])) for key in realised[0]
        },
        "representativity": {
            **asdict(standing),
            "edge_over_diameter": standing.edge_over_diameter,
            "largest_gap_percent_mean": float(np.mean(gaps)),
            "largest_gap_percent_max": float(np.max(gaps)),
            "warnings": [] if standing.verdict == "accept" else [standing.message],
        },
    }


def _share_from(grading: Grading, radius: float | NDArray) -> float:
    """Return the share of the number at a radius or above it."""
    single, share = grading.discrete_part
    above = grading.number_between(radius, grading.support()[1])
    return float(above + share[single == radius].sum())


def _at(steps: NDArray, radii: NDArray, values: NDArray) -> NDArray:
    """Return values at their radii among the steps, 0 at the others."""
    heights = np.zeros(steps.size)
    heights[np.searchsorted(steps, radii)] = values
    return heights
