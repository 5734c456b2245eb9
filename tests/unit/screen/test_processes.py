"""What jobs write, taken as long as they write it."""

import logging
import os
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from snakemake_interface_logger_plugins.common import LogEvent

from snakemake_logger_plugin_branchcrush.processes import ProcessOutput
from snakemake_logger_plugin_branchcrush.screen import Screen


@pytest.mark.parametrize("error", [BrokenPipeError, ValueError])
def test_a_line_that_cannot_be_shown_keeps_no_job_waiting(error):
    lines = []

    def take(line):
        lines.append(line)
        if len(lines) == 1:
            raise error("nobody reads on")

    read, write = os.pipe()
    output = ProcessOutput([write], take)
    os.write(write, b"first\nsecond\nrest")
    output.close()
    os.close(read)
    os.close(write)
    assert lines == ["first", "second", "rest"]


def test_what_jobs_wrote_last_is_shown_before_the_end(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    settings = dict.fromkeys(("verbose", "debug_dag", "dryrun", "stdout", "quiet", "nocolor"))
    with open("shown.txt", "w") as stream:
        monkeypatch.setattr(sys, "stderr", stream)
        screen = Screen(SimpleNamespace(**settings))
        plan = logging.LogRecord("snakemake", logging.INFO, "", 0, "", None, None)
        plan.__dict__.update(event=LogEvent.RUN_INFO, stats={"fit": 1, "total": 1})
        screen.take(plan, logging.LogRecord.getMessage)
        os.write(stream.fileno(), b"a warning of numpy\n")
        screen.close()
    assert Path("shown.txt").read_text().endswith("to do: 1 steps\na warning of numpy\n")
