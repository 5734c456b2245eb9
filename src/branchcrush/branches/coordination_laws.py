"""Coordination numbers as functions of the void ratio or of the distance to jamming.

The historic relations come from packings of equal spheres under gravity, counted by hand or by
stain, near contacts among them; they say nothing of rattlers.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.branches.coordination import ISOSTATIC
from branchcrush.packings.network import Network
from branchcrush.statistics.resampling import pooled_interval

# Of the jamming law, for equal and nearly equal frictionless spheres.
JAMMING_PREFACTOR = 7.8
# Nearer, the jamming point's own uncertainty counts; farther, overlaps are large.
_NEAREST, _FARTHEST = 0.003, 0.1
_MIDDLE = np.log(np.sqrt(_NEAREST * _FARTHEST))


def smith(void_ratio: ArrayLike) -> NDArray:
    r"""Return the coordination number by Smith's relation.

    .. math:: \kappa = 26.486 - 10.726\, (1 + e)

    Parameters
    ----------
    void_ratio : array_like
        e [-]; from lead shot between e = 0.55 and 0.81.

    Returns
    -------
    ndarray

    Examples
    --------
    >>> round(float(smith(0.81)), 2)
    7.07

    References
    ----------
    Smith, Foote and Busang (1929), Phys. Rev. 34, 1271.
    """
    return 26.486 - 10.726 * (1.0 + np.asarray(void_ratio, dtype=float))


def field(void_ratio: ArrayLike) -> NDArray:
    r"""Return the coordination number by Field's relation.

    .. math:: \kappa = \frac{12}{1 + e}

    Parameters
    ----------
    void_ratio : array_like
        e [-].

    Returns
    -------
    ndarray

    Examples
    --------
    >>> float(field(0.5))
    8.0

    References
    ----------
    Field (1963), Proc. 4th Aust.-N.Z. Conf. Soil Mech. Found. Eng., 143.
    """
    return 12.0 / (1.0 + np.asarray(void_ratio, dtype=float))


def gray(void_ratio: ArrayLike) -> NDArray:
    r"""Return the coordination number by Gray's relation: kappa times the porosity is pi.

    .. math:: \kappa = \frac{\pi (1 + e)}{e}

    Parameters
    ----------
    void_ratio : array_like
        e [-], above 0.

    Returns
    -------
    ndarray

    Examples
    --------
    >>> round(float(gray(1.0)), 6)
    6.283185

    References
    ----------
    Gray (1968), The Packing of Solid Particles.
    """
    ratio = np.asarray(void_ratio, dtype=float)
    return np.pi * (1.0 + ratio) / ratio


def jamming_law(above_jamming: ArrayLike, prefactor: float = JAMMING_PREFACTOR) -> NDArray:
    r"""Return the mechanical coordination number at a solid fraction above jamming.

    .. math:: \kappa^* = 6 + a \sqrt{\phi - \phi_J}

    Parameters
    ----------
    above_jamming : array_like
        phi - phi_J, 0 or more [-].
    prefactor : float
        a [-].

    Returns
    -------
    ndarray

    Examples
    --------
    >>> round(float(jamming_law(0.01)), 9)
    6.78

    References
    ----------
    O'Hern, Silbert, Liu and Nagel (2003), Phys. Rev. E 68, 011306.
    """
    return ISOSTATIC + prefactor * np.sqrt(above_jamming)


def isostatic_number(network: Network) -> float:
    r"""Return the mechanical coordination number that just holds a packing.

    .. math:: \kappa^*_{iso} = 6 - W^*/N^*

    N* grains that are no rattlers have 3 N* equations of balance for the forces of M* contacts and
    W* contacts with walls. M* + W* = 3 N* makes (2 M* + W*)/N* less than 6 between walls, since a
    contact with a wall is an end of one grain only.

    Parameters
    ----------
    network : Network

    Returns
    -------
    float
        [-]; 6 in a periodic cell, nan when all grains are rattlers.
    """
    bearing = network.bearing
    if not bearing.any():
        return float("nan")
    return float(ISOSTATIC - network.wall_contacts[bearing].sum() / bearing.sum())


def jamming_law_fit(
    above_jamming: Sequence[ArrayLike],
    coordination: Sequence[ArrayLike],
    isostatic: Sequence[ArrayLike] | None = None,
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> dict[str, float]:
    r"""Return the jamming law of some packings with the exponent 1/2, and with a free one.

    .. math:: \kappa^* - \kappa^*_{iso} = a \sqrt{\phi - \phi_J}, \qquad
        \kappa^* - \kappa^*_{iso} = b\, (\phi - \phi_J)^{\nu}

    a by least squares, b and nu by least squares of the logarithms, over the states of each seed
    from 0.003 to 0.1 above jamming. nu leaves out states that are not above isostatic;
    `states_not_above` counts them, and many say that the isostatic number or phi_J is wrong.

    Parameters
    ----------
    above_jamming : list of array_like
        phi - phi_J of the states of each seed, or sample, with its own phi_J [-].
    coordination : list of array_like
        kappa* of these states [-].
    isostatic : list of array_like, optional
        `isostatic_number` of these states; 6 without it, which is right in a periodic cell.
    confidence, resamples, rng
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    dict
        prefactor a and exponent nu, with _low and _high, and free_prefactor b; nan where no state
        or a single distance is in the range; states, states_not_above.

    Examples
    --------
    >>> x = np.array([0.01, 0.02, 0.04])
    >>> fit = jamming_law_fit([x], [6.0 + 8.0 * x**0.5], rng=None)
    >>> round(fit["prefactor"], 9), round(fit["exponent"], 9), fit["states"]
    (8.0, 0.5, 3)
    """
    least = [ISOSTATIC] * len(above_jamming) if isostatic is None else isostatic
    near = [_near_states(*seed) for seed in zip(above_jamming, coordination, least, strict=True)]
    sums = [_law_sums(above, excess) for above, excess in near]
    limits = pooled_interval(sums, _laws, confidence=confidence, resamples=resamples, rng=rng)
    return {
        "states": sum(above.size for above, _ in near),
        "states_not_above": sum(int(np.sum(~(excess > 0.0))) for _, excess in near),
        **limits.part(0).named("prefactor"),
        **limits.part(1).named("exponent"),
        # Without limits: it is the law's value at phi - phi_J = 1, far from all states.
        "free_prefactor": float(limits.part(2).estimate),
    }


def _near_states(
    above_jamming: ArrayLike, coordination: ArrayLike, isostatic: ArrayLike
) -> tuple[NDArray, NDArray]:
    """Return phi - phi_J and kappa* - kappa*_iso of the states that count."""
    above = np.asarray(above_jamming, dtype=float)
    excess = np.asarray(coordination, dtype=float) - isostatic
    near = (above >= _NEAREST) & (above <= _FARTHEST)
    return above[near], excess[near]


def _law_sums(above: NDArray, excess: NDArray) -> list[float]:
    positive = excess > 0.0
    # About the middle of the range, so that the spread of the logarithms is no difference of large
    # numbers.
    u, v = np.log(above[positive]) - _MIDDLE, np.log(excess[positive])
    return [excess @ np.sqrt(above), above.sum(), u.size, u.sum(), v.sum(), u @ u, u @ v]


def _laws(totals: NDArray) -> NDArray:
    """Return a, nu and b of sums of shape (draws, 7)."""
    product, square, number, u, v, uu, uv = totals.T
    with np.errstate(invalid="ignore", divide="ignore"):
        spread = number * uu - u**2
        # Zero but for rounding where all states are at one distance.
        spread = np.where(spread > 1e-9 * number**2, spread, np.nan)
        exponent = (number * uv - u * v) / spread
        free = np.exp((v - exponent * u) / number - exponent * _MIDDLE)
        return np.stack([product / square, exponent, free], axis=1)
