"""What a finished study says of its own files, in `datapackage.json`."""

import warnings
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import Any

from branchcrush.errors import ResultsError, ResultsWarning
from branchcrush.files.digests import file_digest
from branchcrush.files.intact import Records
from branchcrush.files.tables import read_json

_RESULTS = "results"


def folder_of_results(given: str | PathLike[str]) -> Path:
    """Return the folder of the results of a study.

    Parameters
    ----------
    given : path-like
        `results`, or the folder that holds it.

    Returns
    -------
    Path

    Raises
    ------
    ResultsError
        When there is no such folder.

    Examples
    --------
    >>> folder_of_results("nowhere")
    Traceback (most recent call last):
    branchcrush.errors.ResultsError: nowhere is no folder: ...
    """
    given = Path(given)
    if not given.is_dir():
        raise ResultsError(f"{given} is no folder: name the folder results of a study that has run")
    inside = given / _RESULTS
    return inside if inside.is_dir() and not list(given.glob("*/seed_*")) else given


class Package:
    """The folder of the results, and the files that belong there once the study is finished.

    Parameters
    ----------
    folder : path-like
        The folder `results`.

    Examples
    --------
    >>> package = Package("nowhere")
    >>> package.finished, package.rules
    (False, {})
    """

    def __init__(self, folder: str | Path) -> None:
        self.folder = Path(folder)
        self._told: set[str] = set()
        self._checked: set[Path] = set()
        self._records = Records(self.folder)

    @property
    def finished(self) -> bool:
        """Whether the study has run to its end once."""
        return (self.folder / "datapackage.json").is_file()

    @cached_property
    def _content(self) -> dict[str, Any]:
        file = self.folder / "datapackage.json"
        if not self.finished:
            return {"resources": [], "provenance": {}}
        return read_json(self.checked(file))

    @cached_property
    def rules(self) -> dict[str, str]:
        """The rule that writes each file of the study, by its path below the folder."""
        return {one["path"]: one["rule"] for one in self._content["resources"]}

    @property
    def provenance(self) -> dict[str, Any]:
        """The version, and under "samples" the settings of each; empty before the end."""
        return self._content["provenance"]

    def figure(self, of: str, name: str) -> Path:
        """Return the picture of a figure, in PNG.

        Parameters
        ----------
        of : str
            The sample, or "findings" for those of all samples.
        name : str

        Returns
        -------
        Path

        Examples
        --------
        >>> Package("results").figure("sand", "sharing").as_posix()
        'results/figures/sand/sharing.png'
        """
        return self.folder / "figures" / of / f"{name}.png"

    def checked(self, path: Path) -> Path:
        """Return the path of a file, having looked that it is what its job left; once a file.

        A file without a record, as of an earlier version, is warned of.

        Parameters
        ----------
        path : Path
            Below the folder.

        Returns
        -------
        Path

        Raises
        ------
        ResultsError
            When the file is another one than its record tells of.
        """
        if path in self._checked:
            return path
        below = path.relative_to(self.folder).as_posix()
        try:
            digest = file_digest(path)
        except OSError as error:
            raise ResultsError(f"{path} cannot be read: {error.strerror}") from None
        if self._records.fault(below, digest):
            # The study may have been run again since they were read.
            self._records = Records(self.folder)
        if fault := self._records.fault(below, digest):
            if self._records.is_recorded(below):
                raise ResultsError(fault)
            self.warn(fault)
        self._checked.add(path)
        return path

    def warn(self, text: str) -> None:
        """Warn of a file of another version, or without a record, once.

        Parameters
        ----------
        text : str
        """
        if text not in self._told:
            self._told.add(text)
            warnings.warn(text, ResultsWarning, stacklevel=2)

    def gone(self, prefix: str) -> list[str]:
        """Return what a finished study has below a folder and this one lacks, a sentence each.

        Parameters
        ----------
        prefix : str
            As "sand/seed_1/"; empty for the whole study.

        Returns
        -------
        list of str
        """
        return [
            f"{path} is not there: rule {rule} writes it"
            for path, rule in self.rules.items()
            if path.startswith(prefix) and not (self.folder / path).is_file()
        ]
