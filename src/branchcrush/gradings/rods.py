"""Where a grading jams, and whose grains then carry load: the map onto rods on a line.

A straight line through a packing meets grains along chords. Farr and Groot put such chords, as
rods, on a line of their own, the longest first, each into the widest gap that is left; the share of
the line that is covered in the end is close to the solid fraction at which frictionless grains jam.
Here the rods stand at the quantiles of their lengths instead of being drawn, which leaves no noise.
"""

import heapq
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

# Gaps beside a rod, in its own lengths, with which equal spheres jam at 0.640, frictionless and
# without any order.
GAP = 0.7769
# The one that Farr and Groot published: equal spheres jam at 0.6435.
PUBLISHED_GAP = 0.7654
# Rods; with four times as many phi_J changes by 1e-5.
RODS = 10_000


@dataclass(frozen=True)
class RodMap:
    r"""The rods of a grading on a line, from the longest to the shortest.

    .. math:: G(L) = \frac{L^2\, P(D > L) + \int_{D < L} D^2\, dP(D)}{\langle D^2 \rangle},
        \qquad \phi_J = \frac{\sum L}{\sum L + \sum g}

    G is the share of chords that are shorter than L. A rod goes into the widest gap g, where it
    keeps a gap of f L on either side; where there is less room, g < (1 + 2f) L, it pushes the line
    apart.

    Parameters
    ----------
    length : ndarray, shape (n,)
        L of the rods, decreasing [unit of the radii].
    edge : ndarray, shape (n+1,)
        Each rod stands for the chords between two of these, decreasing, the largest diameter and 0
        among them [unit of the radii].
    pushes : ndarray of bool, shape (n,)
        Whether the rod found too little room.
    solid_fraction : float
        phi_J, share of the line that rods cover [-].

    References
    ----------
    Farr and Groot (2009), J. Chem. Phys. 131, 244104, arXiv:0912.0852; which rods push is
    recorded here and not there.
    """

    length: NDArray
    edge: NDArray
    pushes: NDArray
    solid_fraction: float

    def load_bearing(self, radius: NDArray) -> NDArray:
        r"""Return the share of the grains of each radius that carry load.

        .. math:: \beta(D) = \frac{1}{D^2} \int_0^D \mathbf{1}_{\mathrm{pushes}}(L)\, 2L\, dL

        A sphere is met along chords of density 2L/D^2; it carries load in the share of them that
        push, 1 - (L_c/D)^2 where all rods above one length L_c do.

        Parameters
        ----------
        radius : ndarray, shape (K,)
            [unit of the radii that the map was made of]

        Returns
        -------
        ndarray, shape (K,)
            From 0 to 1 [-].

        Examples
        --------
        >>> equal = rod_map(np.array([1.0]), np.array([1.0]))
        >>> equal.load_bearing(np.array([1.0])).round(3).tolist()
        [0.952]
        """
        squares, pushed = self._pushed_below
        diameter = 2.0 * np.asarray(radius, dtype=float)
        return np.clip(np.interp(diameter**2, squares, pushed) / diameter**2, 0.0, 1.0)

    @cached_property
    def _pushed_below(self) -> tuple[NDArray, NDArray]:
        """Return L^2, increasing, and the integral of 2L over the chords below L that push."""
        squares = self.edge[::-1] ** 2
        pushed = np.append(0.0, np.cumsum(np.diff(squares) * self.pushes[::-1]))
        return squares, pushed


def rod_map(radius: NDArray, share: NDArray, gap: float = GAP, rods: int = RODS) -> RodMap:
    r"""Return the rods of a grading on a line, and where they jam.

    Parameters
    ----------
    radius, share : ndarray, shape (K,)
        Radii [any unit], and their shares of the number of grains [-]; of any order.
    gap : float
        f, gaps beside a rod over its length [-]; 0.7654 was published.
    rods : int
        n; 10 000 take some 10 ms.

    Returns
    -------
    RodMap

    Raises
    ------
    ValueError
        Unless the radii and the gap are above 0, the shares not below it, one above.

    Examples
    --------
    >>> equal = np.array([1.0]), np.array([1.0])
    >>> round(rod_map(*equal).solid_fraction, 4)
    0.64
    >>> half_of_the_mass_ten_times_finer = np.array([1.0, 0.1]), np.array([1.0, 1000.0])
    >>> rod_map(*half_of_the_mass_ten_times_finer).solid_fraction > 0.75
    True

    References
    ----------
    Farr and Groot (2009), J. Chem. Phys. 131, 244104; Farr (2013), arXiv:1306.1442.
    """
    _check(radius, share, gap)
    quantile = np.arange(2 * rods, -1, -1) / (2 * rods)
    chords = chord_quantile(radius, share, quantile)
    edge, length = chords[::2], chords[1::2]
    pushes, extent = _inserted(length, gap)
    return RodMap(length, edge, pushes, float(length.sum() / extent))


