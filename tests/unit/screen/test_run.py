"""What is done, what is left, and about how long it takes."""

from snakemake_logger_plugin_branchcrush.run import Job, Run


def packing(number, begun, sample="paper"):
    return Job(number, "compression", {"sample": sample, "seed": str(number)}, "", begun)


def test_time_left_is_that_of_the_packings_done_over_those_at_once():
    run = Run()
    run.plan({"compression": 6, "report": 1, "all": 1, "total": 8})
    assert run.seconds_left(0.0) is None
    run.begin(packing(1, 0.0))
    run.begin(packing(2, 0.0))
    run.finish(1, 100.0)
    run.begin(packing(3, 100.0))
    # 100 s each: 3 wait, the second is due now, the third in 100 s, and two go at once.
    assert run.seconds_left(100.0) == (3 * 100 + 0 + 100) / 2
    run.finish(2, 140.0)
    # 120 s each: 3 wait, the third has 80 s to go.
    assert run.seconds_left(140.0) == (3 * 120 + 80) / 2


def test_packings_of_twice_the_steps_count_only_until_another_is_done():
    run = Run()
    run.plan({"compression": 3})
    run.begin(packing(1, 0.0, "paper-refined"))
    run.finish(1, 200.0)
    assert run.seconds_left(200.0) == 400.0
    run.begin(packing(2, 200.0))
    run.finish(2, 300.0)
    assert run.seconds_left(300.0) == 100.0


def test_jobs_are_counted_by_their_kind_also_in_a_module():
    run = Run()
    run.plan({"sand_compression": 2, "sand_sharing": 1, "sand_all": 1, "own": 1, "total": 5})
    assert (run.packings, run.steps) == (2, 2)
    run.begin(Job(1, "sand_compression", {}, "", 0.0))
    run.begin(Job(2, "sand_sharing", {"sample": "sand"}, "", 0.0))
    assert (len(run.running_packings), len(run.running_others)) == (1, 1)
    for number in (1, 2, 99):
        run.finish(number, 1.0)
    assert (run.packings_done, run.steps_done) == (1, 1)
    assert run.has_finished(["sharing"])
    assert not run.has_finished(["all"])
