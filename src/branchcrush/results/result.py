"""One result: the table and the numbers of one name, with units, meanings and where from."""

from collections.abc import Mapping, Sequence
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import Any, Protocol

import pandas as pd

from branchcrush import __version__
from branchcrush.errors import ResultsError
from branchcrush.files.datapackage import OF_SOME_SAMPLES
from branchcrush.files.dictionary import Column, ResultFile
from branchcrush.files.origin import read_provenance
from branchcrush.files.tables import read_json, read_table
from branchcrush.results.package import Package

_TABLES = (".csv", ".parquet")


class Owner(Protocol):
    """What a result knows of the study, sample or packing that it is of, a `place.Place`."""

    package: Package

    @property
    def title(self) -> str:
        """How it is called in messages."""

    @property
    def prefix(self) -> str:
        """Its folder below `results`."""

    @property
    def folder(self) -> Path:
        """Where its files are."""

    def filled(self, pattern: str) -> str:
        """Return a pattern of the dictionary with its words."""


class Result:
    """What a rule wrote under one name: a table, numbers beside it, or both; read when asked for.

    Parameters
    ----------
    place : place.Place
        The study, sample or packing that it is of.
    name : str
        Of its files, without their ends.
    files : mapping of str to ResultFile
        What the dictionary says of each, by the end of its name.

    Examples
    --------
    A result is taken from where it belongs, as in `sample.energy_split`:

    >>> import branchcrush, tempfile
    >>> folder = tempfile.TemporaryDirectory()
    >>> (Path(folder.name) / "sand" / "seed_1").mkdir(parents=True)
    >>> jamming = branchcrush.open_study(folder.name)["sand"].jamming
    >>> jamming.exists
    False
    >>> jamming.missing
    'sand/jamming.csv is not there: rule certificate writes it'
    """

    def __init__(self, place: Owner, name: str, files: Mapping[str, ResultFile]) -> None:
        self.place, self.name, self._files = place, name, files

    # --- what is there ---------------------------------------------------------------------------

    @property
    def paths(self) -> dict[str, Path]:
        """Its files by the end of their names, whether they are there or not."""
        return {end: self.place.folder / f"{self.name}{end}" for end in self._files}

    @property
    def exists(self) -> bool:
        """Whether all its files are there."""
        return all(path.is_file() for path in self.paths.values())

    @property
    def missing(self) -> str | None:
        """What is not there and which rule writes it, in a sentence; None where nothing lacks."""
        gone = [end for end, path in self.paths.items() if not path.is_file()]
        if not gone:
            return None
        names = " and ".join(f"{self.place.prefix}{self.name}{end}" for end in gone)
        verb, it = ("is", "it") if len(gone) == 1 else ("are", "them")
        return f"{names} {verb} not there: rule {self._files[gone[0]].rule} writes {it}"

    @property
    def of_some_samples(self) -> bool:
        """Whether only samples have it whose grains break or whose packings another code made."""
        return any(file.rule in OF_SOME_SAMPLES for file in self._files.values())

    @property
    def reason(self) -> str | None:
        """Why the result holds no data, in the words of the rule; None where it does."""
        if ".json" in self._files:
            return self.summary.get("reason")
        return self.data["reason"].iloc[0] if list(self.data.columns) == ["reason"] else None

    # --- what it holds ---------------------------------------------------------------------------

    @cached_property
    def data(self) -> pd.DataFrame:
        """The table; `attrs["units"]` of it has the units by name of the column."""
        return self.read()

    def read(
        self, columns: Sequence[str] | None = None, states: Sequence[int] | None = None
    ) -> pd.DataFrame:
        """Return some columns of the table, or the rows of some states, and read no more.

        Parameters
        ----------
        columns : sequence of str, optional
            All by default.
        states : sequence of int, optional
            Of a table with a column state; all by default.

        Returns
        -------
        DataFrame

        Raises
        ------
        ResultsError
            When there is no table, its file is not there, or it lacks such a column.
        """
        end = next((end for end in self._files if end in _TABLES), None)
        if end is None:
            raise ResultsError(f"{self.title} has no table: its numbers are in .summary")
        path = self._present(end)
        try:
            table = read_table(path, columns, states)
        except (ValueError, KeyError) as error:
            raise ResultsError(f"{path} cannot be read as asked: {error}") from None
        self._compare(path, self._files[end], None if columns else list(table.columns))
        table.attrs["units"] = {name: self.units.get(name, "") for name in table.columns}
        return table

    @cached_property
    def summary(self) -> dict[str, Any]:
        """The numbers beside the table, of the JSON file, without their provenance."""
        if ".json" not in self._files:
            raise ResultsError(f"{self.title} has no numbers beside its table, which is in .data")
        path = self._present(".json")
        self._compare(path, self._files[".json"], None)
        return {name: value for name, value in read_json(path).items() if name != "provenance"}

    def __getitem__(self, column: str) -> pd.Series:
        if column not in self.data:
            known = ", ".join(self.data.columns)
            raise KeyError(f"{self.title} has no column {column!r}; it has {known}")
        return self.data[column]

    # --- what is known of it ---------------------------------------------------------------------

    @cached_property
    def units(self) -> dict[str, str]:
        """Unit of each column and key; "-" without dimension, empty where it is no number."""
        return {column.name: column.unit for column in self._columns()}

    @property
    def columns(self) -> pd.DataFrame:
        """A row for each column and key: name, type, unit and meaning, from the dictionary."""
        return pd.DataFrame(self._columns(), columns=list(Column._fields))

    @cached_property
    def provenance(self) -> dict[str, Any]:
        """What made it: version, sample, seed and settings."""
        return read_provenance(self._present(next(iter(self._files))))

    def plot(self, ax: Any = None) -> Any:
        """Draw it as the figure of the report that shows it does, and return the Axes.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            A new figure by default.

        Returns
        -------
        Axes

        Raises
        ------
        ResultsError
            When no single panel shows it. The message names the figures that do.
        """
        return drawn_by_plotting(self, ax)

    @property
    def figures(self) -> tuple[str, ...]:
        """Figures of the study that show it, below `results/figures`."""
        names = [name for file in self._files.values() for name in file.figures]
        return tuple(dict.fromkeys(self.place.filled(f"{name}.png") for name in names))

    @property
    def title(self) -> str:
        """How it is called in messages."""
        return f"{self.name} of {self.place.title}"

    def __repr__(self) -> str:
        if self.missing:
            return f"{self.title}: {self.missing}"
        lines = [f"{self.title}: {self._files[next(iter(self._files))].holds}"]
        if self.reason:
            return "\n".join([*lines, f"  no data: {self.reason}"])
        if any(end in self._files for end in _TABLES):
            there = {column.name: column for column in self._columns()}
            lines.append(f"  {len(self.data)} rows in .data")
            lines += [
                f"    {name}{_bracket(there[name].unit)}: {there[name].meaning}"
                if name in there
                else f"    {name}: not in the dictionary of this version"
                for name in self.data.columns
            ]
        if ".json" in self._files:
            lines.append(f"  {len(self.summary)} keys in .summary: {', '.join(self.summary)}")
        return "\n".join(lines)

    # --- inside ----------------------------------------------------------------------------------

    def _columns(self) -> list[Column]:
        return [column for file in self._files.values() for column in file.columns()]

    def _present(self, end: str) -> Path:
        path = self.paths[end]
        if not path.is_file():
            raise ResultsError(
                f"{self.missing}. Run the study to its end, in "
                f"{self.place.package.folder.absolute().parent}; .missing() lists all that lacks"
            )
        return self.place.package.checked(path)

    def _compare(self, path: Path, file: ResultFile, columns: list[str] | None) -> None:
        """Warn of a file that another version wrote, or whose columns this one does not know."""
        made = read_provenance(path).get("branchcrush")
        if made != __version__:
            text = f"{path} is of branchcrush {made or 'unknown'}, and this is {__version__}"
            self.place.package.warn(text)
        if columns is None or columns == ["reason"]:
            return
        known = {column.name for column in file.columns()}
        unknown = [name for name in columns if name not in known]
        lacking = [] if file.partial else sorted(known - file.rare - set(columns))
        for names, what in ((unknown, "has columns that this version does not know"),
                            (lacking, "lacks columns of this version")):  # fmt: skip
            if names:
                text = f"{path} {what}: {', '.join(names)}. Run the study again with it."
                self.place.package.warn(text)


def drawn_by_plotting(what: Any, ax: Any) -> Any:
    """Return the Axes on which the room of figures draws a result or a state.

    That room is above this one, and is loaded by its name when something is drawn, as pandas loads
    its own: whoever only reads, loads no matplotlib.

    Parameters
    ----------
    what : Result or State
    ax : matplotlib.axes.Axes or None

    Returns
    -------
    Axes
    """
    return import_module("branchcrush.plotting.results").plot(what, ax)


def _bracket(unit: str) -> str:
    return f" [{unit}]" if unit else ""
