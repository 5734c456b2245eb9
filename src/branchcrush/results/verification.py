"""Whether every file of a study is what its job left, and all belong together."""

import os
from collections.abc import Iterator
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

from branchcrush import __version__
from branchcrush.errors import ResultsError
from branchcrush.files.dictionary import result_files
from branchcrush.files.digests import file_digest
from branchcrush.files.intact import Records, again, disagreements
from branchcrush.files.made import below_folder, below_results, is_record
from branchcrush.files.tables import read_json
from branchcrush.results.package import folder_of_results
from branchcrush.words import few

_PACKAGE = "datapackage.json"
# What `results.crate` writes beside.
CRATE = "ro-crate-metadata.json"
# What it makes is asked for by hand, and has no record.
_PREVIEW = "preview"


class Verification(NamedTuple):
    """What became of the files of a study.

    Parameters
    ----------
    folder : Path
        Of the results.
    faults : list of str
        A line for each file that is not what its job left, or does not belong to the others.
    notes : list of str
        What else there is to know, which is no fault.
    whole : int
        How many files are what their jobs left.
    records : dict
        By its place below the folder, each record that is whole and where it belongs.
    """

    folder: Path
    faults: list[str]
    notes: list[str]
    whole: int
    records: dict[str, dict[str, Any]]


def verify(folder: str | PathLike[str]) -> Verification:
    """Read every file of a study, and hold it against the record of the job that made it.

    Parameters
    ----------
    folder : path-like
        `results`, or the folder that holds it. Neither Snakemake nor a configuration is needed.

    Returns
    -------
    Verification

    Raises
    ------
    ResultsError
        When there are no results in the folder.

    Examples
    --------
    >>> verify("nowhere")
    Traceback (most recent call last):
    branchcrush.errors.ResultsError: nowhere is no folder: ...
    """
    study = _Study(folder_of_results(folder))
    if not study.there:
        raise ResultsError(f"{study.folder} holds no results: name the folder results of a study")
    # By file, so that each is named once: first what it is itself, then what it goes with.
    faults: dict[str, str] = {}
    for file, fault in (*study.records_at_fault(), *study.files_at_fault()):
        faults.setdefault(file, fault)
    listed = study.listed() if _PACKAGE not in faults else {}
    for file, fault in (*study.missing(listed), *study.strangers(listed)):
        faults.setdefault(file, fault)
    whole = [file for file in study.told_of() if file in study.there and file not in faults]
    notes = study.notes(listed)
    # Of a run that was asked for some files only, as a module's.
    never = [file for file in listed if file not in study.there and file not in faults]
    if never:
        rules = ", ".join(dict.fromkeys(listed[file] for file in never))
        notes.append(f"not made, or deleted with what told of them: {len(never)} of rule {rules}")
    return Verification(study.folder, list(faults.values()), notes, len(whole), study.whole)


