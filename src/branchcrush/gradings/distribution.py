"""The distribution of grain radius: continuous, discrete or both, by number and by mass.

A sieve weighs what a simulation counts: mass density ~ R^3 times number density. Both are held as
Legendre series on panels of log R that break where the grading itself does, so that cumulative
curves, quantiles and moments are exact to rounding whichever of the two was given.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.errors import GradingError
from branchcrush.gradings.cumulative import CumulativeCurves
from branchcrush.gradings.panels import Density, panel_values, resolved_edges


class Grading(CumulativeCurves):
    r"""A distribution of grain radius, by number n(R) and by mass g(R).

    .. math:: g(R) = R^3 n(R) / \langle R^3 \rangle

    A discrete part has no density: of a grading that has one, `number_pdf` is nan and
    `has_density` is False. Cumulative curves and quantiles are those of `CumulativeCurves`.

    Parameters
    ----------
    density : callable, optional
        Number density of the continuous part, of any scale, zero outside of it [1/m].
    edges : array_like, shape (n,)
        Ends of the continuous part, and where its density has a kink, jump or narrow peak [m].
    radii, weights : array_like, shape (m,)
        Radii of the discrete part [m] and their numbers, on the scale of the density [-].

    Raises
    ------
    GradingError
        When a radius is not positive, or nothing has a weight.

    Examples
    --------
    >>> two = Grading(radii=[1.0, 2.0], weights=[8.0, 1.0])
    >>> two.number_cdf([0.5, 1.0, 2.0]).round(3).tolist()
    [0.0, 0.889, 1.0]
    >>> two.mass_cdf([0.5, 1.0, 2.0]).tolist()
    [0.0, 0.5, 1.0]
    """

    def __init__(
        self,
        density: Density | None = None,
        edges: ArrayLike = (),
        radii: ArrayLike = (),
        weights: ArrayLike = (),
    ) -> None:
        radii, place = np.unique(np.asarray(radii, dtype=float), return_inverse=True)
        weights = np.bincount(place.ravel(), np.asarray(weights, dtype=float), radii.size)
        edges = np.union1d(np.asarray(edges, dtype=float), radii)
        if not (edges.size and edges[0] > 0 and np.isfinite(edges[-1])):
            raise GradingError("a grading needs radii above 0 and below infinity: check its sizes")
        self._density = density
        edges = edges if density is None else resolved_edges(density, edges)
        at_edges = np.zeros(edges.size)
        at_edges[np.searchsorted(edges, radii)] = weights
        radius, values = panel_values(density, edges)
        cubes = (radius / edges[-1]) ** 3, (edges / edges[-1]) ** 3
        super().__init__(edges, (values, at_edges), cubes)
        self._scale = self._number.total
        self._discrete = radii, weights / self._scale
        self._rule = radius.ravel(), values.ravel() / self._scale

    @property
    def has_density(self) -> bool:
        """Whether the grading is continuous, without single radii of their own."""
        return self._discrete[0].size == 0

    @property
    def is_discrete(self) -> bool:
        """Whether the grading is single radii only."""
        return self._density is None

    @property
    def breaks(self) -> NDArray:
        """Radii at the ends of the panels, between which the grading is smooth [m]."""
        return self._edges.copy()

    @property
    def discrete_part(self) -> tuple[NDArray, NDArray]:
        """Radii of the discrete part [m], increasing, and their shares of the number [-]."""
        radii, shares = self._discrete
        return radii.copy(), shares.copy()

    def number_pdf(self, radius: ArrayLike) -> NDArray:
        """Return the density by number at each radius.

        Parameters
        ----------
        radius : array_like, shape (...)
            [m]

        Returns
        -------
        ndarray, shape (...)
            n(R) [1/m]; nan if there is a discrete part.

        Examples
        --------
        >>> Grading(lambda r: 1.0 + 0.0 * r, edges=[1.0, 3.0]).number_pdf([0.5, 2.0]).tolist()
        [0.0, 0.5]
        """
        radius = np.asarray(radius, dtype=float)
        return self.continuous_pdf(radius) if self.has_density else np.full(radius.shape, np.nan)

    def moment(self, order: float) -> float:
        r"""Return the raw moment by number, of any order.

        .. math:: \langle R^k \rangle = \int R^k n(R)\, dR

        Parameters
        ----------
        order : float
            k [-].

        Returns
        -------
        float
            [m^k]

        Examples
        --------
        >>> Grading(radii=[1.0, 3.0], weights=[1.0, 1.0]).moment(3)
        14.0
        """
        nodes, weight = self._rule
        radii, shares = self._discrete
        return float(weight @ nodes**order + shares @ radii**order)

    def quadrature(
        self, lower: float | None = None, upper: float | None = None, breaks: ArrayLike = ()
    ) -> tuple[NDArray, NDArray]:
        r"""Return nodes and weights of means by number.

        .. math:: \int_a^b g(R)\, n(R)\, dR \approx \sum_m w_m\, g(R_m)

        Gauss and Legendre's on every panel; the discrete part is summed as it is.

        Parameters
        ----------
        lower, upper : float, optional
            a and b: only grains above the one and up to the other [m]; all when left out.
        breaks : array_like, shape (n,)
            Radii where g has a kink or jump [m].

        Returns
        -------
        radius, weight : ndarray, shape (m,)
            [m] and [-].

        Examples
        --------
        >>> flat = Grading(lambda r: 1.0 + 0.0 * r, edges=[1.0, 3.0])
        >>> radius, weight = flat.quadrature()
        >>> round(float(weight @ radius**2), 12)
        4.333333333333
        """
        start, end = self.support()
        first = start if lower is None else min(max(lower, start), end)
        last = end if upper is None else max(min(upper, end), first)
        radii, shares = self._discrete
        kept = (radii <= last) & ((radii > first) if lower is not None else True)
        if lower is not None and lower < start:
            kept |= (radii == start) & (start <= last)
        every = np.concatenate([[first, last], self._edges, np.asarray(breaks, dtype=float)])
        edges = np.clip(every, first, last)
        nodes, values = panel_values(self._density, np.unique(edges))
        weight = np.append(values.ravel() / self._scale, shares[kept])
        return np.append(nodes.ravel(), radii[kept]), weight

    def rvs(
        self, size: int | None = None, random_state: np.random.Generator | int | None = None
    ) -> NDArray:
        """Return radii drawn at random by number.

        Parameters
        ----------
        size : int, optional
            One radius when left out.
        random_state : numpy.random.Generator or int, optional

        Returns
        -------
        ndarray, shape (size,)
            [m]

        Examples
        --------
        >>> Grading(radii=[2.0], weights=[1.0]).rvs(3, random_state=1).tolist()
        [2.0, 2.0, 2.0]
        """
        return self.number_ppf(np.random.default_rng(random_state).random(size))

    def continuous_pdf(self, radius: ArrayLike) -> NDArray:
        """Return the number density of the continuous part, which integrates to its share.

        Parameters
        ----------
        radius : array_like, shape (...)
            [m]

        Returns
        -------
        ndarray, shape (...)
            [1/m]; 0 outside the support.

        Examples
        --------
        >>> half = Grading(lambda r: 0.0 * r + 0.5, [1.0, 2.0], radii=[1.5], weights=[0.5])
        >>> half.continuous_pdf([0.9, 1.2]).round(12).tolist()
        [0.0, 0.5]
        """
        radius = np.asarray(radius, dtype=float)
        if self._density is None:
            return np.zeros(radius.shape)
        start, end = self.support()
        inside = (radius >= start) & (radius <= end)
        return np.where(inside, self._density(np.clip(radius, start, end)), 0.0) / self._scale
