"""What a file holds, as one digest, found without reading it again while nothing touched it."""

import hashlib
import json
import os
from collections.abc import Iterable
from os import PathLike
from pathlib import Path

from branchcrush.files.replacing import replacing

# Below the folder that a study runs in, beside what Snakemake notes; whoever deletes it loses time.
_NOTES = Path(".snakemake", "branchcrush")


def file_digest(path: str | PathLike[str]) -> str:
    """Return the SHA-256 of a file's content, as `sha256sum` prints it.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    str
        64 hexadecimal digits.

    Raises
    ------
    OSError
        When the file cannot be read.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "abc.txt")
    ...     _ = path.write_bytes(b"abc")
    ...     file_digest(path)[:16]
    'ba7816bf8f01cfea'
    """
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


class Digests:
    """Digests of files, each read once.

    A digest is noted with size and times of its file. While these are the same the note is taken;
    where one of them changed, the file is read. A note that is lost or damaged costs time only.
    Notes are kept of files below the working folder, a file of notes for each folder and writer.

    Parameters
    ----------
    writer : str
        Name of who notes: one file of notes each, so that jobs side by side never share one.
    trust : bool
        Whether notes are taken. A disk that changes a bit by itself changes no time, so whoever
        wants to know what a file holds now reads it.

    Examples
    --------
    >>> import contextlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
    ...     _ = Path("abc.txt").write_bytes(b"abc")
    ...     digests = Digests("example")
    ...     print(digests.of("abc.txt")[:16])
    ...     digests.note()
    ...     print(*Path(".snakemake").rglob("*.json"))
    ba7816bf8f01cfea
    .snakemake/branchcrush/example.json
    """

    def __init__(self, writer: str, *, trust: bool = True) -> None:
        self._writer, self._trust = writer, trust
        self._noted: dict[str, dict[str, list[list]]] = {}
        self._digests: dict[str, str] = {}
        self._new: dict[str, dict[str, list]] = {}

    def of(self, path: str) -> str:
        """Return the digest of a file, or "" where there is none or it cannot be read.

        Parameters
        ----------
        path : str

        Returns
        -------
        str
            From `file_digest`.
        """
        if path not in self._digests:
            try:
                self._digests[path] = self._found(path)
            except OSError:
                self._digests[path] = ""
        return self._digests[path]

    def note(self) -> None:
        """Keep what had to be read, for the next `Digests` in this folder."""
        for folder, entries in self._new.items():
            notes = _NOTES / folder / f"{self._writer}.json"
            kept = _read(notes)
            # Only one's own: those of files that are gone would heap up.
            kept = {name: entry for name, entry in kept.items() if Path(folder, name).exists()}
            try:
                with replacing(notes) as file:
                    file.write(json.dumps({**kept, **entries}).encode())
            except OSError:  # of a full disk, or a folder of somebody else: found again next time
                return
        self._new = {}

    def _found(self, path):
        """Return the digest of a file from the notes, or from the file."""
        status = os.stat(path)
        # The last tells of a change that puts back the time of the file.
        state = [status.st_size, status.st_mtime_ns, status.st_ctime_ns]
        folder, name = os.path.split(path)
        ours = not os.path.isabs(path) and ".." not in Path(folder).parts
        entries = self._notes(folder).get(name, ()) if ours else ()
        known = {digest for *noted, digest in entries if noted == state}
        # Two of one state are of a disk that changed the file by itself.
        if self._trust and len(known) == 1:
            return known.pop()
        digest = file_digest(path)
        if ours and digest not in known:
            self._new.setdefault(folder, {})[name] = [*state, digest]
        return digest

    def _notes(self, folder):
        """Return what all writers noted of the files in a folder."""
        if folder not in self._noted:
            self._noted[folder] = notes = {}
            for file in (_NOTES / folder).glob("*.json"):
                for name, entry in _read(file).items():
                    notes.setdefault(name, []).append(entry)
        return self._noted[folder]


def _read(notes):
    """Return the entries of a file of notes; none of one that is missing or damaged."""
    try:
        entries = json.loads(notes.read_bytes())
    except (OSError, ValueError):
        return {}
    return {
        name: entry
        for name, entry in (entries.items() if isinstance(entries, dict) else ())
        if isinstance(entry, list) and len(entry) == 4 and isinstance(entry[-1], str)
    }


def digests_of(paths: Iterable[str], digests: Digests) -> dict[str, str]:
    """Return the digest of each file by its path.

    Parameters
    ----------
    paths : iterable of str
        A path may come twice.
    digests : Digests

    Returns
    -------
    dict of str
        In the order of the paths.
    """
    return {path: digests.of(path) for path in dict.fromkeys(paths)}
