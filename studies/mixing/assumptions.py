"""What the paper assumes of crushing, each beside what was measured.

Eq. 7: branch lengths mix in proportion, whatever the length. Eq. 15: so do their moments. One
exponent n for all states. No branch density in the energy. No jamming point that moves.
"""

from collections.abc import Mapping

import numpy as np
import pandas as pd
from along import SeedPath
from measured import Paths, difference, mean_interval
from numpy.typing import NDArray
from pairs import Pair
from scipy.optimize import minimize_scalar

from branchcrush.branches.predictions import fine_edges
from branchcrush.statistics.intervals import Interval

# Elastic strain at which they are told [-].
LEVEL = 0.04


def assumption_rows(pair: Pair, paths: Paths) -> list[dict]:
    """Return a row for each mixture: what of the paper's assumptions was measured there."""
    lengths = {
        crushing: _lengths(pair, seeds) for crushing, seeds in paths.items() if len(seeds) > 0
    }
    rows = []
    for sample in pair.samples:
        seeds = paths[sample.crushing]
        if not seeds:
            continue
        row = {
            "sample": sample.name,
            "pair": pair.name,
            "law": pair.law,
            "crushing": sample.crushing,
            "elastic_strain": LEVEL,
            **_over_seeds(seeds, "exponent").named("exponent"),
            **_ratio(paths, sample.crushing, "branch_density_per_m3").named("density_ratio"),
            **mean_interval(np.array([seed.jamming for seed in seeds])).named(
                "jamming_solid_fraction"
            ),
        }
        if 0.0 in lengths and 1.0 in lengths:
            parts = lengths[sample.crushing], lengths[0.0], lengths[1.0]
            best, distance = best_mixture(*parts)
            row |= {
                "mixed_by_crushing": mixture_distance(*parts, sample.crushing),
                "best_share": best,
                "mixed_at_best": distance,
                "crushing_by_moments": _by_moments(paths, sample.crushing),
            }
        rows.append(row)
    return rows


def mixture_distance(counts: NDArray, initial: NDArray, ultimate: NDArray, share: float) -> float:
    r"""Return how far branch lengths are from a mixture of two others.

    .. math:: D(c) = \max_l |F(l) - (1 - c) F_0(l) - c F_u(l)|

    Parameters
    ----------
    counts, initial, ultimate : ndarray, shape (n,)
        Branches in the same bins of length.
    share : float
        c of the ultimate ones, by the paper's Eq. 7 its C [-].

    Returns
    -------
    float
        [-]

    Examples
    --------
    >>> whole, half = np.array([4.0, 0.0]), np.array([2.0, 2.0])
    >>> mixture_distance(half, whole, whole[::-1], 0.25)
    0.25
    """
    measured, first, last = (np.cumsum(part) / np.sum(part) for part in (counts, initial, ultimate))
    return float(np.abs(measured - (1.0 - share) * first - share * last).max())


def best_mixture(counts: NDArray, initial: NDArray, ultimate: NDArray) -> tuple[float, float]:
    """Return the mixture of two distributions that is nearest to a third, and its distance.

    Parameters
    ----------
    counts, initial, ultimate
        As for `mixture_distance`.

    Returns
    -------
    share, distance : float
        c and D(c) [-].

    Examples
    --------
    >>> whole, half = np.array([4.0, 0.0]), np.array([2.0, 2.0])
    >>> [round(value, 4) for value in best_mixture(half, whole, whole[::-1])]
    [0.5, 0.0]
    """
    # The largest of distances that are straight in c, or bent upward: one minimum.
    best = minimize_scalar(
        lambda share: mixture_distance(counts, initial, ultimate, share),
        bounds=(0.0, 1.0),
        method="bounded",
        options={"xatol": 1e-6},
    )
    return float(best.x), float(best.fun)


def fraction_rows(pair: Pair, paths: Paths, predictions: pd.DataFrame) -> list[dict]:
    """Return a row for each mixture: energy at the solid fraction that C = 0 ends at.

    There the paper's and Einav's energy change with C alone; what jams later has none.
    """
    if not paths[0.0]:
        return []
    fraction = min(float(path.values["solid_fraction"][-1]) for path in paths[0.0])
    said = predictions.set_index(["sample", "form"])
    alone = np.log([path.at("solid_fraction", fraction)["energy_J_per_m3"] for path in paths[0.0]])
    rows = []
    for sample in pair.samples[1:]:
        seeds = paths[sample.crushing]
        if not seeds:
            continue
        # One that does not tell its jamming point carried load from the start.
        jammed = [not path.jamming >= fraction for path in seeds]
        row = {
            "sample": sample.name,
            "pair": pair.name,
            "law": pair.law,
            "crushing": sample.crushing,
            "solid_fraction": fraction,
            "jammed": sum(jammed),
            "seeds": len(seeds),
        }
        if any(jammed):
            energy = [path.at("solid_fraction", fraction)["energy_J_per_m3"] for path in seeds]
            found = difference(np.log(energy), alone)
            row |= Interval(*map(float, np.exp(found))).named("energy_ratio")
        else:
            row["energy_ratio"] = 0.0
        start = said.loc[(pair.samples[0].name, "moving_jamming"), "jamming_solid_fraction"]
        for form in ("moving_jamming", "paper", "einav", "tengattini"):
            factor, moved = said.loc[(sample.name, form), ["stiffness_ratio", "jamming_ratio"]]
            strains = np.array([1.0 - start * moved / fraction, 1.0 - start / fraction])
            # Psi_J per volume at jamming, over 1 - eps per volume now.
            terms = np.maximum(strains, 0.0) ** pair.energy_exponent / (1.0 - strains)
            row[f"{form}_energy_ratio"] = factor * terms[0] / terms[1]
        rows.append(row)
    return rows


def _lengths(pair: Pair, seeds: list[SeedPath]) -> NDArray:
    """Return the branches of all seeds in narrow bins over the lengths of both gradings."""
    supports = pair.initial.support(), pair.ultimate.support()
    edges = fine_edges(min(s[0] for s in supports), max(s[1] for s in supports))
    return sum(np.histogram(seed.nearest(LEVEL).length, edges)[0] for seed in seeds)


def _at(seeds, name):
    return np.array([seed.at("elastic_strain", LEVEL)[name] for seed in seeds])


def _over_seeds(seeds, name):
    return mean_interval(_at(seeds, name))


def _ratio(paths: Mapping, crushing: float, name: str) -> Interval:
    logarithms = (np.log(_at(paths[part], name)) for part in (crushing, 0.0))
    return Interval(*map(float, np.exp(difference(*logarithms))))


def _by_moments(paths: Paths, crushing: float) -> float:
    """Return C by Eq. 15 with the measured moments of the length, n = 3."""
    here, initial, ultimate = (
        np.nanmean(_at(paths[part], "mean_cube_length_m3")) for part in (crushing, 0.0, 1.0)
    )
    return float((initial - here) / (initial - ultimate))
