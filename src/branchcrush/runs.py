"""One run of the workflow in a folder at a time, and jobs that end with the run that began them.

A run holds `.branchcrush/run.lock`, and each of its jobs `.branchcrush/jobs.lock`. The kernel lets
both go when their holder dies, whichever way, so that no lock stays behind. Jobs of a cluster
outlive a run that dies: the next one waits for those at work, and none begins any more.
"""

import contextlib
import json
import os
import shlex
import shutil
import signal
import sys
import threading
import time
import uuid
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path

from branchcrush.checkpoints import remove_finished
from branchcrush.claims import CLAIMS, Claim, standing_claims
from branchcrush.errors import RunError
from branchcrush.files.locks import locked
from branchcrush.files.scratch import remove_leavings
from branchcrush.lammps.links import remove_dead_links
from branchcrush.lammps.processes import end_with_parent, start_of

_FOLDER = ".branchcrush"
# Tells jobs which run they belong to; its last word, that they outlive it.
_VARIABLE, _CLUSTER = "BRANCHCRUSH_RUN", "cluster"
# How often a job looks whether its run lives, and how long a run waits for jobs of a dead one that
# are to end with it [s].
_LOOK, _PATIENCE = 0.25, 20.0
# Each of them is looked at over the network.
_LOOK_AT_CLUSTER = 2.0
# Jobs that are named of those that are waited for.
_MOST_NAMED = 5


@contextlib.contextmanager
def one_run(*, cluster: bool = False) -> Iterator[None]:
    """Have the working folder for one run, and clear away what dead runs left in it.

    Jobs that begin meanwhile and call `join_run` end when this process does, and at Ctrl-C. Those
    of a cluster are ended by its scheduler: they go on where this process is killed, and the next
    run waits for them without a limit.

    Parameters
    ----------
    cluster : bool
        Whether the jobs are a cluster's.

    Raises
    ------
    RunError
        When another run has the folder, or jobs of an earlier one are still at work in it.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder), one_run():
    ...     with one_run():
    ...         pass
    Traceback (most recent call last):
    branchcrush.errors.RunError: another run has this folder since ...
    """
    folder = Path(_FOLDER).absolute()
    with _held(folder / "run.lock") as lock:
        run = f"{uuid.uuid4().hex} {_machine()} {os.getpid()} {start_of(os.getpid())}"
        run += f" {_CLUSTER}" if cluster else ""
        _write(lock, {"run": run, **_holder()})
        _wait_for_jobs(folder / "jobs.lock", cluster)
        remove_leavings("results")
        remove_finished()
        remove_dead_links()
        os.environ[_VARIABLE] = run
        try:
            with _interrupt_ends_jobs(lock):
                yield
        finally:
            os.environ.pop(_VARIABLE, None)


def join_run() -> None:
    """Let this process, of a job, end when the run that began it ends, whichever way.

    That of a cluster ends only where its run has ended, or another one has begun, before it joins.
    Does nothing where no run began it.
    """
    run = os.environ.get(_VARIABLE)
    if run is None:
        return
    of_cluster = run.endswith(f" {_CLUSTER}")
    if not of_cluster:
        # Of what stands between this process and the run, such as a shell. First of all, since it
        # may end at any moment; then it is looked at, since it may have ended before. A scheduler
        # ends all that its job began, whose parent is one of its own.
        end_with_parent()
        if not _is_of(os.getppid(), run):
            os.kill(os.getpid(), signal.SIGKILL)
    folder = Path(_FOLDER).absolute()
    # Held until this process ends: no other run begins before.
    locked(folder / "jobs.lock", shared=True, wait=True)
    if not _lives(run, folder / "run.lock"):
        sys.stderr.write(
            "branchcrush: the run that began this job has ended, and so does the job\n"
        )
        sys.stderr.flush()
        os.kill(os.getpid(), signal.SIGKILL)
    if not of_cluster:
        watch = threading.Thread(target=_end_with, args=(run, folder / "run.lock"), daemon=True)
        watch.start()


def _is_of(process, run):
    """Return whether a process is a run, or was begun in it: not so one that takes in orphans."""
    _, machine, main, _ = run.split(" ")
    if machine == _machine() and str(process) == main:
        return True
    try:
        # As it was when the process began.
        environment = Path(f"/proc/{process}/environ").read_bytes().split(b"\0")
    except OSError:  # another user's
        return process != 1
    return f"{_VARIABLE}={run}".encode() in environment


