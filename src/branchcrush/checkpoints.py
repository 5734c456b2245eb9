"""Where a job keeps what it goes on from when it is killed, until its record is written."""

import os
import shutil
from os import PathLike
from pathlib import Path

CHECKPOINTS = Path(".branchcrush", "checkpoints")


def checkpoint_of(record: str | PathLike[str]) -> Path:
    """Return the folder where a job keeps what it goes on from.

    It lies beside the locks of the run, where no cleaning of scratch comes.

    Parameters
    ----------
    record : path-like
        Of the job, from the folder that the study runs in.

    Returns
    -------
    Path
        It need not be there.

    Examples
    --------
    >>> checkpoint_of("results/sand/seed_1/made.json").as_posix()
    '.branchcrush/checkpoints/results/sand/seed_1/made.json'
    """
    # Never where the results are, however their folder is told.
    return CHECKPOINTS.joinpath(*(part for part in Path(record).parts if part not in ("/", "..")))


def remove_finished() -> None:
    """Remove what jobs kept whose record is there: they were killed before they had cleared it."""
    for place, folders, _ in os.walk(CHECKPOINTS):
        for name in list(folders):
            folder = Path(place, name)
            if folder.relative_to(CHECKPOINTS).is_file():
                shutil.rmtree(folder, ignore_errors=True)
                folders.remove(name)
