"""A process that ends when the one that began it does, whenever that is."""

import os
import signal
import subprocess
import sys
from functools import partial

from branchcrush.lammps.processes import end_with_parent

BEGINS = """\
import subprocess, sys
from functools import partial
from branchcrush.lammps.processes import end_with_parent
child = subprocess.Popen(["sleep", "60"], preexec_fn=end_with_parent, stdout=sys.stdout)
print(child.pid, flush=True)
child.wait()
"""


def test_it_ends_when_its_parent_is_killed():
    parent = subprocess.Popen([sys.executable, "-c", BEGINS], stdout=subprocess.PIPE)
    with parent.stdout as output:
        assert int(output.readline()) > 0
        parent.send_signal(signal.SIGKILL)
        parent.wait()
        # The end of the output: nobody is left who could write to it.
        assert output.read() == b""


def test_it_goes_on_while_its_parent_lives():
    child = subprocess.run(["true"], preexec_fn=partial(end_with_parent, os.getpid()))
    assert child.returncode == 0


def test_a_parent_that_died_before_it_could_be_told_is_noticed():
    child = subprocess.run(["sleep", "60"], preexec_fn=partial(end_with_parent, os.getpid() + 1))
    assert child.returncode == -signal.SIGTERM
