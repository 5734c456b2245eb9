"""Records as Snakemake makes them, and a screen that takes them."""

import io
import logging
from types import SimpleNamespace

import pytest
from snakemake_interface_logger_plugins.common import LogEvent

from snakemake_logger_plugin_branchcrush.screen import Screen

PACKING_LOG = """\
LAMMPS (22 Jul 2025)
step 0: state 1 of 16, edge 0.005 m, solid fraction 0.4500, mean stress 0 Pa, contacts 0
Loop time of 1.071e-06 on 1 procs for 0 steps with 60 atoms
step 41: state 7 of 16, edge 0.004 m, solid fraction 0.6519, mean stress 1.23e+07 Pa, contacts 9
   Step
      7460
"""


class Told:
    """What a screen shows of records that a test invents."""

    def __init__(self, **settings):
        plain = dict.fromkeys(
            ("nocolor", "verbose", "debug_dag", "dryrun", "stdout", "quiet", "printshellcmds")
        )
        self.stream = io.StringIO()
        self.screen = Screen(SimpleNamespace(**plain | settings), stream=self.stream)
        self.numbers = {}

    def record(self, text="", event=None, level=logging.INFO, **values):
        record = logging.LogRecord("snakemake", level, "", 0, text, None, None)
        record.__dict__.update(event=event, **values)
        self.screen.take(record, lambda taken: f"whole: {taken.getMessage()}")

    def plan(self, **counts):
        counts["total"] = sum(counts.values())
        self.record("Job stats:\ntable", LogEvent.RUN_INFO, stats=counts)

    def begin(self, number, rule, log="", reason="", **wildcards):
        self.record(
            event=LogEvent.JOB_INFO,
            jobid=number,
            rule_name=rule,
            wildcards=wildcards,
            log=[str(log)] if log else [],
            reason=reason,
        )

    def finish(self, number):
        self.record(event=LogEvent.JOB_FINISHED, job_id=number)

    def fail(self, number, rule, log="", scheduler=("", ""), **wildcards):
        """Tell of a job that failed, and what a scheduler says of it and in which log."""
        said, where = scheduler
        self.record(
            event=LogEvent.JOB_ERROR,
            level=logging.ERROR,
            jobid=number,
            rule_name=rule,
            wildcards=wildcards,
            log=[str(each) for each in (log, where) if each],
            rule_msg=said or None,
        )

    def lines(self):
        """Return the lines so far, without the time of day."""
        lines = self.stream.getvalue().splitlines()
        return [line[9:] if line[2:3] == ":" and line[5:6] == ":" else line for line in lines]

    def close(self):
        before = len(self.lines())
        self.screen.close()
        return self.lines()[before:]


@pytest.fixture
def told(tmp_path, monkeypatch):
    """Return what makes a screen, in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    screens = []

    def make(**settings):
        screens.append(Told(**settings))
        return screens[-1]

    yield make
    for made in screens:
        made.screen.close()


@pytest.fixture
def packing_log(tmp_path, monkeypatch):
    """Return what writes the log of a packing on its way."""
    monkeypatch.chdir(tmp_path)

    def write(name="compression.log", text=PACKING_LOG):
        (tmp_path / name).write_text(text)
        return name

    return write
