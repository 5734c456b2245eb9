"""What benchmarks make of their measurements, by hand."""

import sys

import pytest

from benchmarks import cluster, dense, growth, large, mpi
from benchmarks.before import compared
from benchmarks.measure import MemoryOfChildren, run_timed
from benchmarks.sizes import estimate, line_of_size, power_of_size, shares


def run_of(cpu_s, evaluations, stress, jammed=0.64, stopped=""):
    return {
        "cpu_s": cpu_s,
        "evaluations": evaluations,
        "cpu_s_per_evaluation": cpu_s / evaluations,
        "inside_cpu_s_per_evaluation": 0.5 * cpu_s / evaluations,
        "mean_stress_Pa": stress,
        "energy_density_J_m3": 2.0,
        "mechanical_coordination_number": 6.0,
        "jamming_solid_fraction": jammed,
        "stopped": stopped,
    }


def test_pairs_of_two_checkouts():
    pairs = [
        {"this": run_of(3.0, 1000, 5.0), "other": run_of(4.0, 1000, 4.0)},
        {"this": run_of(3.0, 600, 9.0), "other": run_of(6.0, 800, 6.0)},
        {"this": run_of(8.0, 500, 8.0, jammed=float("nan")), "other": run_of(8.0, 250, 3.0)},
    ]
    found = compared(pairs)
    assert found["ended"] == 3
    assert found["ratio"]["cpu_s"]["median"] == 0.75
    assert found["ratio"]["evaluations"]["pairs"] == [1.0, 0.75, 2.0]
    assert found["ratio"]["cpu_s_per_evaluation"]["min"] == pytest.approx(0.5)
    # Differences 1, 3 and 5: standard deviation 2.
    stress = found["difference"]["mean_stress_Pa"]
    assert stress["mean"] == 3.0
    assert stress["standard_error"] == pytest.approx(2.0 / 3.0**0.5)
    assert not stress["agrees"]
    # Where a run has no jamming point, the other pairs tell.
    assert found["difference"]["jamming_solid_fraction"]["mean"] == 0.0


def test_a_pair_that_stopped_is_left_out():
    stopped = {"this": run_of(1.0, 10, 0.0, stopped="lost"), "other": run_of(9.0, 10, 4.0)}
    assert "ratio" not in compared([stopped])
    found = compared([stopped, {"this": run_of(3.0, 10, 4.0), "other": run_of(4.0, 10, 4.0)}])
    assert (found["pairs"], found["ended"]) == (2, 1)
    assert found["ratio"]["cpu_s"]["pairs"] == [0.75]


def test_evaluations_of_each_part_of_a_path():
    assert shares([30, 90]) == {
        "approach_evaluations": 30,
        "steps_evaluations": 0,
        "final_evaluations": 60,
    }
    assert sum(shares([10, 25, 60, 61, 400]).values()) == 400


def test_growth_scatters_about_its_power():
    # In logarithms to base 10: 1, 3, 2 over 0, 1, 2. Slope 1/2, and what is left is
    # -1/2, 1, -1/2: its square sum of 3/2 over one spare row and a spread of 2.
    rows = [{"grains": n, "s": s} for n, s in ((1, 10.0), (10, 1000.0), (100, 100.0))]
    growth = power_of_size(rows, "s")
    assert growth["power"] == pytest.approx(0.5)
    assert growth["standard_error"] == pytest.approx(0.75**0.5)
    assert growth["factor"] == pytest.approx(10.0**1.5)
    assert power_of_size(rows[:2], "s")["standard_error"] is None


def test_memory_grows_along_a_line():
    # The least squares of 1, 1, 4 over 0, 1, 2.
    rows = [{"grains": n, "MB": held} for n, held in ((0, 1.0), (1, 1.0), (2, 4.0))]
    assert line_of_size(rows, "MB") == pytest.approx({"start": 0.5, "per_grain": 1.5})


def test_a_million_from_the_largest_packing():
    rows = [
        {"grains": grains, "evaluations": number, "cpu_us_per_grain_and_evaluation": 0.25}
        for grains, number in ((1000, 7000), (10_000, 8000), (10_000, 10_000))
    ]
    growth = {
        "evaluations": {"power": 0.5},
        "cpu_us_per_grain_and_evaluation": {"power": 0.0},
        "peak_MB": {"start": 100.0, "per_grain": 0.002},
        "output_MB": {"start": 0.0, "per_grain": 0.0005},
    }
    told = estimate(rows, growth, 2.0, 1_000_000)
    # A hundred times the grains: ten times the evaluations, of 0.25 s.
    assert told["evaluations"] == pytest.approx(90_000)
    assert told["hours_on_1_core"] == pytest.approx(6.25)
    assert told["hours_on_8_ranks"] == pytest.approx(6.25 / 8.0)
    assert (told["peak_MB"], told["output_MB"]) == pytest.approx((2100.0, 500.0))
    assert estimate(rows, growth, None, 1_000_000)["hours_on_8_ranks"] is None


@pytest.mark.skipif(sys.platform != "linux", reason="memory is looked up in /proc")
def test_memory_of_two_processes_together():
    fill = "import time; held = bytearray(60_000_000); time.sleep(0.6)"
    both = f"import subprocess, sys; p = subprocess.Popen([sys.executable, '-c', '{fill}']); "
    with MemoryOfChildren(0.05) as memory:
        run_timed([sys.executable, "-c", f"{both}{fill}; p.wait()"])
    assert 120.0 < memory.peak_MB < 220.0


def test_a_state_of_a_small_packing_from_placement_on():
    result = large.run(grains=(60,), ratio=3.0, solid_fraction=0.72, seeds=(1,), jamming_grains=60)
    (row,) = result["rows"]
    assert row["state"]["solid_fraction"] == pytest.approx(0.72)
    parts = ("approach", "steps", "final")
    assert row["evaluations"] == sum(row[f"{part}_evaluations"] for part in parts)
    assert 0.5 < result["jamming_solid_fraction"] < 0.72


def test_an_evaluation_of_a_small_packing_costs_something_on_one_rank_and_two():
    tiny = {"forms": ("fractal 3",), "base": 100, "evaluations": 30}
    grown = growth.run(times=(1,), ratios=(), placed=(), repeats=1, **tiny)
    (row,) = grown["grains"]
    # Three strain steps of ten evaluations, and none of a loading: at least one list each.
    assert row["ns_per_grain_and_evaluation"] > 0 and row["list_entries"] > 1
    assert "jump" not in dense.head_of_script()
    speed = mpi.run(times=1, pairs=1, seeds=(), **tiny)["speed"]["fractal 3"]
    assert all(second > 0 for pair in speed["seconds"]["loop"] for second in pair)


def test_a_large_study_on_a_cluster_by_hand():
    found = cluster.expected(1000, 300.0, 40.0, 20.0, 23.0, 5.0, 10.0, nodes=2, cores=10)
    # Four of five minutes make twenty; 250 such jobs on 20 cores are 13 waves.
    assert (found["group"], found["jobs"]) == (4, 250)
    assert found["hours"] == pytest.approx(13 * 20 / 60)
    assert found["core_hours"] == pytest.approx(1000 / 12)
    assert (found["gigabytes"], found["files"], found["inodes"]) == (40.0, 20_000, 23_000)
    # Five a packing and ten a job, and a look at the queue every three minutes.
    assert found["requests_a_minute"] == pytest.approx((5000 + 2500 + 13 * 20 / 3) / (13 * 20))