class _Study:
    """The files below a folder of results, and the records among them."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.records = folder, Records(folder)
        self.there = {file: None for file in sorted(_files(folder))}
        self.places = [file for file in self.there if is_record(file)]
        # Records that are whole, and where they belong.
        self.whole = {
            place: record
            for place in self.places
            if (record := self.records.record(place))
            and all(place in self.records.makers(file) for file in self.records.told(place))
        }

    def told_of(self) -> dict[str, None]:
        """Return the files that records tell of."""
        return {file: None for place in self.whole for file in self.records.told(place)}

    def listed(self) -> dict[str, str]:
        """Return the rule of each file that a finished study says that it has."""
        try:
            package = read_json(self.folder / _PACKAGE)
            return {one["path"]: one["rule"] for one in package["resources"]}
        except (OSError, ValueError, LookupError, TypeError):  # not there, or told of as at fault
            return {}

    # --- what is wrong: file and line -------------------------------------------------------------

    def records_at_fault(self) -> Iterator[tuple[str, str]]:
        """Yield records that are damaged, or that lie where other files are."""
        for place in self.places:
            file, record = self.folder / place, self.records.record(place)
            if not record:
                yield (
                    place,
                    f"{file} is damaged, and nothing else tells what made its files: {again(file)}",
                )
            elif place not in self.whole:
                yield (
                    place,
                    f"{file} is the record of other files ({_words(record)}): {again(file)}",
                )

    def files_at_fault(self) -> Iterator[tuple[str, str]]:
        """Yield results that are not what their record tells, or that have none."""
        told = self.told_of()
        for file in self.there:
            if file in told or (file not in self.places and _is_result(file)):
                fault = self.records.fault(file, _digest(self.folder / file))
                if fault:
                    yield file, fault

    def missing(self, listed: dict[str, str]) -> Iterator[tuple[str, str]]:
        """Yield what jobs left or read, and is not there."""
        rules: dict[str, str] = {}
        for record in self.whole.values():
            for path in record["outputs"]:
                rules.setdefault(below_results(path, record["wildcards"])[1], record["rule"])
            for path in record["inputs"]:
                if below := below_folder(path, _root(record)):
                    rules.setdefault(below, listed.get(below, ""))
        for file, rule in rules.items():
            if file not in self.there:
                writes = f" (rule {rule} writes it)" if rule else ""
                yield file, f"{self.folder / file} is missing: run the study again{writes}"

    def strangers(self, listed: dict[str, str]) -> Iterator[tuple[str, str]]:
        """Yield records of files that do not go together with others."""
        current = {
            place: record
            for place, record in self.whole.items()
            if not listed or any(file in listed for file in self.records.told(place))
        }
        # What made the study's tables of all samples knows the configuration of every one.
        first = sorted(current, key=lambda place: place != "made/comparison.json")
        named = [("", self._data(current.values()))] if current else []
        for place, reason in disagreements([*named, *((one, current[one]) for one in first)]):
            file = self.folder / place
            yield place, f"{file} tells that its files were made {reason}: {again(file)}"

    def _data(self, records):
        """Return the user's own files as they are now, as if a job had read them all."""
        found = {}
        for record in records:
            root = _root(record)
            # The folder that the study ran in, above a prefix of a module too. Absolute outputs do
            # not tell it, and a copy may lie less deep.
            above = self.folder.absolute().parents[root.count("/") :]
            place = above[0] if above and not root.startswith("/") else None
            for path in record["inputs"]:
                if path in found or below_folder(path, root):
                    continue
                file = Path(path) if place is None else place / path
                if file.is_absolute() and file.is_file():
                    found[path] = _digest(file)
        return {"wildcards": {}, "params": {}, "inputs": found, "outputs": {}}

    # --- what else there is to know ---------------------------------------------------------------

    def notes(self, listed: dict[str, str]) -> list[str]:
        """Return what is no fault: versions, and files that are not the study's."""
        notes = []
        versions = sorted({record["branchcrush"] for record in self.whole.values()})
        if versions and versions != [__version__]:
            notes.append(f"made by branchcrush {', '.join(versions)}; this is {__version__}")
        told = self.told_of()
        outputs = {
            file
            for record in self.whole.values()
            for _, file in (below_results(path, record["wildcards"]) for path in record["outputs"])
        }
        known = {*listed, _PACKAGE}
        left = [file for file in self.there if listed and file in outputs and file not in known]
        if left:
            notes.append(f"of samples or seeds that the study no longer has: {few(left)}")
        others = [
            file
            for file in self.there
            if not (file in told or file == CRATE or is_record(file)) and _is_result(file) is None
        ]
        if others:
            notes.append(f"no results of this study: {few(others)}")
        return notes


def _files(folder: Path, above: tuple[str, ...] = ()) -> Iterator[str]:
    """Yield all files below a folder but for hidden ones, which are nobody's results.

    Linked folders belong to it, as one that was moved to another disk; of a link to a folder that
    it lies in, `above`, there is nothing more.
    """
    real = os.path.realpath(folder)
    if real in above:
        return
    try:
        entries = list(folder.iterdir())
    except OSError:  # its files are told of as missing
        return
    for entry in entries:
        if entry.name.startswith("."):
            continue
        if entry.is_dir():
            yield from (f"{entry.name}/{file}" for file in _files(entry, (*above, real)))
        else:
            yield entry.name


def _is_result(file: str) -> bool | None:
    """Return whether a file is one that jobs leave; None where nothing is known of such a file."""
    rules = [kind.rule for kind in result_files() if kind.matches(file)]
    return _PREVIEW not in rules if rules else None


def _root(record: dict[str, Any]) -> str:
    """Return the folder of the results as a record tells it."""
    return below_results(next(iter(record["outputs"]), ""), record["wildcards"])[0]


def _digest(file: Path) -> str:
    try:
        return file_digest(file)
    except OSError:
        return ""


def _words(record: dict[str, Any]) -> str:
    words = " ".join(f"{name} {value}" for name, value in record["wildcards"].items())
    return f"rule {record['rule']}{' of ' if words else ''}{words}"
