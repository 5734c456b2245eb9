"""Cumulative curves as Legendre series on panels of the logarithm of radius."""

from collections.abc import Callable

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from branchcrush.errors import GradingError

# A density by number or by mass at radii [m], of any scale [1/m].
Density = Callable[[NDArray], NDArray]

_NODES, _WEIGHTS = legendre.leggauss(24)
# Turns values at the nodes, times the weights, into Legendre coefficients of the polynomial.
_TO_SERIES = legendre.legvander(_NODES, _NODES.size - 1) * (np.arange(_NODES.size) + 0.5)
# Panels are narrower than this in log R, so that R^k is a polynomial on each to rounding.
_WIDEST = 0.5
# A panel is halved until the last coefficients are below this share of the whole.
_RESOLVED = 1e-13


class Cumulative:
    """Cumulative shares over panels and the steps at their edges, by number or by mass.

    A place is that of a radius in its panel, in log R from -1 to 1; panel -1 lies below all, and
    the one after the last above all.

    Parameters
    ----------
    values : ndarray, shape (panels, nodes)
        Weights of the continuous part, from `panel_values`.
    at_edges : ndarray, shape (panels+1,)
        Weights of single radii at the edges.

    Raises
    ------
    GradingError
        When a weight is negative, or all are 0.

    Examples
    --------
    >>> edges = np.array([1.0, 2.0])
    >>> _, values = panel_values(lambda r: 1 / r, edges)
    >>> curve = Cumulative(values, np.array([0.0, np.log(2.0)]))
    >>> round(float(curve.below(np.array(0), np.array(0.0))), 12)
    0.25
    """

    def __init__(self, values: NDArray, at_edges: NDArray) -> None:
        steps = np.zeros(2 * at_edges.size - 1)
        steps[0::2], steps[1::2] = at_edges, values.sum(axis=1)
        if not (np.all(steps >= 0) and 0 < steps.sum() < np.inf):
            raise GradingError("a grading needs weights that are not negative and not all zero")
        self.total = np.sum(steps)
        # Before and after the step at every edge; of what lies above, likewise.
        self.levels = np.append(0.0, np.cumsum(steps))
        self.levels /= self.levels[-1]
        rest = np.append(np.cumsum(steps[::-1])[::-1], 0.0)
        self.rest = rest / rest[0]
        self.panels = at_edges.size - 1
        empty = np.zeros((1, self.panels))
        series = (values @ _TO_SERIES).T / self.total if values.size else empty
        self.density = series
        self.rising = legendre.legint(series, lbnd=-1)
        self.falling = -legendre.legint(series, lbnd=1)

    def below(self, panel: NDArray, place: NDArray) -> NDArray:
        """Return the share up to each place.

        Parameters
        ----------
        panel : ndarray of int, shape (...)
            -1 below all panels.
        place : ndarray, shape (...)
            In the panel, -1 to 1 [-].

        Returns
        -------
        ndarray, shape (...)
            [-]
        """
        index = np.clip(panel, 0, self.panels)
        level = np.where(panel < 0, 0.0, self.levels[2 * index + 1])
        # The series is 0 at the edge only to rounding.
        inside = (panel >= 0) & (panel < self.panels) & (place > -1.0)
        share = level + self._inside(self.rising, index, place, inside)
        return np.minimum(share, self.levels[np.minimum(2 * index + 2, 2 * self.panels + 1)])[()]

    def above(self, panel: NDArray, place: NDArray) -> NDArray:
        """Return the share above each place, with its own digits where it is small.

        Parameters
        ----------
        panel : ndarray of int, shape (...)
            -1 below all panels.
        place : ndarray, shape (...)
            In the panel, -1 to 1 [-].

        Returns
        -------
        ndarray, shape (...)
            [-]
        """
        index = np.clip(panel, 0, self.panels)
        last = np.minimum(2 * index + 2, 2 * self.panels + 1)
        level = np.where(panel < 0, 1.0, self.rest[last])
        inside = (panel >= 0) & (panel < self.panels) & (place < 1.0)
        return (level + self._inside(self.falling, index, place, inside))[()]

    def inverse(self, share: NDArray) -> tuple[NDArray, NDArray]:
        """Return the panel that reaches each share, and the place in it.

        Parameters
        ----------
        share : ndarray, shape (n,)
            0 to 1 [-].

        Returns
        -------
        panel : ndarray of int, shape (n,)
        place : ndarray, shape (n,)
            From 0 to 1 across the panel [-].
        """
        step = np.clip(np.searchsorted(self.levels, share) - 1, 0, 2 * self.panels)
        panel, place = step // 2, np.zeros(share.shape)
        inside = step % 2 == 1
        wanted = share[inside] - self.levels[step[inside]]
        place[inside] = (self._root(panel[inside], wanted) + 1.0) / 2.0
        return panel, place

    def _inside(self, series: NDArray, index: NDArray, place: NDArray, inside: NDArray) -> NDArray:
        if not np.any(inside):
            return np.zeros(())
        index = np.minimum(index, self.panels - 1)
        return np.where(inside, np.maximum(_series_sum(series, index, place), 0.0), 0.0)

    def _root(self, panel: NDArray, wanted: NDArray) -> NDArray:
        # Newton's method, halving its bracket whenever it leaves it: a density may vanish.
        whole = self.levels[2 * panel + 2] - self.levels[2 * panel + 1]
        place, low, high = 2.0 * wanted / whole - 1.0, -np.ones(panel.size), np.ones(panel.size)
        left = np.arange(panel.size)
        for _ in range(60):
            if not left.size:
                break
            x, index = place[left], panel[left]
            excess = _series_sum(self.rising, index, x) - wanted[left]
            low[left] = np.where(excess < 0, x, low[left])
            high[left] = np.where(excess > 0, x, high[left])
            with np.errstate(divide="ignore", invalid="ignore"):
                new = x - excess / _series_sum(self.density, index, x)
            outside = ~((new > low[left]) & (new < high[left]))
            new = np.where(outside, (low[left] + high[left]) / 2.0, new)
            done = np.abs(excess) <= 2e-16 * whole[left]
            place[left] = np.where(done, x, new)
            left = left[~done & (np.abs(new - x) > 2e-15)]
        return place


