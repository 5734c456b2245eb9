"""Rule grading: the grading that the seeds realise, beside the target and the ultimate."""

from collections.abc import Sequence

from numpy.typing import ArrayLike

from branchcrush.gradings.curves import grading_table, ultimate_grading
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.representativity import representativity, representativity_report


def grading_results(
    grading: Grading,
    grains: int,
    solid_fraction: float,
    radii: Sequence[ArrayLike],
    *,
    ultimate_alpha: float,
) -> tuple[dict, dict]:
    """Return the target grading beside what the seeds realise, and how well they stand for it.

    Parameters
    ----------
    grading : Grading
        Target.
    grains : int
        N of one packing.
    solid_fraction : float
        At the end of the loading, or about what its stress leads to [-].
    radii : list of array_like
        Of the grains of each seed [m].
    ultimate_alpha : float
        Of the fractal grading that crushing leads to [-].

    Returns
    -------
    table : dict of ndarray
        From `gradings.curves.grading_table`.
    report : dict
        From `gradings.representativity.representativity_report`.

    Examples
    --------
    >>> from branchcrush.gradings.forms import uniform
    >>> table, report = grading_results(uniform(1.0, 2.0), 2, 0.7, [[1.0, 2.0]], ultimate_alpha=2.6)
    >>> report["representativity"]["grains"], report["representativity"]["verdict"]
    (2, 'refuse')
    """
    ultimate = ultimate_grading(grading, ultimate_alpha)
    standing = representativity(grading, grains, solid_fraction)
    return (
        grading_table(grading, radii, ultimate),
        representativity_report(standing, grading, radii),
    )
