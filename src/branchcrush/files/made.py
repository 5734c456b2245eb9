"""What the record of a job is: what made its files, and what they held when it left them.

A record is written by the job that made the files, as its last act: `made.json` beside the files of
a packing, `made/<rule>.json` below the folder of a sample, of a material or of the study. It ends
with the digest of itself.
"""

import hashlib
import json
from collections.abc import Iterator, Mapping
from os import PathLike
from pathlib import Path, PurePosixPath
from typing import Any

_RESULTS = "results"
# The last key of a record, and how it stands in the file.
_DIGEST = "sha256"
_SEAL = f',\n "{_DIGEST}": "'.encode()
_END = b'"\n}\n'
_KINDS = {
    **dict.fromkeys(("branchcrush", "rule", "code"), str),
    **dict.fromkeys(("wildcards", "params", "inputs", "outputs"), dict),
}


def record_bytes(record: Mapping[str, Any]) -> bytes:
    """Return a record as it is written: JSON that ends with the SHA-256 of all before.

    Parameters
    ----------
    record : mapping

    Returns
    -------
    bytes

    Examples
    --------
    >>> print(record_bytes({"rule": "fit"}).decode(), end="")
    {
     "rule": "fit",
     "sha256": "62f383ad77dc88169b1..."
    }
    """
    body = json.dumps(record, indent=1, ensure_ascii=False).encode().removesuffix(b"\n}")
    return body + _SEAL + hashlib.sha256(body).hexdigest().encode() + _END


def read_record(path: str | PathLike[str]) -> dict[str, Any] | None:
    """Return a record, {} of a damaged one, None where there is none.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    dict or None
        branchcrush: the version; rule, wildcards: of the job; code: digest of the sources that its
        script runs; params: the configuration that it used; inputs, outputs, beside: SHA-256 of
        each file by its path, from the folder that the study ran in.

    Examples
    --------
    >>> read_record("results/nothing/made/of.json") is None
    True
    """
    try:
        content = Path(path).read_bytes()
        record = json.loads(content)
    except FileNotFoundError:
        return None
    except (OSError, ValueError, RecursionError):
        return {}
    whole = isinstance(record, dict) and all(
        isinstance(record.get(key), kind) for key, kind in _KINDS.items()
    )
    if not whole:
        return {}
    body, _, end = content.rpartition(_SEAL)
    sealed = end == hashlib.sha256(body).hexdigest().encode() + _END
    return record if sealed else {}


def below_results(path: str, wildcards: Mapping[str, Any]) -> tuple[str, str]:
    """Split a path that a record holds into the folder of the results and what is below it.

    Parameters
    ----------
    path : str
        Of the record itself, or of one of its outputs.
    wildcards : mapping
        Of the job: a sample may be called as the folder is.

    Returns
    -------
    folder, below : str

    Examples
    --------
    >>> below_results("crushing/results/sand/seed_1/path.csv", {"sample": "sand", "seed": "1"})
    ('crushing/results', 'sand/seed_1/path.csv')
    >>> below_results("results/results/path.csv", {"sample": "results"})
    ('results', 'results/path.csv')
    """
    parts = path.split("/")
    places = [number for number, part in enumerate(parts) if part == _RESULTS]
    own = list(wildcards.values()).count(_RESULTS)
    if len(places) <= own:
        return "", path
    at = places[-1 - own] + 1
    return "/".join(parts[:at]), "/".join(parts[at:])


def below_folder(path: str, folder: str) -> str:
    """Return where a file lies below the folder of the results, "" of the user's own.

    Parameters
    ----------
    path : str
        Of an input that a record tells of.
    folder : str
        From `below_results`; "" where the record does not tell it.

    Returns
    -------
    str

    Examples
    --------
    >>> below_folder("results/sand/fit.csv", "results"), below_folder("/data/sieve.csv", "")
    ('sand/fit.csv', '')
    """
    return path.removeprefix(f"{folder}/") if folder and path.startswith(f"{folder}/") else ""


def is_record(below: str) -> bool:
    """Return whether a file below the results is a record, by its name.

    Parameters
    ----------
    below : str

    Returns
    -------
    bool

    Examples
    --------
    >>> is_record("sand/seed_1/made.json"), is_record("sand/made/fit.json"), is_record("a.json")
    (True, True, False)
    """
    path = PurePosixPath(below)
    of_packing = path.name == "made.json" and path.parent.name.startswith("seed_")
    return of_packing or (path.suffix == ".json" and path.parent.name == "made")


def left_by(record: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield path and digest of what a record tells of: results, and what lies beside them.

    Parameters
    ----------
    record : mapping

    Yields
    ------
    path, digest : str
    """
    yield from record["outputs"].items()
    yield from record.get("beside", {}).items()
