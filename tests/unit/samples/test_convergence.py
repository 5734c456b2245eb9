"""Two runs of the same seeds on invented contacts, whose differences are known beforehand."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.samples.convergence import convergence_table
from branchcrush.statistics.bins import bin_edges, binned_sums

EDGES = bin_edges(5e-6, 1e-3, 20)
CENTRES = (EDGES[1:] + EDGES[:-1]) / 2


def sums_of(exponent, lengths=CENTRES):
    """Return the binned energies of branches that follow l^n exactly, ten of each length."""
    length = np.tile(lengths, 10)
    return binned_sums(length, length**exponent, EDGES)


def path_of(**end):
    """Return a path whose end has these values, and 1 in all others."""
    names = ("mean_stress_Pa", "elastic_energy_J", "work_J", "coordination_number")
    names += ("mechanical_coordination_number", "force_evaluations", "solid_fraction")
    table = {name: [0.0, 0.5, end.get(name, 1.0)] for name in names}
    states = {"state": [0, 1, 2], "leg": "loading", "carries_load": [False, True, True]}
    return pd.DataFrame({**states, **table})


def certificate_of(*certified_ends):
    """Return a `certificate.csv` of seeds that are certified at their end or not."""
    rows = [
        {"seed": seed, "state": state, "leg": "loading", "certified": (False, True, end)[state]}
        for seed, end in enumerate(certified_ends)
        for state in range(3)
    ]
    return pd.DataFrame(rows)


def run(exponents, stresses):
    paths = [path_of(mean_stress_Pa=stress) for stress in stresses]
    return paths, [sums_of(exponent) for exponent in exponents]


def test_differences_of_pairs_are_those_put_in():
    once, twice = run([3.0, 3.0], [1.0, 2.0]), run([3.2, 3.2], [1.3, 2.1])
    certificates = [certificate_of(True, True)] * 2
    table = convergence_table(certificates, once, twice).set_index("quantity")
    exponent, stress = table.loc["exponent"], table.loc["mean_stress_Pa"]
    assert_allclose([exponent["value"], exponent["value_at_twice_the_steps"]], [3.0, 3.2])
    assert_allclose(exponent["difference"], 0.2, rtol=1e-8)
    assert_allclose(exponent["standard_error_of_difference"], 0.0, atol=1e-9)
    assert_allclose([stress["value"], stress["value_at_twice_the_steps"]], [1.5, 1.7])
    assert_allclose(stress["difference"], 0.2)
    # Pairs of 0.3 and 0.1: a standard deviation of 0.2/sqrt(2), over sqrt(2).
    assert_allclose(stress["standard_error_of_difference"], 0.1)
    assert (table["seeds"] == 2).all()
    same = table.drop(["exponent", "mean_stress_Pa"])
    assert (same["difference"] == 0).all()
    assert "force_evaluations" in same.index


def test_scatter_of_packings_that_both_runs_share_is_no_error():
    once, twice = run([2.8, 3.2], [1.0, 5.0]), run([2.9, 3.3], [1.5, 5.5])
    certificates = [certificate_of(True, True)] * 2
    table = convergence_table(certificates, once, twice).set_index("quantity")
    errors = table.loc[["exponent", "mean_stress_Pa"], "standard_error_of_difference"]
    assert_allclose(errors, 0.0, atol=1e-8)


def test_only_seeds_certified_in_both_runs_are_compared():
    once, twice = run([3.0] * 3, [1.0, 2.0, 4.0]), run([3.0] * 3, [9.0, 2.5, 9.0])
    # The first run has a seed more that was not run again.
    certificates = [certificate_of(True, True, False, True), certificate_of(False, True, True)]
    table = convergence_table(certificates, once, twice).set_index("quantity")
    stress = table.loc["mean_stress_Pa"]
    assert (stress["seeds"], stress["value"], stress["value_at_twice_the_steps"]) == (1, 2.0, 2.5)
    assert np.isnan(stress["standard_error_of_difference"])


@pytest.mark.parametrize(
    "certificates",
    [
        [],
        [certificate_of(True, False), certificate_of(False, True)],
        [certificate_of(False, False), certificate_of(True, True)],
    ],
    ids=["no seed run twice", "no seed certified in both", "none certified in one"],
)
def test_without_a_seed_in_both_runs_the_table_is_empty_and_keeps_its_columns(certificates):
    both = run([3.0] * 2, [1.0] * 2)
    runs = (both, both) if certificates else (([], []), ([], []))
    table = convergence_table(certificates, *runs)
    assert len(table) == 0
    assert {"quantity", "seeds", "value", "difference"} <= set(table)


def test_grains_of_one_size_are_compared_in_all_but_the_exponent():
    once, twice = run([3.0] * 2, [1.0, 2.0]), run([3.0] * 2, [1.3, 2.1])
    for _, sums in (once, twice):
        sums[:] = [sums_of(3.0, lengths=CENTRES[9])] * 2
    certificates = [certificate_of(True, True)] * 2
    table = convergence_table(certificates, once, twice).set_index("quantity")
    assert table.loc["exponent", ["value", "difference"]].isna().all()
    assert_allclose(table.loc["mean_stress_Pa", "difference"], 0.2)
