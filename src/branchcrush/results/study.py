"""The results of a study: its samples, and its tables of all samples."""

import difflib
from collections.abc import Iterator
from functools import cached_property
from os import PathLike
from typing import Any

from branchcrush import __version__
from branchcrush.errors import ResultsError
from branchcrush.files.dictionary import REFINED
from branchcrush.results.package import Package, folder_of_results
from branchcrush.results.place import Place
from branchcrush.results.sample import Sample


class Material(Place):
    """A material that a laboratory measured: `gradings`, `breakage`, `compression`.

    Taken from a study, as `study.materials["sand"]`.
    """

    pattern = "measured/<material>/"

    @property
    def title(self) -> str:
        """How it is called in messages."""
        return f"material {self._words['material']}"

    def __repr__(self) -> str:
        there = ", ".join(name for name, one in self.results.items() if one.exists)
        return f"{self.title}: results {there or 'none'}"


class Study(Place):
    """The results of a study: samples by name, as `study["sand"]`, and `comparison`, `findings`.

    Opened by `branchcrush.open_study`.
    """

    @classmethod
    def opened(cls, folder: str | PathLike[str]) -> "Study":
        """Return the study of a folder, having looked which samples there are.

        Parameters
        ----------
        folder : path-like
            `results`, or the folder that holds it.

        Returns
        -------
        Study

        Raises
        ------
        ResultsError
            When there are no results in the folder.
        """
        study = cls(Package(folder_of_results(folder)))
        if not study.samples:
            raise ResultsError(
                f"{study.package.folder} holds no results: no folder <sample>/seed_<k> is in it. "
                "Name the folder results of a study, or run the study first"
            )
        made = study.provenance.get("branchcrush", __version__)
        if made != __version__:
            study.package.warn(
                f"{study.package.folder} is of branchcrush {made}, and this is {__version__}: "
                "columns may have other names. Run the study again, or read it with that version"
            )
        return study

    @property
    def title(self) -> str:
        """How it is called in messages."""
        return f"the study in {self.package.folder}"

    @property
    def provenance(self) -> dict[str, Any]:
        """Version, and under "samples" the settings of each; empty before the study is finished."""
        return self.package.provenance

    @cached_property
    def samples(self) -> dict[str, Sample]:
        """Its samples by name: those of a finished study, or those that have a packing yet."""
        found = sorted({folder.parent.name for folder in self.package.folder.glob("*/seed_*")})
        names = list(self.provenance.get("samples", ()))
        names = names or [name for name in found if not name.endswith(REFINED)]
        return {name: Sample(self.package, sample=name) for name in names}

    @cached_property
    def materials(self) -> dict[str, Material]:
        """The materials that a laboratory measured, by name; none in most studies."""
        found = (
            folder.name for folder in self.package.folder.glob("measured/*") if folder.is_dir()
        )
        return {name: Material(self.package, material=name) for name in sorted(found)}

    def __getitem__(self, name: str) -> Sample:
        if name not in self.samples:
            near = difflib.get_close_matches(name, list(self.samples), 1)
            hint = f"; did you mean {near[0]}?" if near else ""
            raise ResultsError(
                f"{self.title} has no sample {name!r}{hint} There are: {', '.join(self.samples)}"
            )
        return self.samples[name]

    def __iter__(self) -> Iterator[Sample]:
        return iter(self.samples.values())

    def __len__(self) -> int:
        return len(self.samples)

    def missing(self) -> list[str]:
        """Return what a finished study has and this one lacks, a sentence each.

        Returns
        -------
        list of str
        """
        if self.package.finished:
            return super().missing()
        packings = (packing for sample in self for packing in sample.seeds.values())
        below = [gone for place in (*self, *packings) for gone in place.missing()]
        return ["the study has not been run to its end yet", *super().missing(), *below]

    def __repr__(self) -> str:
        head = f"{self.title}: {len(self)} samples, branchcrush "
        lines = [head + self.provenance.get("branchcrush", "unknown (not finished)")]
        lines += ["  " + line for sample in self for line in repr(sample).splitlines()[:3]]
        there = ", ".join(name for name, one in self.results.items() if one.exists)
        lines.append(f"  results of all samples: {there or 'none'}")
        gone = self.missing()
        if gone:
            lines.append(f"  missing: {len(gone)} files or packings; .missing() lists them")
        return "\n".join(lines)
