"""Which part of a grading a number of grains can stand for, where it cannot stand for all of it."""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.representativity import grains_needed, representativity
from branchcrush.packings.geometry import UNIT_SPHERE

# Ends looked at: evenly in the logarithm of radius, and in the mass.
_BY_SIZE, _BY_MASS, _ROUNDS = 60, 30, 2
# Halvings between two of them, which are a tenth apart: to three digits and a half.
_HALVINGS = 8
# Of a part without grains, which no number is enough for.
_NOTHING = 1e-200
# A range of no width is one size, and no narrower grading.
_LEAST_MASS = 0.01


class NarrowerRange(NamedTuple):
    """Radii between which a number of grains stands for a grading."""

    radius_min: float  # [m]
    radius_max: float  # [m]
    mass_share: float  # of the whole grading [-]
    number_share: float  # [-]

    def words(self, unit: str, metres: float, size: str = "diameter") -> str:
        """Return the range for a person who may paste its ends as `min` and `max`.

        Parameters
        ----------
        unit : str
            Name of the unit.
        metres : float
            That it has [m].
        size : {"diameter", "radius"}
            What sizes are.

        Returns
        -------
        str
            The ends to three digits, rounded inwards, since a wider range would need more grains.

        Examples
        --------
        >>> NarrowerRange(0.12345e-3, 0.5e-3, 0.931, 0.2).words("mm", 1e-3)
        'diameters 0.247 to 1 mm, 93 % of the mass'
        >>> NarrowerRange(1e-3, 1e-3, 0.5, 0.9).words("mm", 1e-3, "radius")
        'radius 1 mm, 50 % of the mass'
        """
        factor = (2.0 if size == "diameter" else 1.0) / metres
        low, high = _digits(factor * self.radius_min, 1), _digits(factor * self.radius_max, -1)
        if low < high:
            ends = f"{'diameters' if size == 'diameter' else 'radii'} {low:g} to {high:g} {unit}"
        else:
            ends = f"{size} {factor * self.radius_max:.3g} {unit}"
        return f"{ends}, {_percent(self.mass_share)} of the mass"


def narrower_range(grading: Grading, grains: int, solid_fraction: float) -> NarrowerRange | None:
    r"""Return the range of radii of most mass that N grains can stand for without a warning.

    .. math:: \max_{a, b} F(b) - F(a^-) \quad \text{with} \quad N(a, b) \le N

    N(a, b) is the number that `gradings.representativity` asks for of the grading cut at a and b.

    Parameters
    ----------
    grading : Grading
    grains : int
        N.
    solid_fraction : float
        phi, at the end of the loading [-].

    Returns
    -------
    NarrowerRange or None
        The whole range where N are enough for it. None where no part of a hundredth of the mass or
        more will do.

    Examples
    --------
    >>> from branchcrush.gradings.forms import fractal
    >>> part = narrower_range(fractal(5e-6, 1e-3, 2.6), 2000, 0.74)
    >>> 5e-6 < part.radius_min < part.radius_max <= 1e-3, part.mass_share < 1
    (True, True)
    """
    low, high = grading.support()
    if representativity(grading, grains, solid_fraction).verdict == "accept":
        return NarrowerRange(low, high, 1.0, 1.0)
    cuts = _Cuts(grading)

    def enough(pairs: NDArray) -> NDArray:
        needed = grains_needed(*cuts.standing(pairs, solid_fraction))
        return (grains >= needed) & (cuts.kept(pairs)[0] >= _LEAST_MASS)

    ends, best = _ends(grading, low, high), None
    highs = ends
    for _ in range(_ROUNDS):
        pairs = _lowest(ends, highs, enough)
        if not len(pairs):
            return best
        mass, number = cuts.kept(pairs)
        place = int(np.argmax(mass))
        best = NarrowerRange(*map(float, (*pairs[place], mass[place], number[place])))
        highs = _between(highs, best.radius_max)
    if best is not None and grading.is_discrete:
        # An end between two single sizes says no more than the size within it.
        single, _ = grading.discrete_part
        within = single[(single >= best.radius_min) & (single <= best.radius_max)]
        return best._replace(radius_min=float(within[0]), radius_max=float(within[-1]))
    return best


def narrower_words(
    grading: Grading,
    grains: int,
    solid_fraction: float,
    unit: str,
    metres: float,
    size: str = "diameter",
) -> str:
    """Return which narrower range grains that are too few could stand for, in the user's unit.

    Parameters
    ----------
    grading : Grading
    grains : int
    solid_fraction : float
        At the end of the loading [-].
    unit : str
    metres : float
        [m]
    size : {"diameter", "radius"}
        As for `NarrowerRange.words`.

    Returns
    -------
    str
        To be put behind the message of `gradings.representativity`; empty where there is none.

    Examples
    --------
    >>> from branchcrush.gradings.forms import fractal
    >>> narrower_words(fractal(5e-6, 1e-3, 2.6), 2000, 0.64, "mm", 1e-3)
    ': with 2000 grains diameters 0.497 to 2 mm, 49 % of the mass'
    """
    part = narrower_range(grading, grains, solid_fraction)
    return "" if part is None else f": with {grains} grains {part.words(unit, metres, size)}"


