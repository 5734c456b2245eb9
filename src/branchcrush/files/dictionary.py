"""What every file of the results holds: each column and key with its type, unit and meaning.

It is written down once, in the TOML files of `meanings`, a file for each stage. From them come
`docs/results.md`, `datapackage.json` beside the results, and the test that holds both against a
real run. A path there may hold ``<sample>``,
``<material>``, ``<seed>`` and ``<rule>``. A name may hold braces as a
shell expands them, as in ``exponent{,_low,_high}``; ``a.b`` is a key in a key of JSON, ``a[].b`` a
key of each in a list.
"""

import hashlib
import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import NamedTuple

# Ends the name of a sample run with twice the strain steps, to judge its convergence.
REFINED = "-refined"
_MEANINGS = Path(__file__).with_name("meanings")
_PLACES = {"sample": r"[^/]+", "material": r"[^/]+", "seed": r"\d+", "rule": r"\w+"}
_BRACES = re.compile(r"\{([^{}]*)\}")
_LIMITS = {"_low": "; lower end of its interval", "_high": "; upper end of its interval"}


class Column(NamedTuple):
    """A column of a table, or a key of JSON."""

    name: str
    type: str  # of Data Packages' Table Schema: number, integer, string, boolean, array, object
    unit: str  # "-" without dimension, empty where it is no number
    meaning: str


@dataclass(frozen=True)
class ResultFile:
    """A file of the results, or all of one kind.

    Parameters
    ----------
    path : str
        Below `results/`.
    rule : str
        Of the workflow, which writes it.
    holds : str
        In a sentence.
    lines : tuple of Column
        As they are written down, with braces.
    figures : tuple of str
        That show it, below `results/figures/`, without their ending.
    rare : frozenset of str
        Columns that only some runs have.
    partial : str
        Why a run may lack columns; empty where none does.
    """

    path: str
    rule: str
    holds: str
    lines: tuple[Column, ...] = ()
    figures: tuple[str, ...] = ()
    rare: frozenset[str] = frozenset()
    partial: str = ""

    def columns(self) -> tuple[Column, ...]:
        """Return every column, in the order of the file, with braces expanded.

        Returns
        -------
        tuple of Column
        """
        return tuple(column for line in self.lines for column in _columns(line))

    def matches(self, path: str) -> bool:
        """Return whether a file of a run is of this kind.

        Parameters
        ----------
        path : str
            Below `results/`, with slashes.

        Returns
        -------
        bool

        Examples
        --------
        >>> ResultFile("<sample>/jamming.csv", "certificate", "").matches("sand/jamming.csv")
        True
        """
        parts = re.split(r"<(\w+)>", self.path)
        named = [_PLACES[part] if odd % 2 else re.escape(part) for odd, part in enumerate(parts)]
        return re.fullmatch("".join(named), path) is not None


@dataclass(frozen=True)
class Stage:
    """The files that belong together.

    Parameters
    ----------
    title, text : str
    files : tuple of ResultFile
    """

    title: str
    text: str
    files: tuple[ResultFile, ...]


def expanded(name: str) -> Iterator[str]:
    """Yield the names that braces stand for.

    Parameters
    ----------
    name : str

    Yields
    ------
    str

    Examples
    --------
    >>> list(expanded("n{,_low,_high}_{end,near}"))[:3]
    ['n_end', 'n_near', 'n_low_end']
    """
    braces = _BRACES.search(name)
    if braces is None:
        yield name
        return
    for choice in braces[1].split(","):
        yield from expanded(name[: braces.start()] + choice + name[braces.end() :])


def _columns(line):
    """Yield the columns of a line; a limit of an interval says that it is one."""
    before, limits, after = line.name.partition("{,_low,_high}")
    if not limits:
        yield from (line._replace(name=name) for name in expanded(line.name))
        return
    for first in expanded(before):
        for limit in ("", *_LIMITS):
            for name in expanded(first + limit + after):
                yield line._replace(name=name, meaning=line.meaning + _LIMITS.get(limit, ""))


@cache
def stages() -> tuple[Stage, ...]:
    """Return the whole dictionary.

    Returns
    -------
    tuple of Stage
        In the order of the workflow.

    Examples
    --------
    >>> stages()[0].files[2].columns()[3]
    Column(name='solid_fraction', type='number', unit='-', meaning='φ, volume of ...')
    """
    return tuple(
        Stage(stage["title"], stage["text"], tuple(map(_result_file, stage["files"])))
        for stage in (tomllib.loads(file.read_text(encoding="utf-8")) for file in _files())
    )


def _files():
    return sorted(_MEANINGS.glob("*.toml"))


def _result_file(entry):
    columns = entry.get("columns", {})
    return ResultFile(
        path=entry["path"],
        rule=entry["rule"],
        holds=entry["holds"],
        lines=tuple(Column(name, *told) for name, told in columns.items()),
        figures=tuple(entry.get("figures", ())),
        rare=frozenset(name for line in entry.get("rare", ()) for name in expanded(line)),
        partial=entry.get("partial", ""),
    )


def result_files() -> tuple[ResultFile, ...]:
    """Return the files of all stages.

    Returns
    -------
    tuple of ResultFile
    """
    return tuple(kind for stage in stages() for file in stage.files for kind in _kinds(file))


def _kinds(file):
    """Yield a file, and of a picture the same as SVG, which is written down once for both."""
    yield file
    if file.path.endswith(".png"):
        yield replace(file, path=file.path.removesuffix("png") + "svg")


def dictionary_digest() -> str:
    """Return a text that changes with the dictionary, for the workflow to watch.

    Returns
    -------
    str
        SHA-256 of its files.
    """
    digest = hashlib.sha256()
    for file in _files():
        digest.update(file.read_bytes())
    return digest.hexdigest()
