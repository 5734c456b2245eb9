"""What a user sees of real runs, on a pipe and in a terminal."""

import fcntl
import os
import pty
import re
import select
import struct
import sys
import termios
import time

import pytest

from branchcrush.study.summary import summary

ESCAPE = re.compile(r"\x1b\[([?\d;]*)([A-Za-z])")
WIDTH, HEIGHT = 90, 24
PACKINGS = [f"results/tiny/seed_{seed}/path.csv" for seed in (3, 5)]
ROW = re.compile(r"tiny seed [35] +(begins|\d+ of 13 +0\.\d{3} +[\d.]+ [kMG]?Pa) +\d+ (s|min)")


def test_on_a_pipe_a_run_is_a_line_for_each_job_and_its_closing_lines(finished):
    lines = finished.output.splitlines()
    assert len(finished.output) < 4000
    ends = [line[9:] for line in lines if re.match(r"\d\d:\d\d:\d\d ", line)]
    for name in ("tiny seed 3", "tiny seed 5", "tiny-refined seed 3"):
        (line,) = (end for end in ends if end.startswith(f"{name}: ") and ", done in " in end)
        assert re.match(rf"{name}: state 13 of 13, phi 0\.741, \d\d\.\d MPa, done in ", line)
    for name in ("energy split of tiny", "report", "packing figures of tiny"):
        assert len([end for end in ends if end.startswith(f"{name} done (")]) == 1
    closing = closing_lines(finished)
    assert "Finished in " in lines[-len(closing) - 1]
    assert lines[-len(closing) :] == closing


def closing_lines(study, folder="results"):
    lines = summary(study.folder / "results", shown_as=folder).splitlines()
    assert [line.partition(":")[0] for line in lines] == ["tiny", "report", "figures"]
    return lines


@pytest.mark.parametrize("quiet", [(), ("--quiet",)])
def test_where_nothing_is_to_be_done_the_closing_lines_come_too(finished, quiet):
    run = finished.snakemake(*quiet)
    lines = (run.stdout + run.stderr).splitlines()
    closing = closing_lines(finished)
    assert lines[-len(closing) - 1].startswith("Nothing to be done")
    assert lines[-len(closing) :] == closing


def test_from_another_folder_the_profile_is_read_and_paths_lead_to_the_pages(finished, study):
    # The copy's own, of which the study has all results.
    study.snakefile, study.source = finished.snakefile, finished.source
    run = study.snakemake("--directory", str(finished.folder))
    assert "Nothing to be done" in run.stderr
    assert "Using workflow specific profile" in run.stderr
    closing = closing_lines(finished, finished.folder / "results")
    assert run.stderr.splitlines()[-len(closing) :] == closing


def in_a_terminal(study, *arguments):
    """Run snakemake with a terminal of its own, and return its exit code and all it was sent."""
    child, terminal = pty.fork()
    if child == 0:
        os.chdir(study.folder)
        os.environ.update(PYTHONPATH=str(study.source), TERM="xterm")
        os.environ["PATH"] = f"{os.path.dirname(sys.executable)}{os.pathsep}{os.environ['PATH']}"
        command = [sys.executable, "-m", "snakemake", "--cores", "2"]
        os.execv(sys.executable, [*command, "--snakefile", str(study.snakefile), *arguments])
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", HEIGHT, WIDTH, 0, 0))
    sent, end = [], time.monotonic() + 300
    while time.monotonic() < end and select.select([terminal], [], [], 300)[0]:
        try:
            sent.append(os.read(terminal, 65536))
        except OSError:  # on Linux, when the child has closed its end
            break
    os.close(terminal)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), b"".join(sent).decode()


def screens(sent):
    """Yield what a terminal shows each time before something is taken away, and at the end."""
    lines, at = [""], 0
    for part in re.split(r"(\x1b\[[?\d;]*[A-Za-z]|\r\n|\r|\n)", sent):
        escape = ESCAPE.fullmatch(part)
        if part in ("\n", "\r\n"):
            at += 1
            lines += [""] * (at + 1 - len(lines))
        elif escape and escape[2] == "A":
            at -= int(escape[1] or 1)
            assert at >= 0
        elif escape and escape[2] == "K":
            if lines[at] and at == len(lines) - 1:
                yield list(lines)
            lines[at] = ""
        elif not escape and part != "\r":
            lines[at] += part
    yield list(lines)


def test_in_a_terminal_a_table_moves_and_nothing_is_garbled(study):
    code, sent = in_a_terminal(study, *PACKINGS)
    assert code == 0, sent
    *shown, last = screens(sent)
    tables = [screen for screen in shown if any("packing   " in line for line in screen)]
    assert len(tables) >= 3
    seen = set()
    for screen in tables:
        head = max(n for n, line in enumerate(screen) if line.startswith("packing "))
        rows = [line.strip() for line in screen[head + 2 : -1]]
        assert 1 <= len(rows) <= 2
        assert all(ROW.fullmatch(row) for row in rows), screen
        assert re.match(r"packings: \d done, \d running, \d left", screen[-1]), screen
        seen |= {row.split(" ", 3)[2] for row in rows}
    assert seen == {"3", "5"}
    # Of the tables nothing is left, and every other line is whole.
    last = [line for line in last if line]
    assert last[0].startswith("Using workflow specific profile")
    assert last[1] == "to do: 2 packings"
    done = sorted(line.split(": state 13 of 13, phi 0.741, ")[0] for line in last[2:-1])
    assert done == ["tiny seed 3", "tiny seed 5"]
    assert re.fullmatch(r"Finished in \d+ (s|min): 2 of 2 packings\.", last[-1])
    assert "\x1b[?25l" not in sent or sent.rindex("\x1b[?25h") > sent.rindex("\x1b[?25l")


def test_a_failed_packing_is_told_once_with_its_log_and_at_the_end(study):
    results = study.folder / "results/tiny/seed_3"
    (results / "pairs.dump.gz").mkdir(parents=True)
    study.configure(study.tiny + "keep_dumps: none\n")
    run = study.snakemake(PACKINGS[0])
    lines = run.stderr.splitlines()
    assert run.returncode == 1, run.stderr
    told = [line for line in lines if "Is a directory" in line]
    assert len(told) == 2, run.stderr
    words = (
        "Is a directory, .*pairs.dump.gz: move the folder that lies in the place of a file, then"
    )
    assert re.match(rf"\d\d:\d\d:\d\d FAILED tiny seed 3: {words} repeat", told[0])
    assert told[0].endswith("(log: logs/tiny/seed_3/compression.log)")
    assert lines[-3:] == ["One job failed:", told[1], lines[-1]]
    assert lines[-1].startswith("Before that: 0 of 1 packings. Once the cause is mended: the same")
    assert [path.name for path in results.iterdir()] == ["pairs.dump.gz"]
    assert "Traceback" not in run.stdout + run.stderr
    assert len(run.stderr) < 1500
