"""How a job of the workflow ends: quietly, or with one message on the screen and in its log."""

import contextlib
import sys
import traceback
from collections.abc import Iterator
from os import PathLike
from pathlib import Path

from branchcrush.errors import BranchcrushError
from branchcrush.lammps.processes import end_with_parent
from branchcrush.runs import belongs_to_run, join_run


@contextlib.contextmanager
def job(log: str | PathLike[str]) -> Iterator[None]:
    """Turn an error of the package into one message and a failed job; log anything else whole.

    A job of a run ends when the run does, whichever way: see `runs.join_run`.

    Parameters
    ----------
    log : path-like
        The log of the rule. LAMMPS may have written to it: messages are appended.

    Raises
    ------
    SystemExit
        For a `BranchcrushError`.

    Examples
    --------
    >>> import tempfile
    >>> from branchcrush.errors import FitError
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     try:
    ...         with job(f"{folder}/fit.log"):
    ...             raise FitError("no packing carries load")
    ...     except SystemExit:
    ...         print(Path(folder, "fit.log").read_text(), end="")
    branchcrush: no packing carries load
    """
    if belongs_to_run():
        # A shell may stand between this process and the run.
        end_with_parent()
        join_run()
    log = Path(log)
    log.parent.mkdir(parents=True, exist_ok=True)
    log.touch()
    try:
        yield
    except BranchcrushError as error:
        message = f"branchcrush: {error}\n"
        with log.open("a", encoding="utf-8") as file:
            file.write(message)
        sys.stderr.write(message)
        sys.exit(1)
    except Exception:
        with log.open("a", encoding="utf-8") as file:
            traceback.print_exc(file=file)
        raise
