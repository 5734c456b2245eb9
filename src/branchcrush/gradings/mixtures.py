"""Gradings of single sizes, and gradings made of others."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.errors import GradingError
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.truncation import is_by_mass


def single(radius: float) -> Grading:
    r"""Return the grading of one size.

    .. math:: P(R') = \delta(R' - R)

    Parameters
    ----------
    radius : float
        R [m].

    Returns
    -------
    Grading

    Raises
    ------
    GradingError
        Unless the radius is positive.

    Examples
    --------
    >>> single(2.0).moment(3)
    8.0
    """
    return Grading(radii=[radius], weights=[1.0])


def from_radii(radii: ArrayLike) -> Grading:
    r"""Return the grading of given grains, each counting alike.

    .. math:: P(R) = \frac{1}{n} \sum_i \delta(R - R_i)

    Parameters
    ----------
    radii : array_like, shape (n,)
        R_i [m].

    Returns
    -------
    Grading

    Raises
    ------
    GradingError
        When there are none, or one is not positive.

    Examples
    --------
    >>> from_radii([1.0, 2.0, 2.0, 3.0]).number_cdf(2.0).item()
    0.75
    """
    return Grading(radii=radii, weights=np.ones(np.size(radii)))


def mixture(gradings: Sequence[Grading], weights: ArrayLike, by: str) -> Grading:
    r"""Return the mixture of gradings in parts by number or by mass.

    .. math:: P(R) = \sum_i \nu_i P_i(R), \qquad
        \nu_i \propto w_i \text{ by number}, \quad w_i / \langle R^3 \rangle_i \text{ by mass}

    Parameters
    ----------
    gradings : list of Grading
    weights : array_like, shape (n,)
        w_i of each grading; their sum does not matter [-].
    by : {"number", "mass"}

    Returns
    -------
    Grading

    Raises
    ------
    GradingError
        When a weight is not positive, or `by` is another word.

    Examples
    --------
    >>> half = mixture([single(1.0), single(2.0)], [1.0, 1.0], by="mass")
    >>> half.number_cdf(1.0).round(9).item()
    0.888888889
    """
    share = np.asarray(weights, dtype=float)
    if not (share.size == len(gradings) > 0 and np.all(share > 0)):
        raise GradingError(f"a mixture needs one weight above 0 for each part, not {share}")
    if is_by_mass(by):
        share = share / [grading.moment(3) for grading in gradings]
    share = share / share.sum()
    parts = [grading.discrete_part for grading in gradings]
    smooth = [(w, g) for w, g in zip(share, gradings, strict=True) if not g.is_discrete]

    def density(radius: NDArray) -> NDArray:
        densities = (weight * grading.continuous_pdf(radius) for weight, grading in smooth)
        return sum(densities, start=np.zeros(radius.shape))

    return Grading(
        density if smooth else None,
        np.concatenate([[], *(grading.breaks for _, grading in smooth)]),
        np.concatenate([radii for radii, _ in parts]),
        np.concatenate([w * within for w, (_, within) in zip(share, parts, strict=True)]),
    )
