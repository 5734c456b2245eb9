"""Where a run of LAMMPS works, what it is told there, and what it leaves beside its tables."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, nullcontext
from os import PathLike
from pathlib import Path
from typing import Any, Literal

from branchcrush.files.scratch import remove_leavings, scratch_folder
from branchcrush.lammps.checkpoint import Checkpoint
from branchcrush.lammps.files import compress_file, last_frame
from branchcrush.lammps.links import linked
from branchcrush.lammps.output import DUMPS
from branchcrush.lammps.run import declared_variables, run_task


@contextmanager
def workplace(
    folder: Path, inputs: str | PathLike[str], checkpoint: str | PathLike[str] | None
) -> Iterator[tuple[Path, Path]]:
    """Give a run the folder that it works in, and names for it that LAMMPS can read.

    Parameters
    ----------
    folder : Path
        Of the results; a scratch folder in it where there is no checkpoint.
    inputs : path-like
        The folder of in.compress.
    checkpoint : path-like or None

    Yields
    ------
    tuple of Path
        The folder, and one in which it is `output` and that of in.compress `inputs`.
    """
    # Of a job that was killed: this one makes the same, and nobody else does.
    remove_leavings(folder)
    own = scratch_folder(".compress-", folder) if checkpoint is None else nullcontext(checkpoint)
    with own as place:
        work = Path(place).resolve()
        with linked(inputs, work) as links:
            yield work, links


def run_led(
    task: Callable[[Any, Mapping[str, Any]], str],
    checkpoint: Checkpoint,
    note: str,
    links: Path,
    variables: Mapping[str, Any],
    log: str | PathLike[str],
    ranks: int,
) -> str:
    """Run a task that leads LAMMPS from state to state, and return why it stopped, if it did.

    Parameters
    ----------
    task : callable
        For `lammps.run.run_task`.
    checkpoint : Checkpoint
        Opened.
    note : str
        For the log.
    links : Path
        From `workplace`.
    variables : dict
        Of in.compress.
    log : path-like
    ranks : int

    Returns
    -------
    str
    """
    script, targets = links / "inputs" / "in.compress", len(variables["targets"])
    payload = {
        "folder": str(checkpoint.folder),
        "key": checkpoint.key,
        "inputs": str(links / "inputs"),
        "targets": targets,
        "note": note,
    }
    given = {
        # No script declares them here.
        **declared_variables(script),
        **variables,
        "data": links / "output" / "packing.data",
        "inputs": links / "inputs",
        "output_folder": links / "output",
        # For its progress lines: state 0 is as placed, state 1 the end of the approach.
        "last_state": targets + 1,
    }
    return run_task(task, payload, script, given, log, ranks)


def keep(work: Path, folder: Path, keep_dumps: Literal["all", "last", "none"]) -> None:
    """Gzip the dumps of a run into a folder, all of them, those of the last state, or none.

    Parameters
    ----------
    work : Path
        Holds them.
    folder : Path
        Of the results; what an earlier run left there goes.
    keep_dumps : {"all", "last", "none"}
    """
    packed = [f"{name}.gz" for name in DUMPS]
    if keep_dumps == "none":
        for name in packed:
            (folder / name).unlink(missing_ok=True)
        return
    # All of them whole before the first takes the place of an earlier run's.
    with scratch_folder(".compress-", folder) as scratch:
        for name, target in zip(DUMPS, packed, strict=True):
            start = last_frame(work / name) if keep_dumps == "last" else 0
            compress_file(work / name, scratch / target, start)
        for name in packed:
            (scratch / name).replace(folder / name)
