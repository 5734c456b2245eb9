"""Shielding by branch: the energy of branches of equal length against the ratio of their radii."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from branchcrush.energy.designs import LinearDesign, log_length, prepared
from branchcrush.energy.predictors import BranchColumns, branch_columns
from branchcrush.energy.shielding import LARGER, ROUNDING, claim_answer
from branchcrush.packings.network import Network
from branchcrush.statistics.bins import bin_numbers
from branchcrush.statistics.gamma_regression import gamma_fit, parameter_intervals
from branchcrush.statistics.power_law import power_law_fit
from branchcrush.statistics.resampling import pooled_interval

# Edges of r_min/r_max.
RADIUS_RATIOS = np.array([0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0])
_BINS = RADIUS_RATIOS.size - 1
# The bins up to the claim's ratio.
_AS_CLAIMED = int(np.searchsorted(RADIUS_RATIOS, 1.0 / LARGER))
# Energies of single branches scatter more than those of grains: ten at random, of the scatter that
# is measured, give intervals of 95 % that cover 80 %, thirty give 90 %.
_FEWEST = 30
# Bins of branch length in which the power law of equal lengths is fitted.
_LENGTHS = 60


def network_branches(network: Network, radius_max: float) -> BranchColumns:
    """Return the branches of a network as `branch_shielding` takes them, of one seed.

    Parameters
    ----------
    network : Network
    radius_max : float
        Of the grading [m].

    Returns
    -------
    tuple of ndarray
        As `energy.predictors.branch_columns`.
    """
    return branch_columns(network.radius_i, network.radius_j, network.energy, radius_max)


# ln A + n ln l + s ln(r_min/r_max).
_LENGTH_AND_RATIO = LinearDesign(
    lambda small, large: [log_length(small, large), small - large], [3.0, 0.0]
)


def branch_shielding(
    seeds: Sequence[BranchColumns],
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> tuple[dict[str, NDArray], dict[str, float | str]]:
    r"""Return the mean energy of branches of equal length against the ratio of their radii.

    .. math:: \frac{\langle E \rangle_q}{\langle A\, l^n \rangle_q}, \qquad
        \langle E \rangle \sim l^n \left(\frac{r_{min}}{r_{max}}\right)^s

    The ratio is that to what branches of the same lengths hold on average, with A and n fitted to
    all branches, and fitted anew in every draw. s is 0 without shielding; energies vanish for
    unequal grains when it is large.

    Parameters
    ----------
    seeds : list of tuple
        From `energy.predictors.branch_columns`, of each seed.
    confidence, resamples, rng
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    table : dict of ndarray
        radius_ratio_low, radius_ratio_high (a ratio on an edge is in the bin below), the
        mean_radius_ratio, branches, energy_ratio with _low and _high.
    summary : dict
        shielding_exponent s and length_exponent n of the fit of both, with _low and _high; of the
        branches up to `radius_ratio_to`, `unequal_branches` and unequal_over_equal, their ratio
        over that of the last bin, with _low and _high; and claim, as `shielding.claim_answer`: no
        such branch up to a ratio of 0.1, undecided with fewer than thirty of them.

    Raises
    ------
    FitError
        As `statistics.gamma_regression.gamma_fit`, and as `statistics.power_law.power_law_fit` of
        any draw.
    """
    options: dict[str, Any] = {"confidence": confidence, "resamples": resamples, "rng": rng}
    design, made = prepared(_LENGTH_AND_RATIO, seeds)
    both = gamma_fit(made, design)
    del made
    edges = _length_edges(seeds)
    sums = np.array([_seed_sums(*seed, edges) for seed in seeds])
    count, length, ratio, _ = sums.sum(axis=0)
    filled = count.sum(axis=1) > 0
    length = length.sum(axis=1)[filled] / count.sum(axis=1)[filled]
    branches, ratio = count.sum(axis=0), ratio.sum(axis=0)
    unequal = np.cumsum(branches)
    # As unequal as the claim says, or where there are too few, the most unequal there are.
    to = min(max(_AS_CLAIMED, int(np.searchsorted(unequal, _FEWEST)) + 1), _BINS)
    ratios = pooled_interval(
        sums, lambda totals: _energy_ratios(totals[:, :, filled], length, to), **options
    )
    limits = parameter_intervals(both, **options)
    with np.errstate(invalid="ignore"):
        mean_ratio = ratio / branches
    unequal_over_equal = ratios.part(-1)
    # Branches less unequal than the claim's are counted for what they hold, and do not answer it.
    as_claimed = int(unequal[_AS_CLAIMED - 1])
    table = {
        "radius_ratio_low": RADIUS_RATIOS[:-1],
        "radius_ratio_high": RADIUS_RATIOS[1:],
        "mean_radius_ratio": mean_ratio,
        "branches": branches.astype(int),
        **ratios.part(slice(-1)).named("energy_ratio"),
    }
    return table, {
        **limits.part(1).named("length_exponent"),
        **limits.part(2).named("shielding_exponent"),
        "radius_ratio_to": float(RADIUS_RATIOS[to]),
        "unequal_branches": int(unequal[to - 1]),
        **unequal_over_equal.named("unequal_over_equal"),
        "claim": claim_answer(unequal_over_equal, as_claimed, _FEWEST, "branch"),
    }


def _length_edges(seeds: Sequence[BranchColumns]) -> NDArray:
    # One seed may have no branch that carries energy, all together have: they were fitted.
    logs = np.concatenate([log_length(small, large) for small, large, _ in seeds])
    first, last = logs.min(), logs.max()
    return np.linspace(first, max(last, first + 1e-6), _LENGTHS + 1)


def _seed_sums(small: NDArray, large: NDArray, energy: NDArray, edges: NDArray) -> NDArray:
    """Return what one seed has in each bin of length and of ratio, shape (4, lengths, bins).

    BranchColumns, and the sums of their lengths over R_max, of their ratios and of their energies.
    """
    log, ratio = log_length(small, large), np.exp(small - large)
    group = np.searchsorted(RADIUS_RATIOS * (1.0 + ROUNDING), ratio, side="left") - 1
    cell = bin_numbers(log, edges) * _BINS + np.clip(group, 0, _BINS - 1)
    parts = (None, np.exp(log), ratio, energy)
    sums = [np.bincount(cell, part, _BINS * _LENGTHS) for part in parts]
    return np.array(sums, dtype=float).reshape(4, _LENGTHS, _BINS)


def _energy_ratios(totals: NDArray, length: NDArray, to: int) -> NDArray:
    """Return the ratios of the energies of each draw to those of branches of the same lengths.

    Totals are of the draws in the bins of length that have branches, shape (draws, 4, L, bins). In
    the last column stand the bins up to `to` over the last bin.
    """
    number, energy = totals[:, 0], totals[:, 3]
    weight = number.sum(axis=2)
    mean = energy.sum(axis=2) / np.maximum(weight, 1.0)
    law = power_law_fit(length, mean, weight)
    amplitude, exponent = np.asarray(law.amplitude), np.asarray(law.exponent)
    per_branch = amplitude[:, None] * length ** exponent[:, None]
    held, expected = energy.sum(axis=1), (number * per_branch[..., None]).sum(axis=1)
    # The draw's own scale: what is said is how branches of one draw compare.
    scale = held.sum(axis=1) / expected.sum(axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        by_bin = held / expected / scale[:, None]
        few = held[:, :to].sum(axis=1) / expected[:, :to].sum(axis=1) / scale
        return np.concatenate([by_bin, (few / by_bin[:, -1])[:, None]], axis=1)
