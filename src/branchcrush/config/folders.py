"""The folders that results and logs go to: whether they can be, and have room."""

import os
import shutil
from collections.abc import Iterator, Mapping, Sequence
from os import PathLike
from pathlib import Path

from branchcrush.config.names import REFINED

# Less than the smallest study writes [bytes].
_LEAST = 10_000_000
_MOST_NAMED = 5


def folder_problems(
    folder: str | PathLike[str], samples: Mapping[str, Sequence[int]], materials: Sequence[str] = ()
) -> list[str]:
    """Return what keeps a study from writing its results and logs, a line each.

    Parameters
    ----------
    folder : path-like
        Of the study.
    samples : mapping
        Seeds of each sample, by its name.
    materials : sequence of str
        Names of measured materials.

    Returns
    -------
    list of str

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as study:
    ...     _ = Path(study, "logs").write_text("")
    ...     folder_problems(study, {"sand": [1]})
    ['logs is a file, and results need a folder there: move it']
    """
    folder = Path(folder)
    problems = []
    for path in _folders(samples, materials):
        whole = folder / path
        try:
            if whole.exists() and not whole.is_dir():
                problems.append(f"{path} is a file, and results need a folder there: move it")
            elif whole.is_dir() and not os.access(whole, os.W_OK | os.X_OK):
                problems.append(f"{path} cannot be written to: change its permissions")
        except OSError:  # of a name too long, which was refused as such
            continue
    more = len(problems) - _MOST_NAMED
    if more > 0:
        problems[_MOST_NAMED:] = [f"and {more} more folder{'s' * (more > 1)} like these"]
    if not os.access(folder, os.W_OK):
        problems.append(
            f"the folder {folder.resolve()} cannot be written to: run in one of your own"
        )
    return problems + _full(folder)


def _folders(samples: Mapping[str, Sequence[int]], materials: Sequence[str]) -> Iterator[Path]:
    """Yield the folders that jobs write into, those above first."""
    for name in (".snakemake", ".branchcrush", "results", "logs"):
        yield Path(name)
    for name in ("claims", "checkpoints"):
        yield Path(".branchcrush", name)
    for name in ("made", "figures", "figures/findings", "measured", "figures/measured"):
        yield Path("results", name)
    for name, seeds in samples.items():
        for of in (name, name + REFINED):
            below = [Path("results", of), Path("logs", of)]
            below += [Path("results", of, part) for part in ("made", "crushing")]
            yield from below
            for seed in seeds:
                yield from (path / f"seed_{seed}" for path in below if path.name != "made")
        yield Path("results/figures", name)
    yield from [Path("logs/measured")] if materials else []
    for name in materials:
        for place in ("results/measured", "results/figures/measured", "logs/measured"):
            yield Path(place, name)


def _full(folder):
    """Return whether there is next to no space left."""
    try:
        free = shutil.disk_usage(folder).free
    except OSError:  # the folder itself was refused
        return []
    if free >= _LEAST:
        return []
    return [
        f"the disk of {folder.resolve()} has {free / 1e6:.1f} MB left, less than any study takes: "
        "free some space"
    ]
