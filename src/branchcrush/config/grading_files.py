"""The files of a grading: whether they can be read, told by the key that names them."""

import os
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from branchcrush.config.build import grading_of
from branchcrush.config.gradings import GradingSection
from branchcrush.config.messages import shown
from branchcrush.errors import GradingError
from branchcrush.gradings.distribution import Grading


def checked_grading(raw: Any, key: str = "grading") -> tuple[Grading | None, list[str]]:
    """Return the grading of a section, or None, and what is wrong with its files.

    Parameters
    ----------
    raw : object
        Of the YAML file; what is not valid in itself is passed over.
    key : str
        At which it stands.

    Returns
    -------
    grading : Grading or None
    problems : list of str
        Each begins with the key.

    Examples
    --------
    >>> checked_grading({"form": "radii", "file": "no.txt"}, "before")[1][0][:45]
    "before.file = 'no.txt': there is no such file"
    """
    try:
        section = TypeAdapter(GradingSection).validate_python(raw).model_dump(exclude_none=True)
    except ValidationError:
        return None, _unread_files(raw, key)
    problems = _file_problems(section, key)
    if problems:
        return None, problems
    try:
        return grading_of(section), []
    except GradingError as error:
        return None, [f"{key}: {line}" for line in str(error).splitlines()]


def _file_problems(section, key):
    """Return what is wrong with the files of a section, or of each part of a mixture."""
    if section["form"] == "mixture":
        parts = enumerate(section["components"])
        return [
            problem
            for place, part in parts
            for problem in _file_problems(part["grading"], f"{key}.components.{place}.grading")
        ]
    if "file" not in section:
        return []
    if problems := unread_file(section["file"], key):
        return problems
    try:
        grading_of(section)
    except GradingError as error:
        return [f"{key}.file: {line}" for line in str(error).splitlines()]
    return []


def _unread_files(raw, key):
    """Return which files are not there, of a section with other mistakes."""
    if not isinstance(raw, dict):
        return []
    parts = raw.get("components")
    problems = [
        problem
        for place, part in enumerate(parts if isinstance(parts, list) else [])
        if isinstance(part, dict)
        for problem in _unread_files(part.get("grading"), f"{key}.components.{place}.grading")
    ]
    return problems + unread_file(raw.get("file"), key)


def unread_file(name: Any, key: str) -> list[str]:
    """Return what keeps a file from being read, before anything is.

    Parameters
    ----------
    name : object
        What the YAML file holds at the key `file`.
    key : str
        Of the section that names it.

    Returns
    -------
    list of str
        One line, or none; none as well for what is no name.

    Examples
    --------
    >>> unread_file("nowhere.csv", "compression")[0][:49]
    "compression.file = 'nowhere.csv': there is no suc"
    """
    if not isinstance(name, str) or not name:
        return []
    path = Path(name)
    try:
        if {"{", "}"} & set(name):
            what = "has braces, which Snakemake reads as a pattern: give the file another name"
        elif path.is_dir():
            what = "is a folder; give the name of a file in it"
        elif not path.exists():
            what = f"there is no such file in {Path.cwd()}; names are relative to that folder"
        elif not path.is_file():
            what = "is no regular file; give the name of a text file"
        elif not os.access(path, os.R_OK):
            what = "cannot be read: change its permissions"
        else:
            return []
    except (OSError, ValueError):  # of a name that no file can have
        what = "is no name of a file"
    return [f"{key}.file = {shown(name)}: {what}"]
