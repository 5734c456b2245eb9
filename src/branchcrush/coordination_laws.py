"""Coordination numbers as functions of the void ratio or of the distance to jamming.

The historic relations come from packings of equal spheres under gravity, counted by hand or by
stain, near contacts among them; they say nothing of rattlers.
"""

import numpy as np

from branchcrush.coordination_models import ISOSTATIC
from branchcrush.intervals import pooled_interval

# Of the jamming law, for equal and nearly equal frictionless spheres.
JAMMING_PREFACTOR = 7.8
# Nearer, the jamming point's own uncertainty counts; farther, overlaps are large.
_NEAREST, _FARTHEST = 0.003, 0.1


def smith(void_ratio):
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


def field(void_ratio):
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


def gray(void_ratio):
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
    void_ratio = np.asarray(void_ratio, dtype=float)
    return np.pi * (1.0 + void_ratio) / void_ratio


def jamming_law(above_jamming, prefactor=JAMMING_PREFACTOR):
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


def jamming_prefactor(above_jamming, coordination, *, confidence=0.95, resamples=2000, rng):
    r"""Return the prefactor of the jamming law of some packings, by least squares.

    .. math:: a = \frac{\sum (\kappa^* - 6) \sqrt{\phi - \phi_J}}{\sum (\phi - \phi_J)}

    Over the states from 0.003 to 0.1 above jamming.

    Parameters
    ----------
    above_jamming : list of array_like
        phi - phi_J of the states of each seed, with its own phi_J [-].
    coordination : list of array_like
        kappa* of these states [-].
    confidence, resamples, rng
        As for `intervals.pooled_interval`.

    Returns
    -------
    Interval
        nan when no state is in the range.

    Examples
    --------
    >>> x = np.array([0.01, 0.04])
    >>> round(jamming_prefactor([x], [6.0 + 8.0 * np.sqrt(x)], rng=None).estimate, 9)
    8.0
    """
    sums = []
    for above, number in zip(above_jamming, coordination, strict=True):
        above, number = np.asarray(above, dtype=float), np.asarray(number, dtype=float)
        near = (above >= _NEAREST) & (above <= _FARTHEST)
        root = np.sqrt(above[near])
        sums.append([(number[near] - ISOSTATIC) @ root, root @ root])

    def ratio(totals):
        with np.errstate(invalid="ignore", divide="ignore"):
            return totals[:, 0] / totals[:, 1]

    return pooled_interval(sums, ratio, confidence=confidence, resamples=resamples, rng=rng)
