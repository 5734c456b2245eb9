"""A place of the results: the study, a sample or a packing, and the files that belong there."""

import difflib
from functools import cache, cached_property
from pathlib import Path, PurePosixPath
from typing import ClassVar

from branchcrush.files.dictionary import ResultFile, result_files
from branchcrush.results.package import Package
from branchcrush.results.result import Result

# Ends of the files that are results by themselves; pictures, pages and dumps are not.
_ENDS = (".csv", ".parquet", ".json")
# What describes the others, what the study was asked for, and what a job notes of itself.
_NOTES = ("made", "datapackage", "config")


class Place:
    """A folder of results, whose results are attributes: `sample.energy_split`.

    Parameters
    ----------
    package : Package
        The folder `results`, and what a finished study has there.
    **words
        What stands in the pattern of its files: sample, seed.
    """

    pattern: ClassVar[str] = ""

    def __init__(self, package: Package, **words: str | int) -> None:
        self.package, self._words = package, words

    @property
    def title(self) -> str:
        """How it is called in messages."""
        return str(self.folder)

    def filled(self, pattern: str) -> str:
        """Return a pattern of the dictionary with the words of this place.

        Parameters
        ----------
        pattern : str
            With ``<sample>`` and the like.

        Returns
        -------
        str

        Examples
        --------
        >>> Place(Package("results"), sample="sand").filled("<sample>/fabric.csv")
        'sand/fabric.csv'
        """
        for name, value in self._words.items():
            pattern = pattern.replace(f"<{name}>", str(value))
        return pattern

    @property
    def prefix(self) -> str:
        """Its folder below `results`, with a slash at the end; empty of the study."""
        return self.filled(self.pattern)

    @property
    def folder(self) -> Path:
        """Where its files are."""
        return self.package.folder / self.prefix

    @cached_property
    def results(self) -> dict[str, Result]:
        """Every result that the dictionary has for such a place, there or not, by its name."""
        return {name: Result(self, name, files) for name, files in _named(self.pattern).items()}

    def missing(self) -> list[str]:
        """Return what a finished study has here and this one lacks, a sentence each.

        Returns
        -------
        list of str
            Of a study that has not been finished yet, the results that every study has.
        """
        if self.package.finished:
            return self.package.gone(self.prefix)
        results = self.results.values()
        return [one.missing for one in results if one.missing and not one.of_some_samples]

    def __getattr__(self, name: str) -> Result:
        if name.startswith("_"):  # asked by copies and notebooks, of objects not yet complete
            raise AttributeError(name)
        if name in self.results:
            return self.results[name]
        near = difflib.get_close_matches(name, list(self.results), 3)
        hint = f"Did you mean {' or '.join(near)}? " if near else ""
        known = ", ".join(self.results)
        raise AttributeError(f"{self.title} has no result {name!r}. {hint}There are: {known}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.results]


@cache
def _named(pattern: str) -> dict[str, dict[str, ResultFile]]:
    """Return the files of the dictionary that lie in such a folder, by name and end."""
    named: dict[str, dict[str, ResultFile]] = {}
    for file in result_files():
        if not file.path.startswith(pattern):
            continue
        rest = PurePosixPath(file.path.removeprefix(pattern))
        if len(rest.parts) == 1 and rest.suffix in _ENDS and rest.stem not in _NOTES:
            named.setdefault(rest.stem, {})[rest.suffix] = file
    return named
