"""Rule grading: the grading that the seeds realise, beside the target and the ultimate."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from branchcrush.branches.load_bearing import load_bearing
from branchcrush.branches.nodes import grading_nodes
from branchcrush.errors import FitError
from branchcrush.gradings.curves import grading_table, ultimate_grading
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.representativity import representativity, representativity_report
from branchcrush.gradings.size_fits import SizeFit
from branchcrush.packings.geometry import cube, solid_volume


def grading_results(
    grading: Grading,
    grains: int,
    solid_fraction: float,
    radii: Sequence[ArrayLike],
    *,
    ultimate_alpha: float,
    fits: Mapping[str, SizeFit] | None = None,
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
    fits : mapping of SizeFit, optional
        Curves through a few diameters [m] that the grading is made of, by key.

    Returns
    -------
    table : dict of ndarray
        From `gradings.curves.grading_table`.
    report : dict
        From `gradings.representativity.representativity_report`, with `size_fits` where there are,
        and `rods`: which grains carry load at jamming, by rods that push.

    Examples
    --------
    >>> from branchcrush.gradings.forms import uniform
    >>> table, report = grading_results(uniform(1.0, 2.0), 2, 0.7, [[1.0, 2.0]], ultimate_alpha=2.6)
    >>> report["representativity"]["grains"], report["representativity"]["verdict"]
    (2, 'refuse')
    """
    ultimate = ultimate_grading(grading, ultimate_alpha)
    standing = representativity(grading, grains, solid_fraction)
    report = representativity_report(standing, grading, radii)
    if fits:
        report["size_fits"] = {key: fit.report() for key, fit in fits.items()}
    report["rods"] = _by_rods(grading)
    return grading_table(grading, radii, ultimate), report


def mean_packing(packings: Sequence[tuple[ArrayLike, ArrayLike, float]]) -> tuple[int, float]:
    """Return how many grains packings have, and their solid fraction, the means of all.

    Parameters
    ----------
    packings : list of tuple
        Positions, radii [m] and edge of the cell [m] of each.

    Returns
    -------
    grains : int
    solid_fraction : float
        [-]

    Examples
    --------
    >>> grains, phi = mean_packing([([[0.0, 0.0, 0.0]], [0.5], 1.0)])
    >>> grains, round(phi, 4)
    (1, 0.5236)
    """
    fractions = [solid_volume(radii) / cube(edge) for _, radii, edge in packings]
    grains = round(float(np.mean([np.size(radii) for _, radii, _ in packings])))
    return grains, float(np.mean(fractions))


def _by_rods(grading: Grading) -> dict:
    try:
        found = load_bearing(*grading_nodes(grading))
    except FitError as error:
        return {"reason": str(error)}
    return {
        "jamming_solid_fraction": found.solid_fraction,
        "load_bearing_by_number": found.by_number,
        "load_bearing_by_mass": found.by_mass,
        "finest_load_bearing_diameter_m": 2.0 * found.finest,
        "coordination_number": found.coordination_number,
    }
