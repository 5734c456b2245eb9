"""Which source files of this package a script or a module is made of, for the workflow to watch."""

import hashlib
import re
from collections.abc import Iterable
from functools import cache
from os import PathLike
from pathlib import Path

_PACKAGE = Path(__file__).parent
# How a job reports, and what it notes of itself, does not change what it writes.
_NO_RESULT = {
    "jobs",
    "records",
    "records_words",
    "claims",
    "checkpoints",
    "files.digests",
    "files.intact",
    "files.locks",
    "files.made",
}
# A statement that imports. To parse whole files would take half a second of every start of a run.
_IMPORT = re.compile(
    r"^[ \t]*(?:from[ \t]+([\w.]+)[ \t]+import[ \t]+(\([^)]*\)|.*)|import[ \t]+(.*))", re.MULTILINE
)


@cache
def imported_modules(path: str | PathLike[str]) -> frozenset[str]:
    """Return the modules of this package that a Python file imports directly.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    frozenset of str
        Dotted names below the package, as "errors" or "plotting.energy".

    Examples
    --------
    >>> sorted(imported_modules(Path(__file__).with_name("packings") / "placement.py"))
    ['errors', 'packings.cell_grid', 'packings.geometry']
    """
    modules = set()
    for source, names, packages in _IMPORT.findall(Path(path).read_text(encoding="utf-8")):
        if source:
            # `from branchcrush.files import X` names a module of the room, or something in its own.
            found = (f"{source}.{name}" for name in _names(names))
            modules |= {_module(name) or _module(source) for name in found}
        else:
            modules |= {_module(name) for name in _names(packages)}
    return frozenset(modules - {None})


def source_files(path: str | PathLike[str]) -> list[str]:
    """Return the files of this package that a Python file imports, directly or through others.

    Parameters
    ----------
    path : path-like
        A script of the workflow, or a module.

    Returns
    -------
    list of str
        Sorted, without the file itself.

    Examples
    --------
    >>> placement = Path(__file__).with_name("packings") / "placement.py"
    >>> [Path(file).name for file in source_files(placement)]
    ['errors.py', 'cell_grid.py', 'geometry.py']
    """
    pending, seen = list(imported_modules(path)), set()
    while pending:
        module = pending.pop()
        if module not in seen | _NO_RESULT:
            seen.add(module)
            pending += imported_modules(_file(module))
    return sorted(str(_file(module)) for module in seen)


def source_digest(path: str | PathLike[str], others: Iterable[str | PathLike[str]] = ()) -> str:
    """Return a text that changes with a Python file and the files of this package that it imports.

    Where the files lie does not change it.

    Parameters
    ----------
    path : path-like
        As for `source_files`.
    others : iterable of path-like
        Files that it reads besides, as templates and scripts of LAMMPS.

    Returns
    -------
    str
        SHA-256 of the names and the contents of the files.

    Examples
    --------
    >>> len(source_digest(Path(__file__).with_name("packings") / "placement.py"))
    64
    """
    digest = hashlib.sha256()
    for file in map(Path, [path, *source_files(path), *others]):
        name = file.relative_to(_PACKAGE) if file.is_relative_to(_PACKAGE) else file.name
        digest.update(f"{name} {_digest(file)}\n".encode())
    return digest.hexdigest()


@cache
def _digest(file):
    """Return the SHA-256 of a file."""
    return hashlib.sha256(file.read_bytes()).hexdigest()


def _names(listed):
    """Return the names in a list of imports, without comments, brackets and what they become."""
    names = re.sub(r"#.*", "", listed).strip("( )\n").split(",")
    return [name.split()[0] for name in names if name.strip()]


def _module(name):
    """Return the name below the package that an import names, or None for another's."""
    package, _, module = name.partition(".")
    return module if package == "branchcrush" and _file(module) else None


def _file(module):
    """Return the file of a module, or None where there is no such module."""
    path = _PACKAGE.joinpath(*module.split("."))
    for candidate in (path.with_suffix(".py"), path / "__init__.py"):
        if module and candidate.is_file():
            return candidate
    return None
