"""What a finished study says of its own files, in `datapackage.json`."""

import warnings
from functools import cached_property
from pathlib import Path
from typing import Any

from branchcrush.errors import ResultsWarning
from branchcrush.files.tables import read_json


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

    @property
    def finished(self) -> bool:
        """Whether the study has run to its end once."""
        return (self.folder / "datapackage.json").is_file()

    @cached_property
    def _content(self) -> dict[str, Any]:
        file = self.folder / "datapackage.json"
        return read_json(file) if self.finished else {"resources": [], "provenance": {}}

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

    def warn(self, text: str) -> None:
        """Warn of a file of another version, once.

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
