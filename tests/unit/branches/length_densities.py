"""Gradings, and what Eq. 4 says of them by another rule than the one under test."""

import numpy as np
import pytest

from branchcrush.gradings.forms import fractal, lognormal, uniform

RADIUS_MAX = 1e-3
GRADINGS = {
    "uniform, ratio 200": uniform(RADIUS_MAX / 200, RADIUS_MAX),
    "uniform, ratio 2": uniform(RADIUS_MAX / 2, RADIUS_MAX),
    "fractal 2.6, ratio 200": fractal(RADIUS_MAX / 200, RADIUS_MAX, 2.6),
    "fractal 2.5, ratio 1000": fractal(RADIUS_MAX / 1000, RADIUS_MAX, 2.5),
    "lognormal by mass": lognormal(RADIUS_MAX / 4, 1.7, RADIUS_MAX / 50, RADIUS_MAX, "mass"),
}
any_grading = pytest.mark.parametrize("grading", GRADINGS.values(), ids=GRADINGS)


def length_nodes(grading, points=16):
    """Return Gauss-Legendre nodes and weights over all branch lengths, and the panels' edges.

    The panels grow from 2 R_m and from the kink at R_m + R_M, where a fractal density is steep.
    """
    radius_min, radius_max = grading.support()
    span = radius_max - radius_min
    growing = np.append(0, np.geomspace(1e-5 * span, span, 30))
    low, kink = 2 * radius_min + growing, radius_min + radius_max + growing
    edges = np.append(low[:-1], kink)
    x, w = np.polynomial.legendre.leggauss(points)
    half = np.diff(edges)[:, None] / 2
    return (edges[:-1, None] + half * (x + 1)).ravel(), (half * w).ravel(), edges


def moments_of_length(grading):
    """<l^0> to <l^3> by the moments of radius."""
    r1, r2, r3 = (grading.moment(k) for k in (1, 2, 3))
    return [1.0, 2 * r1, 2 * r2 + 2 * r1**2, 2 * r3 + 6 * r1 * r2]


def density_of_lengths(grading, length):
    """Return the convolution of Eq. 4 by tanh-sinh, another rule than the one under test."""
    start, end = grading.support()
    length = np.asarray(length)[:, None]
    low, high = np.maximum(start, length - end), np.minimum(end, length - start)
    t = np.linspace(-3.5, 3.5, 1201)
    angle = np.pi / 2 * np.sinh(t)
    half = (high - low) / 2
    radius = np.clip((low + high) / 2 + half * np.tanh(angle), low, high)
    weight = half * np.pi / 2 * np.cosh(t) / np.cosh(angle) ** 2 * (t[1] - t[0])
    other = np.clip(length - radius, start, end)
    return np.sum(weight * grading.number_pdf(radius) * grading.number_pdf(other), axis=1)
