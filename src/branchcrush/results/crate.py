"""A study described as RO-Crate: every file with its digest, and which job made it of what."""

import json
from collections.abc import Iterator, Mapping
from datetime import date
from os import PathLike
from pathlib import Path
from typing import Any
from urllib.parse import quote

from branchcrush.errors import ResultsError
from branchcrush.files.datapackage import media_type
from branchcrush.files.dictionary import result_files
from branchcrush.files.digests import file_digest
from branchcrush.files.made import below_folder, below_results, is_record, left_by
from branchcrush.files.replacing import replacing
from branchcrush.files.tables import read_json
from branchcrush.results.verification import CRATE, Verification, verify

_PROFILE = "https://w3id.org/ro/wfrun/process/0.5"
_VERSION = "1.1"
_ADDRESSES = {
    "lammps": "https://www.lammps.org",
    "matplotlib": "https://matplotlib.org",
    "mpi4py": "https://mpi4py.github.io",
    "numpy": "https://numpy.org",
    "pandas": "https://pandas.pydata.org",
    "pyarrow": "https://arrow.apache.org",
    "python": "https://www.python.org",
    "scipy": "https://scipy.org",
    "snakemake": "https://snakemake.github.io",
}
_NO_LICENCE = "No licence is stated: ask who made the study."


def write_crate(folder: str | PathLike[str], licence: str = "") -> Path:
    """Write `ro-crate-metadata.json` into the results of a finished study, which it verifies first.

    Parameters
    ----------
    folder : path-like
        `results`, or the folder that holds it.
    licence : str
        Address of the licence of the data; that none is stated by default.

    Returns
    -------
    Path

    Raises
    ------
    ResultsError
        When rocrate is not installed, the study has not been run to its end, or a file of it is not
        what its job left.

    References
    ----------
    https://w3id.org/ro/crate/1.1 and its profile Process Run Crate
    """
    try:
        from rocrate.model.contextentity import ContextEntity
        from rocrate.rocrate import ROCrate
    except ImportError:
        raise ResultsError(
            "metadata as RO-Crate need the package rocrate: pip install rocrate, or install "
            "branchcrush[crate]"
        ) from None
    found = verify(folder)
    if number := len(found.faults):
        raise ResultsError(
            f"{found.faults[0]} ({number} fault{'s' * (number > 1)}; branchcrush verify lists all)"
        )
    if not (found.folder / "datapackage.json").is_file():
        raise ResultsError(f"{found.folder} is of a study that has not been run to its end: run it")
    package = read_json(found.folder / "datapackage.json")
    crate = ROCrate(version=_VERSION)
    # Its words are those of schema.org of 2020, which had no such one.
    crate.metadata.extra_terms["sha256"] = "http://schema.org/sha256"
    root = crate.root_dataset
    root["name"] = "Results of a branchcrush study: " + ", ".join(package["provenance"]["samples"])
    root["description"] = package["description"]
    root["license"] = {"@id": licence} if licence else _NO_LICENCE
    if licence:
        named = {"@type": "CreativeWork", "name": licence}
        crate.add(ContextEntity(crate, licence, properties=named))
    root["datePublished"] = date.today().isoformat()
    root["conformsTo"] = {"@id": _PROFILE}
    profile = {"@type": "CreativeWork", "name": "Process Run Crate", "version": "0.5"}
    crate.add(ContextEntity(crate, _PROFILE, properties=profile))
    root["additionalProperty"] = [
        {"@id": f"#machine/{name}"} for name in package["provenance"].get("machine", {})
    ]
    for path, properties in _files(found):
        crate.add_file(dest_path=path, properties=properties)
    for name, properties in _entities(found, package["provenance"]):
        crate.add(ContextEntity(crate, name, properties=properties))
        if properties["@type"] == "CreateAction":
            root.append_to("mentions", {"@id": name})
    path = found.folder / CRATE
    with replacing(path) as file:
        file.write((json.dumps(crate.metadata.generate(), indent=1) + "\n").encode())
    return path


def _files(found: Verification) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield every file of the study by its path, with what is said of it."""
    known = result_files()
    digests = dict.fromkeys(found.records, "")
    for record in found.records.values():
        digests |= dict(_left(record))
    for path in sorted(digests):
        file = found.folder / path
        if not file.is_file():  # a dump that was deleted
            continue
        holds = next((kind.holds for kind in known if kind.matches(path)), "")
        if is_record(path):
            holds = "What made the results of the rule."
        properties = {
            "name": path,
            "description": holds,
            "encodingFormat": media_type(path),
            "contentSize": str(file.stat().st_size),
            "sha256": digests[path] or file_digest(file),
        }
        yield path, {key: value for key, value in properties.items() if value}


def _entities(
    found: Verification, provenance: Mapping[str, Any]
) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield by name what is no file: jobs, the user's data, software, the machine."""
    data: dict[str, str] = {}
    for place, record in found.records.items():
        words = " ".join(f"{name} {value}" for name, value in record["wildcards"].items())
        folder = below_results(next(iter(record["outputs"]), ""), record["wildcards"])[0]
        read = []
        for path, digest in record["inputs"].items():
            below = below_folder(path, folder)
            read.append(below or _data(path))
            if not below:
                data[path] = digest
        result = [below for below, _ in _left(record) if (found.folder / below).is_file()]
        yield (
            f"#job/{place}",
            {
                "@type": "CreateAction",
                "name": f"{record['rule']}{' of ' if words else ''}{words}",
                "description": f"SHA-256 of the sources of the rule: {record['code']}",
                "instrument": {"@id": "#branchcrush"},
                "object": _linked([*read, "config.json"]),
                "result": _linked([*result, place]),
            },
        )
    for path, digest in data.items():
        yield (
            _data(path),
            {"@type": "CreativeWork", "name": path, "sha256": digest,
             "description": "A file of the user's, which is not part of the crate."},
        )  # fmt: skip
    software = provenance.get("software", {})
    for name, version in software.items():
        entity = {"@type": "SoftwareApplication", "name": name, "softwareVersion": version}
        # Another version may have noted what this one does not.
        yield f"#{name}", entity | ({"url": _ADDRESSES[name]} if name in _ADDRESSES else {})
    yield (
        "#branchcrush",
        {
            "@type": "SoftwareApplication",
            "name": "branchcrush",
            "softwareVersion": provenance["branchcrush"],
            "softwareRequirements": [{"@id": f"#{name}"} for name in software],
        },
    )
    for name, value in provenance.get("machine", {}).items():
        yield f"#machine/{name}", {"@type": "PropertyValue", "name": name, "value": value}


def _linked(names):
    """Return links to entities; of one alone no list, as the standard has it."""
    links = [{"@id": name} for name in names]
    return links if len(links) > 1 else links[0]


def _data(path):
    """Return the name of a user's file, which may hold blanks."""
    return f"#data/{quote(path)}"


def _left(record):
    """Yield place below the results and digest of what a job left."""
    for path, digest in left_by(record):
        yield below_results(path, record["wildcards"])[1], digest
