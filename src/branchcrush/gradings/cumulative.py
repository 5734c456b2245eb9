"""The two cumulative curves of a grading, by number and by mass, and their quantiles."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.gradings.panels import Cumulative


class CumulativeCurves:
    """The cumulative curves that every `gradings.distribution.Grading` has.

    They are right-continuous: a grain counts at its own radius. Both are exact to rounding,
    whichever of the two a grading was given by.

    Parameters
    ----------
    edges : ndarray, shape (panels+1,)
        Ends of the panels [m].
    values, cubes : two ndarray each, shapes (panels, nodes) and (panels+1,)
        Weights of the continuous part, at the nodes of each panel, and of single radii at the
        edges, of any scale; and what they are multiplied by, to be by mass [-].

    Raises
    ------
    GradingError
        When a weight is negative, or all are 0.

    Examples
    --------
    >>> edges, nothing = np.array([1.0, 2.0]), np.empty((1, 0))
    >>> curves = CumulativeCurves(edges, (nothing, np.array([8.0, 1.0])), (nothing, edges**3))
    >>> curves.number_cdf(1.0).round(3).item(), curves.mass_cdf(1.0).item()
    (0.889, 0.5)
    """

    def __init__(
        self, edges: NDArray, values: tuple[NDArray, NDArray], cubes: tuple[NDArray, NDArray]
    ) -> None:
        self._edges = edges
        self._logs = np.log(edges)
        self._number = Cumulative(*values)
        self._mass = Cumulative(values[0] * cubes[0], values[1] * cubes[1])

    def support(self) -> tuple[float, float]:
        """Return the smallest and the largest radius.

        Returns
        -------
        smallest, largest : float
            R_m and R_M [m].

        Examples
        --------
        >>> from branchcrush.gradings.distribution import Grading
        >>> Grading(radii=[3.0, 1.0], weights=[1.0, 1.0]).support()
        (1.0, 3.0)
        """
        return float(self._edges[0]), float(self._edges[-1])

    def number_cdf(self, radius: ArrayLike) -> NDArray:
        r"""Return the share of the grains up to each radius.

        .. math:: F_n(R) = \int_{R_m}^R n(R')\, dR'

        Parameters
        ----------
        radius : array_like, shape (...)
            R [m].

        Returns
        -------
        ndarray, shape (...)
            From 0 to 1 [-].

        Examples
        --------
        >>> from branchcrush.gradings.distribution import Grading
        >>> Grading(radii=[1.0, 2.0], weights=[3.0, 1.0]).number_cdf([0.9, 1.0, 2.0]).tolist()
        [0.0, 0.75, 1.0]
        """
        return self._number.below(*self._place(radius))

    def mass_cdf(self, radius: ArrayLike) -> NDArray:
        r"""Return the share of the mass in grains up to each radius: the sieve curve over 100 %.

        .. math:: F(R) = \frac{1}{\langle R^3 \rangle} \int_{R_m}^R R'^3 n(R')\, dR'

        Parameters
        ----------
        radius : array_like, shape (...)
            R [m].

        Returns
        -------
        ndarray, shape (...)
            From 0 to 1 [-].

        Examples
        --------
        >>> from branchcrush.gradings.distribution import Grading
        >>> Grading(radii=[1.0, 2.0], weights=[8.0, 1.0]).mass_cdf([0.9, 1.0, 2.0]).tolist()
        [0.0, 0.5, 1.0]
        """
        return self._mass.below(*self._place(radius))

    def number_between(self, lower: ArrayLike, upper: ArrayLike) -> NDArray:
        r"""Return the share of grains above one radius and up to another, to rounding.

        .. math:: F_n(b) - F_n(a)

        The difference of two cumulative shares near 1 would have no digits left.

        Parameters
        ----------
        lower, upper : array_like, shape (...)
            a and b, a <= b [m].

        Returns
        -------
        ndarray, shape (...)
            [-]

        Examples
        --------
        >>> from branchcrush.gradings.distribution import Grading
        >>> Grading(radii=[1.0, 2.0], weights=[1.0, 1e-30]).number_between(1.5, 2.0).item()
        1e-30
        """
        low, high = self._place(lower), self._place(upper)
        below = self._number.below(*high) - self._number.below(*low)
        above = self._number.above(*low) - self._number.above(*high)
        return np.where(self._number.below(*high) < 0.5, below, above)

    def number_ppf(self, share: ArrayLike) -> NDArray:
        r"""Return the smallest radius up to which there is a share of the grains.

        .. math:: R(q) = \min\{R : F_n(R) \ge q\}

        Parameters
        ----------
        share : array_like, shape (...)
            q, 0 to 1 [-].

        Returns
        -------
        ndarray, shape (...)
            [m]; nan beyond 0 to 1.

        Examples
        --------
        >>> from branchcrush.gradings.distribution import Grading
        >>> Grading(radii=[1.0, 2.0], weights=[8.0, 1.0]).number_ppf([0.5, 0.95]).tolist()
        [1.0, 2.0]
        """
        return self._quantile(self._number, share)

    def mass_ppf(self, share: ArrayLike) -> NDArray:
        r"""Return the smallest radius up to which there is a share of the mass.

        .. math:: R(q) = \min\{R : F(R) \ge q\}

        Parameters
        ----------
        share : array_like, shape (...)
            q, 0 to 1 [-].

        Returns
        -------
        ndarray, shape (...)
            [m]; nan beyond 0 to 1.

        Examples
        --------
        >>> from branchcrush.gradings.distribution import Grading
        >>> Grading(radii=[1.0, 2.0], weights=[8.0, 1.0]).mass_ppf([0.4, 0.6]).tolist()
        [1.0, 2.0]
        """
        return self._quantile(self._mass, share)

    def _place(self, radius: ArrayLike) -> tuple[NDArray, NDArray]:
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

    def _quantile(self, cumulative: Cumulative, share: ArrayLike) -> NDArray:
        share = np.asarray(share, dtype=float)
        panel, place = cumulative.inverse(share.ravel())
        low, high = (self._logs[np.minimum(panel + k, self._edges.size - 1)] for k in (0, 1))
        radius = np.exp(low + (high - low) * place)
        radius = np.where(place > 0.0, np.clip(radius, *self.support()), self._edges[panel])
        radius[share.ravel() == 1.0] = self._edges[-1]
        radius[~((share.ravel() >= 0.0) & (share.ravel() <= 1.0))] = np.nan
        return radius.reshape(share.shape)[()]
