"""Which column of a file is what: grains and contacts of any names made into those of one kind."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from branchcrush.errors import ReadingError
from branchcrush.packings.sizes import size_problem
from branchcrush.readers.frames import ColumnFrame
from branchcrush.readers.limits import FURTHEST, LARGEST_ID, LARGEST_NUMBER
from branchcrush.readers.texts import listed
from branchcrush.words import few

# How many columns make each, and what each is in the words of an error.
CONTACT_ROLES = {
    "id1": 1,
    "id2": 1,
    "start": 3,
    "end": 3,
    "branch": 3,
    "force": 3,
    "normal_force": 1,
    "overlap": 1,
    "gap": 1,
    "point": 3,
    "real": 1,
}
GRAIN_ROLES = {"id": 1, "position": 3, "radius": 1, "diameter": 1}
Roles = Mapping[str, str | Sequence[str]]


@dataclass(frozen=True, eq=False)
class Grains:
    """Grains of one moment, sorted by their ids."""

    ids: NDArray  # shape (N,); from 1 where the file has none
    positions: NDArray  # shape (N, 3) [m]
    radii: NDArray  # shape (N,) [m]


def names_of(roles: Roles) -> list[str]:
    """Return the names of all columns that roles take, each once.

    Parameters
    ----------
    roles : mapping
        A name, or three of a vector, by role.

    Returns
    -------
    list of str

    Examples
    --------
    >>> names_of({"id1": "end1", "force": ["fx", "fy", "fz"]})
    ['end1', 'fx', 'fy', 'fz']
    """
    listed = ([each] if isinstance(each, str) else list(each) for each in roles.values())
    return list(dict.fromkeys(name for names in listed for name in names))


def in_roles(frame: ColumnFrame, roles: Roles) -> dict[str, NDArray]:
    """Return the columns of a frame by what they are.

    Parameters
    ----------
    frame : ColumnFrame
    roles : mapping
        The name of a column, or of three, by role.

    Returns
    -------
    dict of ndarray
        Of shape (n,), or (n, 3) of a vector.

    Raises
    ------
    ReadingError
        When the frame has no such column, or numbers that no grain or contact has.

    Examples
    --------
    >>> frame = ColumnFrame("x.csv", {"a": np.array([1.0]), "b": np.array([2.0])})
    >>> in_roles(frame, {"force": ["a", "b", "a"]})["force"].tolist()
    [[1.0, 2.0, 1.0]]
    """
    missing = [name for name in names_of(roles) if name not in frame.columns]
    if missing:
        raise ReadingError(
            f"{frame.where}: it has no column {listed(missing)}; it has "
            f"{listed(frame.columns)}: name the columns as they stand there"
        )
    problems = []
    for role, name in roles.items():
        most = LARGEST_ID if role.startswith("id") else LARGEST_NUMBER
        for part in [name] if isinstance(name, str) else name:
            largest = float(np.abs(frame.columns[part]).max(initial=0.0))
            if not largest <= most:
                problems.append(f"{frame.where}: column {part} holds {largest:.3g}, which is none")
    if problems:
        raise ReadingError("\n".join(f"{each}; write it again" for each in problems))
    return {
        role: frame.columns[name]
        if isinstance(name, str)
        else np.column_stack([frame.columns[part] for part in name])
        for role, name in roles.items()
    }


def grains_of(frame: ColumnFrame, roles: Roles, length: float) -> Grains:
    """Return the grains of a frame, sorted by id.

    Parameters
    ----------
    frame : ColumnFrame
    roles : mapping
        id, position and radius or diameter; without id grains count from 1.
    length : float
        Unit of the file's lengths [m].

    Returns
    -------
    Grains

    Raises
    ------
    ReadingError
        When an id stands twice or is no whole number, or a radius is not above 0; all at once.

    Examples
    --------
    >>> columns = {"id": [2, 1], "x": [0, 1], "y": [0, 1], "z": [0, 1], "d": [4, 2]}
    >>> arrays = {name: np.array(each, float) for name, each in columns.items()}
    >>> frame = ColumnFrame("x.csv", arrays)
    >>> grains = grains_of(
    ...     frame, {"id": "id", "position": ["x", "y", "z"], "diameter": "d"}, 0.5)
    >>> grains.ids.tolist(), grains.radii.tolist()
    ([1, 2], [0.5, 1.0])
    """
    columns, problems = in_roles(frame, roles), []
    ids = columns.get("id", np.arange(1, frame.rows + 1))
    radii = columns["radius"] if "radius" in columns else columns["diameter"] / 2.0
    if frame.rows < 2:
        problems.append(f"it has {frame.rows} grains, and two are the fewest that touch")
    if np.any(ids != np.floor(ids)):
        problems.append("an id of a grain is no whole number")
    found, times = np.unique(ids, return_counts=True)
    if np.any(times > 1):
        problems.append(f"these ids of grains stand more than once: {some(found[times > 1])}")
    if np.any(radii <= 0):
        problems.append(f"the radius is not above 0 of the grains {some(ids[radii <= 0])}")
    elif radii.size:
        diameters = 2.0 * radii * length
        if problem := size_problem(diameters.min(), diameters.max()):
            problems.append(f"{problem}: is the unit of length right?")
    if np.any(np.abs(columns["position"]) * length > FURTHEST):
        problems.append(f"a grain is more than {FURTHEST:g} m from the origin: is the unit right?")
    if problems:
        raise ReadingError("\n".join(f"{frame.where}: {problem}" for problem in problems))
    order = np.argsort(ids, kind="stable")
    return Grains(
        ids[order].astype(int), columns["position"][order] * length, radii[order] * length
    )


def some(numbers: Sequence[float] | NDArray) -> str:
    """Return the first of some whole numbers in words, and how many more there are.

    Parameters
    ----------
    numbers : sequence of float

    Returns
    -------
    str

    Examples
    --------
    >>> some([1, 2, 3, 4, 5, 6, 7])
    '1, 2, 3, 4, 5 and 2 more'
    """
    return few((f"{number:.0f}" for number in numbers), most=5)