class _Cuts:
    """What is read off a grading for any part of it, without making the part a grading."""

    def __init__(self, grading: Grading) -> None:
        self.grading = grading
        self.largest = grading.support()[1]
        self.cube = grading.moment(3)

    def _at(self, radii: NDArray) -> tuple[NDArray, NDArray]:
        """Return the shares of mass and of number in grains of just these radii."""
        single, share = self.grading.discrete_part
        if not single.size:
            return np.zeros(radii.shape), np.zeros(radii.shape)
        place = np.minimum(np.searchsorted(single, radii), single.size - 1)
        number = np.where(single[place] == radii, share[place], 0.0)
        return number * radii**3 / self.cube, number

    def _above(self, radii: NDArray) -> NDArray:
        return self.grading.number_between(radii, self.largest)

    def kept(self, pairs: NDArray) -> tuple[NDArray, NDArray]:
        """Return the shares of mass and of number from each first radius to the second."""
        a, b = pairs.T
        mass_at, number_at = self._at(a)
        mass = self.grading.mass_cdf(b) - self.grading.mass_cdf(a) + mass_at
        return mass, self._above(a) - self._above(b) + number_at

    def standing(self, pairs: NDArray, solid_fraction: float) -> tuple[NDArray, NDArray]:
        """Return the share of the number in the coarsest tenth, and the bulk of a mean grain.

        Both as `gradings.representativity.grains_needed` takes them.
        """
        (_, b), (mass, number) = pairs.T, self.kept(pairs)
        below = self.grading.mass_cdf(b) - mass
        # A part without grains has no number.
        with np.errstate(divide="ignore", invalid="ignore"):
            coarse = self.grading.mass_ppf(np.clip(below + 0.9 * mass, 0.0, 1.0))
            share = (self._above(coarse) - self._above(b) + self._at(coarse)[1]) / number
            largest = self.grading.mass_ppf(np.clip(below + 0.999 * mass, 0.0, 1.0))
            bulk = UNIT_SPHERE * self.cube * mass / number / solid_fraction
            bulk /= (2.0 * largest) ** 3
        return np.maximum(share, _NOTHING), np.maximum(bulk, _NOTHING)


def _ends(grading: Grading, low: float, high: float) -> NDArray:
    """Return radii where a part of a grading may end."""
    by_mass = grading.mass_ppf(np.linspace(0.0, 1.0, _BY_MASS))
    return np.unique(np.concatenate([np.geomspace(low, high, _BY_SIZE), by_mass, [low, high]]))


def _lowest(ends: NDArray, highs: NDArray, enough: Callable[[NDArray], NDArray]) -> NDArray:
    """Return for each upper end that has one the pair with the lowest end that will do."""
    grid = np.array([(a, b) for b in highs for a in ends if a <= b])
    grid = grid[enough(grid)]
    high, first = np.unique(grid[:, 1], return_index=True)
    low = grid[first, 0]
    below = ends[np.maximum(np.searchsorted(ends, low) - 1, 0)]
    for _ in range(_HALVINGS):
        middle = np.sqrt(below * low)
        will_do = enough(np.column_stack([middle, high]))
        low, below = np.where(will_do, middle, low), np.where(will_do, below, middle)
    return np.column_stack([low, high])


def _between(ends: NDArray, best: float) -> NDArray:
    """Return closer ends from the neighbour below the best one to that above."""
    place = int(np.searchsorted(ends, best))
    low, high = ends[max(place - 1, 0)], ends[min(place + 1, ends.size - 1)]
    return np.unique(np.append(np.geomspace(low, high, _BY_MASS), best))


def _digits(value: float, up: int) -> float:
    """Return a number to three digits, rounded up or down; one that has no more stays."""
    place = 10.0 ** (math.floor(math.log10(value)) - 2)
    scaled = value / place
    near = round(scaled)
    # What rounding in the last bits has moved is still that number.
    whole = near if abs(scaled - near) < 1e-6 * scaled else math.floor(scaled) + (up > 0)
    return float(f"{whole * place:.3g}")


def _percent(share: float) -> str:
    """Return a share in percent that says neither nothing nor all where it is neither."""
    percent = 100.0 * share
    return f"{percent:.3g} %" if percent < 10.0 or percent > 99.0 else f"{percent:.0f} %"
