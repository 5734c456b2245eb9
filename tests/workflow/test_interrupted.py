"""After any end the same command goes on, and computes again nothing that was finished."""

from itertools import product

from benchmarks.kills import SIGNALS, VICTIMS, kill_over_and_over

TARGET = ["results/tiny/jamming.csv"]


def test_a_study_killed_twelve_times_ends_as_if_it_had_not_been(tmp_path):
    records = kill_over_and_over(tmp_path, kills=12, seed=13, targets=TARGET)
    assert [record for record in records if record["broken"]] == []
    pairs = {(record["signal"], record["victim"]) for record in records}
    assert pairs == set(product(SIGNALS, VICTIMS))
    assert sum(record["jobs"] > 0 for record in records) >= len(SIGNALS)
