"""The table that moves at the foot of a terminal."""

import io

import pytest
from rich.console import Console

from snakemake_logger_plugin_branchcrush.progress import Progress
from snakemake_logger_plugin_branchcrush.run import Job, Run
from snakemake_logger_plugin_branchcrush.table import drawing


@pytest.fixture
def drawn():
    def draw(run, progress, now=0.0, width=80, height=24):
        stream = io.StringIO()
        console = Console(file=stream, width=width)
        console.print(drawing(run, progress, now, height))
        return [line.rstrip() for line in stream.getvalue().splitlines()]

    return draw


@pytest.fixture
def run():
    run = Run()
    run.plan({"compression": 20, "energy_split": 2, "all": 1, "total": 23})
    for number in (3, 4):
        sample = {"sample": "paper", "seed": str(number)}
        run.begin(Job(number, "compression", sample, "", 100.0))
    return run


def test_running_packings_counts_and_other_jobs_have_their_lines(run, drawn):
    run.begin(Job(30, "energy_split", {"sample": "sand"}, "", 0.0))
    lines = drawn(run, {3: Progress(7, "16", 0.6519, 1.23e7), 4: None}, now=175.0)
    words = [line.split() for line in lines]
    assert words[0] == ["packing", "state", "phi", "stress", "time"]
    assert words[2] == ["paper", "seed", "3", "7", "of", "16", "0.652", "12.3", "MPa", "1", "min"]
    assert words[3] == ["paper", "seed", "4", "begins", "1", "min"]
    assert lines[4:] == [
        "now: energy split of sand",
        "packings: 0 done, 2 running, 18 left; other steps: 0 of 2",
    ]


def test_time_left_comes_with_the_first_packing_done(run, drawn):
    run.finish(3, 700.0)
    # 600 s each, 18 wait, the other is due, two at once: 5400 s.
    expected = "packings: 1 done, 1 running, 18 left, about 1 h 30 min left; other steps: 0 of 2"
    assert drawn(run, {}, now=700.0, width=100)[-1] == expected


def test_no_line_is_longer_than_the_terminal_and_no_drawing_higher(run, drawn):
    for number in range(5, 70):
        sample = {"sample": "sand with a long name", "seed": str(number)}
        run.begin(Job(number, "compression", sample, "", 0.0))
        run.begin(Job(number + 100, "energy_split", sample, "", 0.0))
    for width, height in ((40, 10), (80, 24), (20, 5)):
        lines = drawn(run, {}, width=width, height=height)
        assert max(map(len, lines)) <= width
        assert len(lines) <= max(height - 1, 6)
    assert "and 49 packings more" in drawn(run, {}, height=24)
