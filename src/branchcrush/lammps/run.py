"""One run of LAMMPS: in this process, or over MPI ranks in processes of its own."""

import contextlib
import json
import os
import pickle
import re
import shutil
import signal
import subprocess
import sys
import time
import traceback
from collections.abc import Callable, Mapping
from functools import partial
from importlib import import_module
from os import PathLike
from pathlib import Path
from typing import Any

from branchcrush.errors import SimulationError
from branchcrush.files.replacing import replacing
from branchcrush.files.scratch import scratch_folder
from branchcrush.lammps import rank
from branchcrush.lammps.library import load_lammps
from branchcrush.lammps.processes import end_with_parent, start_of

# What ranks leave for their job.
_RESULT, _RAISED = "result.json", "raised.pickle"


def declared_variables(script: str | PathLike[str]) -> dict[str, str]:
    r"""Return the variables a LAMMPS script declares with style index, and their defaults.

    Parameters
    ----------
    script : path-like

    Returns
    -------
    dict of str
        By name; a default of several words is one text.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     script = Path(folder, "in.example")
    ...     _ = script.write_text("variable edge index 1.5\nvariable half equal v_edge/2\n")
    ...     declared_variables(script)
    {'edge': '1.5'}
    """
    text = Path(script).read_text(encoding="utf-8")
    return dict(re.findall(r"^variable\s+(\w+)\s+index\s+(.+)$", text, re.MULTILINE))


def run_script(
    script: str | PathLike[str],
    variables: Mapping[str, Any],
    log: str | PathLike[str],
    ranks: int = 1,
) -> str:
    """Run a script to its end, and return why it stopped before, if it did.

    The seconds inside LAMMPS are the last line of the log.

    Parameters
    ----------
    script : path-like
        It tells by its variables `failed`, `failure` and `edge` whether it stopped.
    variables : dict
        A value may be a list.
    log : path-like
        Where LAMMPS logs.
    ranks : int
        Processes that share the packing.

    Returns
    -------
    str
        Why, and at which edge; empty for a run that came to its end.

    Raises
    ------
    SimulationError
        When LAMMPS itself stops, or the script does not declare a variable.
    """
    return run_task(script_task, {"script": str(script)}, script, variables, log, ranks)


def script_task(lammps: Any, payload: Mapping[str, Any]) -> str:
    """Run a script to its end in an instance of LAMMPS: a task for `run_task`.

    Parameters
    ----------
    lammps : object
        The instance, with the variables of the script.
    payload : mapping
        script: its path.

    Returns
    -------
    str
        As `run_script`.
    """
    lammps.file(payload["script"])
    return why_stopped(lammps)


def why_stopped(lammps: Any) -> str:
    """Return why a script stopped before its end, and at which edge; empty if it did not.

    Parameters
    ----------
    lammps : object
        Whose variables `failed`, `failure` and `edge` tell it.
    """
    if not int(lammps.extract_variable("failed")):
        return ""
    edge = float(lammps.extract_variable("edge"))
    return f"stopped at an edge of {edge:.6g} m: {lammps.extract_variable('failure')}"


def run_task(
    task: Callable[[Any, Mapping[str, Any]], str],
    payload: Mapping[str, Any],
    script: str | PathLike[str],
    variables: Mapping[str, Any],
    log: str | PathLike[str],
    ranks: int = 1,
) -> str:
    """Run a function that leads an instance of LAMMPS, and return why it stopped before its end.

    The seconds inside LAMMPS are the last line of the log.

    Parameters
    ----------
    task : callable
        Of a module; takes the instance and the payload, and returns why it stopped, if it did.
    payload : mapping
        Plain values.
    script : path-like
        Declares the variables.
    variables, log, ranks
        As for `run_script`.

    Returns
    -------
    str

    Raises
    ------
    SimulationError
        As `run_script`.
    Exception
        Whatever the task raises, on several ranks too.
    """
    script = Path(script)
    # LAMMPS ignores a misspelt -var silently.
    unknown = set(variables) - set(declared_variables(script))
    if unknown:
        raise SimulationError(f"{script.name} declares no variable {', '.join(sorted(unknown))}")
    arguments = ["-nocite", "-screen", "none", "-log", str(log)]
    for name, value in variables.items():
        arguments += ["-var", name, *_words(value)]
    name = f"{task.__module__}:{task.__name__}"
    if ranks == 1:
        result = _run(name, payload, arguments, ranks)
    else:
        with scratch_folder("branchcrush-") as folder:
            result = _run_on_ranks(name, payload, arguments, ranks, folder, log)
    _note(log, f"branchcrush: {result['seconds']:.3f} s inside LAMMPS\n")
    if result["error"]:
        raise SimulationError(f"LAMMPS stopped: {result['error']} (log: {log})")
    return result["stopped"]


