"""Where a packing is read from, and what reads the files of each code."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Literal, TypeAlias

from branchcrush.errors import ReadingError
from branchcrush.readers.dumps import read_dump
from branchcrush.readers.frames import ColumnFrame
from branchcrush.readers.liggghts import DEFAULT, named_columns
from branchcrush.readers.mercury import read_data, read_fstat
from branchcrush.readers.roles import Roles, names_of
from branchcrush.readers.tables import read_columns, read_yade_text
from branchcrush.readers.texts import listed
from branchcrush.readers.vtk import read_vtk

Reader: TypeAlias = Callable[[str | PathLike[str]], list[ColumnFrame]]
FORMATS = ("lammps", "liggghts", "yade", "mercurydpm", "columns")
_XYZ = {"position": ("x", "y", "z")}
GRAINS: Roles = {"id": "id", **_XYZ, "radius": "radius"}
# What each code calls the columns of its contacts, where it names them itself.
CONTACTS: Mapping[str, Roles] = {
    "mercurydpm": {
        name: name for name in ("id1", "id2", "point", "overlap", "normal_force", "force")
    },
    "yade": {"id1": "id1", "id2": "id2", "normal_force": "fn"},
    "columns": {"id1": "id1", "id2": "id2", "force": ("fx", "fy", "fz")},
}


@dataclass(frozen=True, kw_only=True)
class Source:
    """Where the grains and contacts of one packing are, and how its files are to be read."""

    format: str  # one of `FORMATS`
    grains: Sequence[str | PathLike[str]]  # files, in the order of their frames
    contacts: Sequence[str | PathLike[str]]
    periodic: bool  # whether the cell repeats where its file does not tell
    columns: Roles | None = None  # of contacts; None for those of the format
    grain_columns: Roles | None = None
    keywords: Sequence[str] = DEFAULT  # of LIGGGHTS's compute
    each_pair: str = "once"
    wall_ids: tuple[int, ...] = ()
    low: Sequence[float] | None = None  # corners of the cell, where the file has none
    high: Sequence[float] | None = None
    match: Literal["steps", "order"] = "steps"  # what brings grains and contacts together
    last: bool = False  # whether only the last frame is wanted
    length: float = 1.0  # unit of lengths [m]
    force: float = 1.0  # unit of forces [N]


def grain_reader(source: Source) -> Reader:
    """Return what reads the frames of a file of grains.

    Parameters
    ----------
    source : Source

    Returns
    -------
    callable
        Takes the path of a file.
    """
    names = names_of(source.grain_columns or GRAINS)
    return {
        "lammps": read_dump,
        "liggghts": read_dump,
        "yade": lambda file: [read_vtk(file) if _is_vtk(file) else read_yade_text(file)],
        "mercurydpm": read_data,
        "columns": lambda file: [read_columns(file, names)],
    }[source.format]


def contact_reader(source: Source) -> Reader:
    """Return what reads the frames of a file of contacts.

    Parameters
    ----------
    source : Source

    Returns
    -------
    callable
        Takes the path of a file.
    """
    names = names_of(source.columns or CONTACTS.get(source.format, {}))
    return {
        "lammps": read_dump,
        "liggghts": lambda file: [
            named_columns(frame, source.keywords) for frame in read_dump(file)
        ],
        "yade": lambda file: [read_vtk(file) if _is_vtk(file) else read_columns(file, names)],
        "mercurydpm": read_fstat,
        "columns": lambda file: [read_columns(file, names)],
    }[source.format]


def _is_vtk(file):
    return ".vtk" in Path(file).suffixes


def grain_roles(frame: ColumnFrame, source: Source) -> Roles:
    """Return which columns of the grains are what; LAMMPS has radius or diameter.

    Parameters
    ----------
    frame : ColumnFrame
    source : Source

    Returns
    -------
    mapping
        As `roles.grains_of` takes it.
    """
    if source.grain_columns:
        return source.grain_columns
    roles = dict(GRAINS)
    if "radius" not in frame.columns and "diameter" in frame.columns:
        del roles["radius"]
        roles["diameter"] = "diameter"
    if source.format == "yade" and "id" not in frame.columns:
        del roles["id"]
    return roles


def contact_roles(frame: ColumnFrame, source: Source) -> Roles:
    """Return which columns of the contacts are what.

    Parameters
    ----------
    frame : ColumnFrame
    source : Source

    Returns
    -------
    mapping
        As `roles.in_roles` takes it.

    Raises
    ------
    ReadingError
        When the format has no names of its own and none are given.
    """
    if source.columns:
        if {"start", "end"} <= set(frame.columns) and "id1" not in source.columns:
            return {"start": "start", "end": "end"} | dict(source.columns)
        return source.columns
    if source.format == "lammps":
        raise ReadingError(
            f"{frame.where}: packing.columns is needed, since the columns of a dump local are the "
            f"user's own; it has {listed(frame.columns)}"
        )
    if source.format == "liggghts":
        known = ("start", "end", "id1", "id2", "overlap", "point")
        roles = {name: name for name in known if name in frame.columns}
        force = next((k for k in ("force", "force_normal") if k in frame.columns), None)
        return roles | ({"force": force} if force else {})
    if {"start", "end"} <= set(frame.columns):  # of YADE's VTKExporter
        force = next((name for name in ("forceN", "fn") if name in frame.columns), "forceN")
        return {"start": "start", "end": "end", "normal_force": force}
    return CONTACTS[source.format]
