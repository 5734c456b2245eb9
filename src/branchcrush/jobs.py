"""How a job of the workflow ends: quietly, or with one message on the screen and in its log."""

import contextlib
import shutil
import sys
import traceback
from collections.abc import Iterator
from os import PathLike
from pathlib import Path

from branchcrush.errors import BranchcrushError
from branchcrush.runs import join_run


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


@contextlib.contextmanager
def checkpoint_of(results: str | PathLike[str]) -> Iterator[Path]:
    """Yield the folder where a job keeps what it goes on from when it is killed.

    It lies beside the locks of the run, where no cleaning of scratch comes, and is removed when the
    job has ended well.

    Parameters
    ----------
    results : path-like
        The folder of the job's results, which no other job has.

    Yields
    ------
    Path
        It need not be there.

    Examples
    --------
    >>> with checkpoint_of("results/sand/seed_1") as folder:
    ...     folder.as_posix()
    '.branchcrush/checkpoints/results/sand/seed_1'
    """
    # Never where the results are, however their folder is told.
    parts = [part for part in Path(results).parts if part not in ("/", "..")]
    folder = Path(".branchcrush", "checkpoints", *parts)
    yield folder
    shutil.rmtree(folder, ignore_errors=True)
