"""Intervals hold the exponent of packings that each have an exponent of their own."""

import numpy as np
import pytest

from branchcrush.energy.curvature import curvature
from branchcrush.energy.designs import log_length
from branchcrush.energy.predictors import PREDICTORS
from branchcrush.statistics.bins import bin_edges, binned_sums
from branchcrush.statistics.gamma_regression import gamma_fit, parameter_intervals
from branchcrush.statistics.power_law import binned_exponent

EDGES = bin_edges(0.05, 1.0)
CENTRES = (EDGES[1:] + EDGES[:-1]) / 2
TRIALS = 400
RESAMPLES = 300
# Near this length, over R_max, are most branches: there the seeds' laws of their own cross.
CROSSING = 1.3


def packing(rng, exponent, scatter, bend=0.0):
    """Return the branches of a packing whose force network is its own, as predictors take them.

    Amplitude, exponent, number of branches and their lengths are random. All lengths of a bin are
    equal: the mean of l^n over a bin is not the mean of l to the n.
    """
    branches = rng.integers(150, 401)
    length = rng.triangular(0.1, rng.uniform(1.0, 1.6), 2.0, branches)
    length = CENTRES[np.searchsorted(EDGES[1:-1], length, side="right")]
    own = exponent + scatter * rng.standard_normal()
    x = np.log(length / CROSSING)
    mean = np.exp(0.3 * rng.standard_normal() + own * x + bend * x**2)
    share = rng.uniform(0.1, 0.5, branches)
    energy = mean * rng.standard_exponential(branches)
    return np.log(share * length), np.log((1.0 - share) * length), energy


@pytest.fixture(scope="module", params=[12, 5])
def covered(request):
    """Return, of each method, how large a share of the intervals holds what it should."""
    rng = np.random.default_rng(request.param)
    law = PREDICTORS["branch_length"].design
    held = {"binned": 0, "all branches": 0, "curvature": 0}
    for _ in range(TRIALS):
        exponent, scatter = rng.uniform(2.0, 4.0), rng.uniform(0.1, 0.2)
        seeds = [packing(rng, exponent, scatter) for _ in range(request.param)]
        sums = [binned_sums(np.exp(log_length(s, g)), energy, EDGES) for s, g, energy in seeds]
        _, binned = binned_exponent(sums, resamples=RESAMPLES, rng=rng)
        held["binned"] += binned.low <= exponent <= binned.high
        whole = parameter_intervals(gamma_fit(seeds, law), resamples=RESAMPLES, rng=rng)
        held["all branches"] += whole.low[1] <= exponent <= whole.high[1]
        bend = curvature(seeds, resamples=RESAMPLES).curvature
        held["curvature"] += bend.low <= 0.0 <= bend.high
    return {method: number / TRIALS for method, number in held.items()}


@pytest.mark.parametrize("method", ["binned", "all branches"])
def test_interval_of_the_exponent_covers_the_one_that_packings_scatter_about(covered, method):
    assert 0.90 <= covered[method] <= 0.98


def test_interval_of_the_curvature_covers_0_where_the_law_is_a_power_law(covered):
    assert 0.90 <= covered["curvature"] <= 0.98


@pytest.mark.parametrize(("number", "seen"), [(12, 0.95), (5, 0.9)])
def test_curvature_is_seen_where_there_is_some(number, seen):
    rng = np.random.default_rng(number + 1)
    found = [
        curvature(
            [packing(rng, 3.0, 0.15, 0.8) for _ in range(number)], resamples=RESAMPLES
        ).curvature
        for _ in range(TRIALS // 2)
    ]
    low, high = (np.array([getattr(bend, end) for bend in found]) for end in ("low", "high"))
    assert np.mean(low > 0.0) > seen
    assert np.mean((low <= 0.8) & (high >= 0.8)) >= 0.9