def gap_at(radius: NDArray, share: NDArray, solid_fraction: float, rods: int = RODS) -> float:
    r"""Return the gap beside rods with which a grading covers a share of the line.

    .. math:: \phi_{\mathrm{map}}(f) = \phi

    Beyond jamming gaps are narrower, and more rods push.

    Parameters
    ----------
    radius, share
        As for `rod_map`.
    solid_fraction : float
        phi, from that of the jamming point to below 1 [-].
    rods : int
        As for `rod_map`.

    Returns
    -------
    float
        f [-].

    Raises
    ------
    ValueError
        As `rod_map`, and for a solid fraction outside of 0 to 1.

    Examples
    --------
    >>> round(gap_at(np.array([1.0]), np.array([1.0]), 0.640), 3)
    0.777
    """
    from scipy.optimize import brentq  # slow to import, and few jobs need it

    _check(radius, share, GAP)
    if not 0.0 < solid_fraction < 1.0:
        raise ValueError(f"no rods cover {solid_fraction:g} of a line; it must be from 0 to 1")
    middles = np.arange(rods - 0.5, 0, -1) / rods
    length = chord_quantile(radius, share, middles)

    def excess(gap: float) -> float:
        return length.sum() / _inserted(length, gap)[1] - solid_fraction

    widest = 1.0
    while excess(widest) > 0.0:
        widest *= 2.0
    return float(brentq(excess, 1e-9, widest, xtol=1e-7))


def chord_quantile(radius: NDArray, share: NDArray, level: NDArray) -> NDArray:
    r"""Return the chord below which a share of the chords of a grading lies.

    .. math:: L = G^{-1}(y): \quad
        L^2 = \frac{y \langle D^2 \rangle - \sum_{D_j \le L} w_j D_j^2}{\sum_{D_j > L} w_j}

    Parameters
    ----------
    radius, share
        As for `rod_map`.
    level : ndarray, shape (n,)
        y, from 0 to 1 [-].

    Returns
    -------
    ndarray, shape (n,)
        L [unit of the radii].

    Examples
    --------
    >>> chord_quantile(np.array([1.0]), np.array([1.0]), np.array([0.25, 1.0])).tolist()
    [1.0, 2.0]
    """
    order = np.argsort(radius)
    diameter, weight = 2.0 * np.asarray(radius, float)[order], np.asarray(share, float)[order]
    finer = np.append(0.0, np.cumsum(weight * diameter**2))  # sum of w D^2 below each diameter
    coarser = np.cumsum(weight[::-1])[::-1]  # sum of w from each diameter on
    at_diameter = finer[:-1] + coarser * diameter**2  # G <D^2> where L reaches it
    target = np.asarray(level, float) * finer[-1]
    piece = np.minimum(np.searchsorted(at_diameter, target), diameter.size - 1)
    square = np.maximum(target - finer[piece], 0.0) / coarser[piece]
    return np.minimum(np.sqrt(square), diameter[piece])


def _inserted(length: NDArray, gap: float) -> tuple[NDArray, float]:
    """Put rods on the line, the longest first; return who pushes, and the line's extent."""
    pushes = np.zeros(length.size, dtype=bool)
    # The first closes on itself with one gap. A heap gives its least first.
    widest = [-gap * float(length[0])]
    pushes[0] = True
    for number, rod in enumerate(length[1:].tolist(), start=1):
        beside = gap * rod
        left = -widest[0] - beside - rod
        if left < beside:
            pushes[number] = True
            left = beside
        heapq.heapreplace(widest, -left)
        heapq.heappush(widest, -beside)
    return pushes, float(length.sum()) - float(sum(widest))


def _check(radius: NDArray, share: NDArray, gap: float) -> None:
    usable = np.size(radius) == np.size(share) > 0 and np.isfinite([radius, share]).all()
    if not (usable and np.min(radius) > 0 and np.min(share) >= 0 and np.max(share) > 0):
        raise ValueError("a rod map needs radii above 0 and shares of number, one above 0")
    if not 0 < gap < np.inf:
        raise ValueError(f"the gap beside rods must be above 0: {gap:g}")