def _series_sum(series: NDArray, index: NDArray, x: NDArray) -> NDArray:
    """Return the Legendre series of each panel index at x: Clenshaw's sum."""
    after, last = np.zeros(np.shape(x)), np.zeros(np.shape(x))
    for k in range(len(series) - 1, 0, -1):
        now = series[k][index] + (2 * k + 1) / (k + 1) * x * after - (k + 1) / (k + 2) * last
        after, last = now, after
    return series[0][index] + x * after - last / 2.0


def panel_values(density: Density | None, edges: NDArray) -> tuple[NDArray, NDArray]:
    r"""Return nodes in each panel and their weights, by Gauss and Legendre in the logarithm of R.

    .. math:: \int_{R_k}^{R_{k+1}} g\, n\, dR \approx \sum_m w_{km}\, g(R_{km}), \qquad
        w_{km} = n(R_{km})\, R_{km}\, h_k \omega_m

    2 h_k is the width of the panel in ln R, omega_m are the weights on -1 to 1.

    Parameters
    ----------
    density : callable or None
        n [1/m]; None has no nodes.
    edges : ndarray, shape (panels+1,)
        Increasing [m].

    Returns
    -------
    radius, weight : ndarray, shape (panels, nodes)
        [m] and [-].

    Examples
    --------
    >>> _, values = panel_values(lambda r: r**-2, np.array([1.0, 2.0, 4.0]))
    >>> values.sum(axis=1).round(12).tolist()
    [0.5, 0.25]
    """
    if density is None:
        return np.empty((edges.size - 1, 0)), np.empty((edges.size - 1, 0))
    logs = np.log(edges)
    half = np.diff(logs)[:, None] / 2.0
    radius = np.clip(np.exp(logs[:-1, None] + half * (_NODES + 1.0)), edges[0], edges[-1])
    return radius, half * _WEIGHTS * radius * np.asarray(density(radius), dtype=float)


def resolved_edges(density: Density, edges: NDArray) -> NDArray:
    """Return the edges with more between them, until panels hold the density to rounding.

    Parameters
    ----------
    density : callable
        By number, smooth between the edges [1/m].
    edges : ndarray, shape (n,)
        Increasing [m].

    Returns
    -------
    ndarray, shape (panels+1,)
        The edges among them [m].

    Examples
    --------
    >>> resolved_edges(lambda r: 1 / r, np.array([1.0, 2.0])).round(6).tolist()
    [1.0, 1.414214, 2.0]
    """
    parts = np.maximum(np.ceil(np.diff(np.log(edges)) / _WIDEST), 1).astype(int)
    pairs = zip(edges[:-1], edges[1:], parts, strict=True)
    pieces = [np.geomspace(a, b, n, endpoint=False) for a, b, n in pairs]
    edges = np.append(np.concatenate(pieces), edges[-1])
    for _ in range(50):
        radius, values = panel_values(density, edges)
        rough = np.zeros(edges.size - 1, dtype=bool)
        for part in (values, values * (radius / edges[-1]) ** 3):
            tail = np.abs(part @ _TO_SERIES[:, -3:]).max(axis=1)
            rough |= tail > _RESOLVED * np.sum(part)
        rough &= np.diff(np.log(edges)) > 1e-12
        if not rough.any():
            break
        edges = np.union1d(edges, np.sqrt(edges[:-1] * edges[1:])[rough])
    return edges