def _run(name, payload, arguments, ranks):
    """Run a task in this process; an error of LAMMPS is part of what is returned, no other is."""
    lammps, stopped, problem, seconds, number, ended = None, "", "", 0.0, 0, False
    module, _, function = name.partition(":")
    task = getattr(import_module(module), function)
    try:
        library = load_lammps()
        start = time.perf_counter()
        lammps = library(cmdargs=arguments)
        number, world = (lammps.extract_setting(f"world_{what}") for what in ("rank", "size"))
        if world != ranks:  # each would run alone, and write over the others
            raise SimulationError(
                f"{ranks} ranks were asked for, and this mpiexec gives LAMMPS a world of {world}: "
                "it belongs to another MPI; install mpich into this Python, or use ranks: 1"
            )
        with _interruptible():
            stopped = task(lammps, payload)
        ended = True
    except Exception as error:
        # What a task raises itself, such as of a full disk, is told as what it is.
        if isinstance(error, SimulationError) or not (lammps is None or _of_lammps(error)):
            raise
        problem = (str(error).strip() or type(error).__name__).splitlines()[0]
    finally:
        if lammps is not None:
            # Others may wait for a rank that failed: it must not wait for them.
            if ranks == 1 or ended:
                lammps.close()
            seconds = time.perf_counter() - start
    return {"rank": number, "stopped": stopped, "error": problem, "seconds": seconds}


def _of_lammps(error):
    """Return whether LAMMPS raised an error: plain exceptions, and one of a kind of its own."""
    return type(error) is Exception or type(error).__name__ == "MPIAbortException"


def _run_on_ranks(name, payload, arguments, ranks, folder, log):
    """Run a task over MPI ranks; the first of them leaves the result in a file."""
    job = [name, payload, arguments, ranks]
    (folder / "job.json").write_text(json.dumps(job), encoding="utf-8")
    launcher = _launcher()
    if launcher is None:
        raise SimulationError(
            f"{ranks} ranks were asked for, and there is no mpiexec: install the package mpich "
            "into this Python, or use ranks: 1"
        )
    command = [launcher, "-n", ranks, sys.executable, "-m", rank.__name__, __name__]
    command += [folder, os.getpid(), start_of(os.getpid())]
    # All ranks are this job's, on this machine, also inside a Slurm allocation.
    environment = {
        name: value for name, value in os.environ.items() if not name.startswith("SLURM_")
    }
    end_with_parent()
    process = subprocess.Popen(
        [str(word) for word in command],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env={**environment, "HYDRA_LAUNCHER": "fork"},
        preexec_fn=partial(end_with_parent, os.getpid()),
    )
    try:
        output, _ = process.communicate()
    except BaseException:
        # Not before it has ended is there nobody who writes to the scratch folders.
        process.terminate()
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(timeout=10)
        process.kill()
        raise
    raised, result = folder / _RAISED, folder / _RESULT
    if raised.exists():
        raise pickle.loads(raised.read_bytes())
    if not result.exists():
        _note(log, output)
        raise SimulationError(
            f"LAMMPS ended on {ranks} ranks without a result, exit code {process.returncode}: was "
            f"one killed, for want of memory? (log: {log})"
        )
    return json.loads(result.read_text(encoding="utf-8"))


def _leave(path, content):
    """Write what a rank leaves for its job; all may fail alike, and what is there is whole."""
    with replacing(path) as file:
        file.write(content)


def _note(log, text):
    """Write at the end of a log; one that cannot be written must not hide why LAMMPS stopped."""
    with contextlib.suppress(OSError), open(log, "a", encoding="utf-8") as file:
        file.write(text)


def _launcher():
    """Return the mpiexec to use, or None."""
    # That which belongs to the MPI of this interpreter's LAMMPS lies beside it.
    beside = Path(sys.executable).with_name("mpiexec")
    return str(beside) if beside.exists() else shutil.which("mpiexec")


def _words(value):
    """Return the words of a variable as LAMMPS reads them."""
    # repr keeps all digits, but that of a NumPy number is not one LAMMPS reads.
    values = value if isinstance(value, list) else [value]
    return [repr(float(item)) if isinstance(item, float) else str(item) for item in values]


@contextlib.contextmanager
def _interruptible():
    """Let Ctrl-C and the end of the parent process end a run that never returns to Python."""
    end_with_parent()
    before = signal.signal(signal.SIGINT, signal.SIG_DFL)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def main(folder: str | PathLike[str]) -> None:
    """Run the job of a folder on this rank, of all that were started for it.

    Parameters
    ----------
    folder : path-like
        Holds job.json; result.json is left in it, or raised.pickle where the task raises an error.

    Raises
    ------
    SimulationError
        When LAMMPS itself stops on this rank.
    Exception
        Whatever the task raises.
    """
    folder = Path(folder)
    name, payload, arguments, ranks = json.loads((folder / "job.json").read_text(encoding="utf-8"))
    try:
        result = _run(name, payload, arguments, ranks)
    except Exception as error:
        # Where it came from, which no traceback of the job tells.
        error.add_note(traceback.format_exc())
        _leave(folder / _RAISED, pickle.dumps(error))
        raise
    if result["rank"] == 0 or result["error"]:
        _leave(folder / _RESULT, json.dumps(result).encode())
    if result["error"]:
        # Other ranks may wait for this one: an exception ends them all.
        raise SimulationError(result["error"])


if __name__ == "__main__":
    main(sys.argv[1])
