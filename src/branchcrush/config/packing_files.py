"""The files of packings that another code made: which names and patterns of them lead to."""

import re
from pathlib import Path
from typing import Any

from branchcrush.config.grading_files import unread_file
from branchcrush.config.messages import shown


def packing_problems(section: Any) -> list[str]:
    """Return which files of a packing are not there, a line each.

    Parameters
    ----------
    section : object
        `packing` of the YAML file; a part that is not valid in itself is passed over.

    Returns
    -------
    list of str
        Each begins with the key below the sample.

    Examples
    --------
    >>> packing_problems({"grains": "no.dump"})[0][:49]
    "packing.grains = 'no.dump': there is no such file"
    """
    problems = []
    for key in ("grains", "contacts") if isinstance(section, dict) else ():
        names = section.get(key)
        for name in names if isinstance(names, list) else [names]:
            if not isinstance(name, str) or not name:
                continue
            if "*" in name:
                if not frame_files(name):
                    problems.append(
                        f"packing.{key} = {shown(name)}: no file has such a name in {Path.cwd()}"
                    )
                continue
            found = unread_file(name, "packing")
            problems += [line.replace("packing.file", f"packing.{key}", 1) for line in found]
    return problems


def frame_files(name: str) -> list[str]:
    """Return the files that a name stands for: itself, or with * those of the frames.

    Parameters
    ----------
    name : str

    Returns
    -------
    list of str
        In the order in which a person counts: 9 before 10.

    Examples
    --------
    >>> frame_files("grains.dump")
    ['grains.dump']
    """
    if "*" not in name:
        return [name]
    path = Path(name)
    try:
        found = [str(each) for each in path.parent.glob(path.name) if each.is_file()]
    except (OSError, ValueError):  # of a name that no file can have
        return []
    return sorted(found, key=_as_counted)


def _as_counted(name):
    return [
        (part.isdigit(), int(part) if part.isdigit() else part) for part in re.split(r"(\d+)", name)
    ]
