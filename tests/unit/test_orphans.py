"""What a run begins does not outlive it, whichever of its processes is killed, and when."""

from benchmarks.orphans import VICTIMS, tries


def test_no_process_lives_on_when_one_of_a_run_is_killed_at_a_random_moment():
    records = tries(24, seed=3)
    assert [record for record in records if record["live_on"]] == []
    # Some before LAMMPS has begun, and some after.
    assert 0 < sum(record["lammps_ran"] for record in records) < len(records)
    assert {record["victim"] for record in records} == set(VICTIMS)
