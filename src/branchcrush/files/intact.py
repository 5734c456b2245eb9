"""Whether a file of the results is what its job left, and whether files go together."""

from collections.abc import Iterable, Iterator, Mapping
from os import PathLike
from pathlib import Path, PurePosixPath
from typing import Any

from branchcrush.errors import ResultsError
from branchcrush.files.made import below_folder, below_results, left_by, read_record


class Records:
    """The records below a folder of results, each read once, when it is asked for.

    Parameters
    ----------
    folder : path-like
        The folder `results`, wherever it lies now.
    """

    def __init__(self, folder: str | PathLike[str]) -> None:
        self.folder = Path(folder)
        self._read: dict[str, dict[str, Any] | None] = {}
        self._told: dict[str, dict[str, str]] = {}
        self._near: dict[str, list[str]] = {}

    def record(self, place: str) -> dict[str, Any] | None:
        """Return a record by its place below the folder, as `read_record` does."""
        if place not in self._read:
            self._read[place] = read_record(self.folder / place)
        return self._read[place]

    def told(self, place: str) -> dict[str, str]:
        """Return what a record tells of: the digest of each file by its place below the folder."""
        if place not in self._told:
            record = self.record(place)
            self._told[place] = {
                below_results(path, record["wildcards"])[1]: digest
                for path, digest in (left_by(record) if record else ())
            }
        return self._told[place]

    def makers(self, below: str) -> list[str]:
        """Return the places of the whole records that tell of a file; more than one is rare.

        Parameters
        ----------
        below : str
            The file, below the folder.

        Returns
        -------
        list of str
        """
        return [place for place in self._places(below) if below in self.told(place)]

    def fault(self, below: str, digest: str) -> str:
        """Return why a file is not what its job left, and what to do; "" where it is.

        Parameters
        ----------
        below : str
            The file, below the folder.
        digest : str
            SHA-256 of what it holds now; "" where it is missing or cannot be read.

        Returns
        -------
        str
        """
        file = self.folder / below
        told = [self.told(place)[below] for place in self.makers(below)]
        if told and not digest:
            return f"{file} is missing or cannot be read: {again(file)}"
        if digest in told:
            return ""
        if told:
            return f"{file} is not as its job left it (changed, cut or damaged): {again(file)}"
        for place in self._places(below):
            record, beside = self.record(place), self.folder / place
            if record == {}:
                return (
                    f"{beside} is damaged, and nothing else tells what made {file.name}: "
                    f"{again(beside)}"
                )
            if record and place.endswith("made.json"):
                words = " ".join(f"{name} {value}" for name, value in record["wildcards"].items())
                return (
                    f"{file} does not belong here: the record beside it, of {words}, does not "
                    f"tell of it: {again(file)}"
                )
        return f"{file} has no record of what made it: {again(file)}"

    def is_recorded(self, below: str) -> bool:
        """Return whether there is a record, whole or not, that should tell of a file."""
        places = self._places(below)
        return bool(self.makers(below)) or any(
            self.record(place) == {} or place.endswith("made.json") for place in places
        )

    def _places(self, below: str) -> list[str]:
        """Return where the record of a file may be."""
        folder = PurePosixPath(below).parent
        if folder.parts[:1] == ("figures",):
            folder = folder.relative_to("figures")
        if str(folder) == "findings":
            folder = PurePosixPath()
        return self._near_by(str(folder))

    def _near_by(self, folder: str) -> list[str]:
        if folder not in self._near:
            place = self.folder / folder
            found = [place / "made.json"] if (place / "made.json").exists() else []
            found += sorted((place / "made").glob("*.json"))
            self._near[folder] = [one.relative_to(self.folder).as_posix() for one in found]
        return self._near[folder]


def disagreements(records: Iterable[tuple[str, Mapping[str, Any]]]) -> Iterator[tuple[str, str]]:
    """Yield which records do not go together with those before them, and why.

    What one job read is what another left; and all jobs of a sample had the same configuration.

    Parameters
    ----------
    records : iterable of (name, record)
        The first are taken for right.

    Yields
    ------
    name, reason : str
    """
    read = list(records)
    left: dict[str, set[str]] = {}
    for _, record in read:
        for path, digest in left_by(record):
            left.setdefault(path, set()).add(digest)
    settings: dict[tuple[str, str, str], Any] = {}
    for name, record in read:
        files = record["inputs"].items()
        other = [path for path, digest in files if digest not in left.setdefault(path, {digest})]
        if other:
            yield name, f"from another {other[0]} than the one that is there"
        changed = [
            key
            for *of, key, value in _settings(record)
            if settings.setdefault((*of, key), value) != value
        ]
        if changed:
            yield name, f"with another configuration ({', '.join(dict.fromkeys(changed))})"


def _settings(record):
    """Yield kind, name, key and value of what a record holds of samples and materials."""
    params, words = record["params"], record["wildcards"]
    sections = []
    if isinstance(params.get("samples"), dict):
        sections += [("sample", *one) for one in params["samples"].items()]
    for kind in ("sample", "material"):
        if kind in words and isinstance(params.get(kind), dict):
            sections.append((kind, words[kind], params[kind]))
    for kind, name, section in sections:
        for key, value in section.items() if isinstance(section, dict) else ():
            # Where the grains of a packing that was read are listed is up to a module's prefix.
            known = {k: v for k, v in value.items() if k != "file"} if key == "grading" else value
            yield kind, name, key, known


def check_inputs(record: Mapping[str, Any], place: str) -> None:
    """Stop a job that would read what no job left, another's, or what does not go together.

    Parameters
    ----------
    record : mapping
        Of the job itself, as far as it is known before: with the digests of its inputs now.
    place : str
        Path of the record. Inputs below its folder `results` are those of other jobs; all others
        are the user's own, of which nothing is known before.

    Raises
    ------
    ResultsError
        Names the first file that is wrong, what is wrong, and what to do.

    Examples
    --------
    >>> words = {"wildcards": {"sample": "sand"}, "params": {}}
    >>> check_inputs({**words, "inputs": {"sieve.csv": "f00"}}, "results/sand/made/fit.json")
    """
    folder, _ = below_results(place, record["wildcards"])
    records = Records(folder)
    results = {
        below: digest
        for path, digest in record["inputs"].items()
        if (below := below_folder(path, folder))
    }
    refuse([records.fault(below, digest) for below, digest in results.items()])
    makers = dict.fromkeys(maker for below in results for maker in records.makers(below))
    others = [(maker, records.record(maker)) for maker in makers]
    refuse(
        f"{records.folder / maker} tells that its files were made {reason}: delete it and run the "
        "study again"
        for maker, reason in disagreements([("", {**record, "outputs": {}}), *others])
    )


def refuse(faults: Iterable[str]) -> None:
    """Raise the first of some faults, which are none where empty.

    Parameters
    ----------
    faults : iterable of str
        From `Records.fault`.

    Raises
    ------
    ResultsError
    """
    first, *more = [fault for fault in faults if fault] or [""]
    if first:
        raise ResultsError(first + (f" ({len(more)} more like it)" if more else ""))


def again(file: Path) -> str:
    """Return what to do about a file that is wrong.

    Parameters
    ----------
    file : Path

    Returns
    -------
    str

    Examples
    --------
    >>> again(Path("results/sand/path.csv"))
    'delete path.csv and run the study again'
    """
    return f"delete {file.name} and run the study again"
