"""The distribution of grain radius: continuous, discrete or both, by number and by mass.

A sieve weighs what a simulation counts: mass density ~ R^3 times number density. Both are held as
Legendre series on panels of log R that break where the grading itself does, so that cumulative
curves, quantiles and moments are exact to rounding whichever of the two was given.
"""

import numpy as np

from branchcrush.errors import GradingError
from branchcrush.gradings.panels import Cumulative, panel_values, resolved_edges


class Grading:
    r"""A distribution of grain radius, by number n(R) and by mass g(R).

    .. math:: g(R) = R^3 n(R) / \langle R^3 \rangle

    A discrete part has no density: of a grading that has one, `number_pdf` is nan and
    `has_density` is False. Cumulative curves are right-continuous: a grain counts at its own
    radius.

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

    def __init__(self, density=None, edges=(), radii=(), weights=()):
        radii, place = np.unique(np.asarray(radii, dtype=float), return_inverse=True)
        weights = np.bincount(place.ravel(), np.asarray(weights, dtype=float), radii.size)
        edges = np.union1d(np.asarray(edges, dtype=float), radii)
        if not (edges.size and edges[0] > 0 and np.isfinite(edges[-1])):
            raise GradingError("a grading needs radii above 0 and below infinity: check its sizes")
        self._density = density
        self._edges = edges if density is None else resolved_edges(density, edges)
        self._logs = np.log(self._edges)
        at_edges = np.zeros(self._edges.size)
        at_edges[np.searchsorted(self._edges, radii)] = weights
        radius, values = panel_values(density, self._edges)
        cubes = [(r / edges[-1]) ** 3 for r in (radius, self._edges)]
        self._number = Cumulative(values, at_edges)
        self._mass = Cumulative(values * cubes[0], at_edges * cubes[1])
        self._scale = self._number.total
        self._discrete = radii, weights / self._scale
        self._rule = radius.ravel(), values.ravel() / self._scale

    @property
    def has_density(self):
        """Whether the grading is continuous, without single radii of their own."""
        return self._discrete[0].size == 0

    @property
    def is_discrete(self):
        """Whether the grading is single radii only."""
        return self._density is None

    @property
    def breaks(self):
        """Radii at the ends of the panels, between which the grading is smooth [m]."""
        return self._edges.copy()

    @property
    def discrete_part(self):
        """Radii of the discrete part [m], increasing, and their shares of the number [-]."""
        return tuple(part.copy() for part in self._discrete)

    def support(self):
        """Return the smallest and the largest radius [m].

        Examples
        --------
        >>> Grading(radii=[3.0, 1.0], weights=[1.0, 1.0]).support()
        (1.0, 3.0)
        """
        return float(self._edges[0]), float(self._edges[-1])

    def number_cdf(self, radius):
        """Return the share of the grains up to each radius [m], as the array's shape [-]."""
        return self._number.below(*self._place(radius))

    def mass_cdf(self, radius):
        """Return the share of the mass in grains up to each radius [m] [-]."""
        return self._mass.below(*self._place(radius))

    def number_between(self, lower, upper):
        """Return the share of grains above one radius and up to another [m], to rounding [-].

        The difference of two cumulative shares near 1 would have no digits left.

        Examples
        --------
        >>> Grading(radii=[1.0, 2.0], weights=[1.0, 1e-30]).number_between(1.5, 2.0).item()
        1e-30
        """
        low, high = self._place(lower), self._place(upper)
        below = self._number.below(*high) - self._number.below(*low)
        above = self._number.above(*low) - self._number.above(*high)
        return np.where(self._number.below(*high) < 0.5, below, above)

    def number_ppf(self, share):
        """Return the smallest radius up to which there is a share [-] of the grains [m].

        Examples
        --------
        >>> Grading(radii=[1.0, 2.0], weights=[8.0, 1.0]).number_ppf([0.5, 0.95]).tolist()
        [1.0, 2.0]
        """
        return self._quantile(self._number, share)

    def mass_ppf(self, share):
        """Return the smallest radius up to which there is a share [-] of the mass [m]."""
        return self._quantile(self._mass, share)

    def number_pdf(self, radius):
        """Return the density by number at each radius [m]; nan if there is a discrete part [1/m].

        Examples
        --------
        >>> Grading(lambda r: 1.0 + 0.0 * r, edges=[1.0, 3.0]).number_pdf([0.5, 2.0]).tolist()
        [0.0, 0.5]
        """
        radius = np.asarray(radius, dtype=float)
        return self.continuous_pdf(radius) if self.has_density else np.full(radius.shape, np.nan)

    def moment(self, order):
        r"""Return the raw moment by number, of order k [m^k].

        .. math:: \langle R^k \rangle = \int R^k n(R)\, dR

        Examples
        --------
        >>> Grading(radii=[1.0, 3.0], weights=[1.0, 1.0]).moment(3)
        14.0
        """
        nodes, weight = self._rule
        radii, shares = self._discrete
        return float(weight @ nodes**order + shares @ radii**order)

    def quadrature(self, lower=None, upper=None, breaks=()):
        """Return nodes and weights, so that sum(w g(R)) is the mean of g by number.

        Gauss and Legendre's on every panel; the discrete part is summed as it is.

        Parameters
        ----------
        lower, upper : float, optional
            Only grains above the one and up to the other [m]; all when left out.
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
        edges = np.clip(np.concatenate([[first, last], self._edges, breaks]), first, last)
        nodes, values = panel_values(self._density, np.unique(edges))
        weight = np.append(values.ravel() / self._scale, shares[kept])
        return np.append(nodes.ravel(), radii[kept]), weight

    def rvs(self, size=None, random_state=None):
        """Return radii drawn at random by number, by a numpy Generator or a seed [m].

        Examples
        --------
        >>> Grading(radii=[2.0], weights=[1.0]).rvs(3, random_state=1).tolist()
        [2.0, 2.0, 2.0]
        """
        return self.number_ppf(np.random.default_rng(random_state).random(size))

    def continuous_pdf(self, radius):
        """Return the number density of the continuous part, which integrates to its share [1/m]."""
        radius = np.asarray(radius, dtype=float)
        if self.is_discrete:
            return np.zeros(radius.shape)
        start, end = self.support()
        inside = (radius >= start) & (radius <= end)
        return np.where(inside, self._density(np.clip(radius, start, end)), 0.0) / self._scale

    def _place(self, radius):
        """Return the panel of each radius, -1 below the first, and the place in it, -1 to 1."""
        radius = np.asarray(radius, dtype=float)
        panel = np.searchsorted(self._edges, radius, side="right") - 1
        if self._edges.size == 1:
            return panel, np.zeros(radius.shape)
        index = np.clip(panel, 0, self._edges.size - 2)
        low, high = self._logs[index], self._logs[index + 1]
        inside = np.log(np.clip(radius, *self.support()))
        # Edges next to each other may have the same logarithm.
        width = np.maximum(high - low, np.finfo(float).tiny)
        return panel, np.clip((2.0 * inside - low - high) / width, -1.0, 1.0)

    def _quantile(self, cumulative, share):
        share = np.asarray(share, dtype=float)
        panel, place = cumulative.inverse(share.ravel())
        low, high = (self._logs[np.minimum(panel + k, self._edges.size - 1)] for k in (0, 1))
        radius = np.exp(low + (high - low) * place)
        radius = np.where(place > 0.0, np.clip(radius, *self.support()), self._edges[panel])
        radius[share.ravel() == 1.0] = self._edges[-1]
        radius[~((share.ravel() >= 0.0) & (share.ravel() <= 1.0))] = np.nan
        return radius.reshape(share.shape)[()]
