"""The description of a study's results for programs: a Data Package, `datapackage.json`."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any

from branchcrush.files.dictionary import ResultFile, result_files

_PROFILE = "https://datapackage.org/profiles/2.0/datapackage.json"
# By the end of the name: Data Packages' format, media type, and whether it is a table.
_KINDS = {
    ".csv": ("csv", "text/csv", True),
    ".parquet": ("parquet", "application/vnd.apache.parquet", True),
    ".json": ("json", "application/json", False),
    ".html": ("html", "text/html", False),
    ".png": ("png", "image/png", False),
    ".svg": ("svg", "image/svg+xml", False),
    ".npz": ("npz", "application/x-npz", False),
    ".data": ("data", "text/plain", False),
}
# The first line of a table says what made it. Some readers count it, others know the sign.
_DIALECT = {"headerRows": [2], "commentRows": [1], "commentChar": "#"}
# What a study makes only when it is asked for, what it notes of its own work, the description
# itself, and LAMMPS's dumps.
_LEFT_OUT = (
    "preview",
    "<rule>",
    "<sample>/seed_<seed>/made.json",
    "<sample>/crushing/seed_<seed>/made.json",
    "datapackage.json",
)
_DUMP = ".dump.gz"
# Of the seeds that are run again there is no more.
_RUN_AGAIN = ("compression", "certificate", "crushing")
# Of samples whose grains break; the first of the seeds that are run again, too.
_OF_BREAKING = (
    "crushing",
    "crushing_results",
    "crushing_predicted",
    "crushing_figures",
    "crushed_grains",
    "crushed_grains_figures",
    "crushing_page",
)
# Of packings that another code made; and of those made here alone, what is not read.
_OF_READ = ("read_packing", "read_radii")
# What a study may lack without lacking anything.
OF_SOME_SAMPLES = _OF_BREAKING + _OF_READ
# Of samples beside each other; of one alone only where that is asked for.
_OF_SEVERAL = "findings_figures"
_OF_COMPRESSED = "<sample>/seed_<seed>/packing.data"
# Of materials that a laboratory measured; the second of those with a compression curve.
_OF_MATERIALS = ("measured", "measured_resistance", "measured_page")


def data_package(
    samples: Mapping[str, Sequence[int]],
    run_again: Mapping[str, Sequence[int]],
    measured: Mapping[str, bool] | None = None,
    breaking: Collection[str] = (),
    read: Collection[str] = (),
) -> dict[str, Any]:
    """Return the description of all files of a study, with every column's type, unit and meaning.

    LAMMPS's dumps are left out: which are there is up to `keep_dumps` and to who deletes them.

    Parameters
    ----------
    samples : mapping
        Seeds by name of the sample.
    run_again : mapping
        Seeds by name of what is run again with smaller strain steps; of these there are the
        packings and their certificates alone.
    measured : mapping, optional
        By name of a measured material whether it has a compression curve.
    breaking : collection of str
        Names of the samples whose grains break, and of what of them is run again.
    read : collection of str
        Names of the samples whose packings another code made.

    Returns
    -------
    dict
        By version 2 of the Data Package standard: `resources` with path and, of a table, a schema
        whose fields have name, type, unit and description; of other files such fields are under
        `keys`.

    Examples
    --------
    >>> package = data_package({"sand": [1, 2]}, {})
    >>> paths = [resource["path"] for resource in package["resources"]]
    >>> [path for path in paths if path.endswith("path.csv")][:2]
    ['sand/seed_1/path.csv', 'sand/seed_2/path.csv']

    References
    ----------
    https://datapackage.org/standard/data-package/
    """
    resources = []
    for file in result_files():
        if file.rule in _LEFT_OUT or file.path in _LEFT_OUT or file.path.endswith(_DUMP):
            continue
        if file.rule == _OF_SEVERAL and len(samples) < 2:
            continue
        if file.rule in _OF_MATERIALS:
            paths = _paths_of_materials(file, measured or {})
        else:
            everything = {**samples, **(run_again if file.rule in _RUN_AGAIN else {})}
            if file.rule in _OF_BREAKING:
                everything = {name: everything[name] for name in everything if name in breaking}
            if file.rule in _OF_READ:
                everything = {name: everything[name] for name in everything if name in read}
            if file.path == _OF_COMPRESSED:
                everything = {name: everything[name] for name in everything if name not in read}
            paths = _paths(file.path, everything)
        resources += [_resource(file, path) for path in paths]
    return {
        "$schema": _PROFILE,
        "name": "branchcrush-results",
        "title": "Results of a branchcrush study",
        "description": "Energy of branches and crushing of loaded grain assemblies. SI units.",
        "resources": resources,
    }


def _paths(path: str, samples: Mapping[str, Sequence[int]]) -> Iterator[str]:
    """Yield the files of one kind that a study has."""
    if "<sample>" not in path:
        yield from [path] if samples else []
        return
    for sample, seeds in samples.items():
        of_sample = path.replace("<sample>", sample)
        if "<seed>" in path:
            yield from (of_sample.replace("<seed>", str(seed)) for seed in seeds)
        else:
            yield of_sample


def _paths_of_materials(file: ResultFile, measured: Mapping[str, bool]) -> Iterator[str]:
    """Yield the files of one kind that a study with measured materials has."""
    if "<material>" not in file.path:
        yield from [file.path] if measured else []
        return
    for name, compressed in measured.items():
        if compressed or file.rule != "measured_resistance":
            yield file.path.replace("<material>", name)


def media_type(path: str) -> str:
    """Return the media type of a file of the results by the end of its name, "" if unknown.

    Parameters
    ----------
    path : str

    Returns
    -------
    str

    Examples
    --------
    >>> media_type("sand/path.csv"), media_type("sand/seed_1/pairs.dump.gz")
    ('text/csv', 'application/gzip')
    """
    if path.endswith(_DUMP):
        return "application/gzip"
    return next((kind[1] for ending, kind in _KINDS.items() if path.endswith(ending)), "")


def _resource(file: ResultFile, path: str) -> dict[str, Any]:
    form, media_type, is_table = next(
        kind for ending, kind in _KINDS.items() if path.endswith(ending)
    )
    resource: dict[str, Any] = {
        # Unique as the path is, so capitals stay.
        "name": path.replace("/", "."),
        "path": path,
        "description": file.holds,
        "format": form,
        "mediatype": media_type,
        "rule": file.rule,
    }
    fields = [
        {"name": name, "type": kind, **({"unit": unit} if unit else {}), "description": meaning}
        for name, kind, unit, meaning in file.columns()
    ]
    if is_table:
        resource["type"] = "table"
        if form == "csv":
            resource |= {"encoding": "utf-8", "dialect": _DIALECT}
        match = {"fieldsMatch": "superset"} if file.rare or file.partial else {}
        resource["schema"] = {"fields": fields, **match}
    elif fields:
        resource["keys"] = fields
    return resource