@contextlib.contextmanager
def _held(path):
    """Hold the lock of a run, or refuse and name who does."""
    with _folder_errors():
        path.parent.mkdir(exist_ok=True)
        lock, free = locked(path)
    try:
        if not free:
            raise RunError(_who_has_it(path))
        try:
            yield lock
        finally:
            os.truncate(lock, 0)
    finally:
        os.close(lock)


@contextlib.contextmanager
def _folder_errors():
    """Turn what the system refuses into one sentence."""
    try:
        yield
    except OSError as error:
        raise RunError(
            f"this folder cannot be locked for a run: {error.filename or _FOLDER}: {error.strerror}"
        ) from None


def _end_with(run, lock):
    """Kill this process when its run has ended."""
    while _lives(run, lock):
        time.sleep(_LOOK)
    # LAMMPS listens to nothing else, and what is left unfinished is known as such.
    os.kill(os.getpid(), signal.SIGKILL)


def _lives(run, lock):
    """Return whether a run has not ended yet."""
    _, machine, process, start, *cluster = run.split(" ")
    if not cluster and machine == _machine() and start != start_of(process):
        return False
    try:
        text = lock.read_text(encoding="utf-8")
    except OSError:  # removed by hand, which ends no run
        return True
    # It is emptied at Ctrl-C, and another run writes itself into it.
    return run in text


def _wait_for_jobs(path, cluster):
    """Wait until no job of an earlier run is at work, and say which are where that takes long.

    Those of this machine look often whether their run lives; those of a cluster are waited for.
    """
    end, look, told = time.monotonic() + _PATIENCE, _LOOK / 2, ""
    while True:
        with _folder_errors():
            lock, free = locked(path)
            if free:
                # Of dead jobs.
                shutil.rmtree(CLAIMS, ignore_errors=True)
            os.close(lock)
        if free:
            return
        claims = standing_claims()
        if cluster or any(claim.job for claim in claims):
            end, look = time.monotonic() + _PATIENCE, _LOOK_AT_CLUSTER
            # Between two claims, and before the first, there is nobody to name.
            if (words := _waiting_words(claims)) != told and (claims or not told):
                sys.stderr.write(told := words)
                sys.stderr.flush()
        if time.monotonic() > end:
            raise RunError(
                "jobs of an earlier run are still at work in this folder, perhaps on another "
                "machine: end them, then repeat the command"
            )
        time.sleep(look)


def _waiting_words(claims: list[Claim]) -> str:
    """Return which jobs are waited for, and what to do instead."""
    named = "; ".join(map(str, claims[:_MOST_NAMED]))
    more = f"; and {len(claims) - _MOST_NAMED} more" if len(claims) > _MOST_NAMED else ""
    return (
        "branchcrush: jobs of an earlier run are still at work on the cluster, and what they make "
        f"will be used; waiting for them, or end them{': ' * bool(named)}{named}{more}\n"
    )


def _who_has_it(lock):
    """Return one sentence about the run that has the folder."""
    try:
        holder = json.loads(lock.read_text(encoding="utf-8"))
        return (
            f"another run has this folder since {holder['start']}: process {holder['process']} on "
            f"{holder['host']}, `{holder['command']}`; wait until it has ended, or end it"
        )
    except (OSError, ValueError, KeyError):  # it is about to write who it is, or to end
        return "another run has this folder: wait until it has ended, or end it"


def _holder():
    program, *arguments = sys.argv
    name = Path(program).parent.name if program.endswith("__main__.py") else Path(program).name
    return {
        "process": os.getpid(),
        "host": os.uname().nodename,
        "command": shlex.join([name, *arguments]),
        "start": datetime.now().astimezone().isoformat(sep=" ", timespec="seconds"),
    }


def _write(file, content):
    os.truncate(file, 0)
    os.pwrite(file, (json.dumps(content) + "\n").encode(), 0)


@contextlib.contextmanager
def _interrupt_ends_jobs(lock):
    """Let Ctrl-C end the jobs too, also where only this process is told of it."""
    if (
        threading.current_thread() is not threading.main_thread()
        or signal.getsignal(signal.SIGINT) is not signal.default_int_handler
    ):
        yield
        return

    def interrupted(number, frame):
        os.truncate(lock, 0)
        signal.default_int_handler(number, frame)

    signal.signal(signal.SIGINT, interrupted)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _machine():
    """Return what tells apart where the number of a process means something; nothing if unknown."""
    try:
        boot = Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii").strip()
        return f"{boot}/{os.readlink('/proc/self/ns/pid')}"
    except OSError:
        return "unknown"
