"""The states that the page draws, out of the tables of a run."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from branchcrush.packings.cells import path_cells
from branchcrush.packings.geometry import sphere_volume
from branchcrush.packings.grains import grain_energy, grain_stress_volume
from branchcrush.packings.network import DIRECTION_COLUMNS, Table, state_networks, state_rows
from branchcrush.study.viewer import PAGE_BYTES, ViewerState, viewer_data

_COORDINATES = ("x_m", "y_m", "z_m")
# What the views of a page may hold together, and each at least.
_OF_ALL, _OF_EACH = PAGE_BYTES, 100_000


def packing_view(
    grains: Table,
    path: Table,
    contacts: Table,
    walls: Table,
    *,
    contact_exponent: float,
    periodic: bool,
    views: int = 1,
    loose: NDArray | None = None,
    reading: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Return the states of a packing, packed for a page that has some views of packings.

    Parameters
    ----------
    grains, path, contacts, walls, contact_exponent, loose, reading
        As for `viewer_states`.
    periodic : bool
        Whether the cell is in all directions, where no reading tells each.
    views : int
        On the page, which share what it may hold.

    Returns
    -------
    dict
        `view.json`: header and data of `viewer.viewer_data`.
    """
    states = viewer_states(
        grains,
        path,
        contacts,
        walls,
        contact_exponent=contact_exponent,
        loose=loose,
        reading=reading,
    )
    along = [periodic] * 3 if reading is None else reading["periodic"]
    limit = max(_OF_ALL // max(views, 1), _OF_EACH)
    saved = len(np.asarray(path["state"]))
    packed = viewer_data(states, periodic=along, limit_bytes=limit, saved_states=saved)
    return {"header": packed.header, "data": packed.data}


def saved_grains(
    frames: Iterable[Mapping[str, NDArray]],
    packing: tuple[NDArray, NDArray, float],
    compressed: Table,
    path: Table,
) -> dict[str, NDArray]:
    """Return a row for each grain in each state whose positions are kept.

    Parameters
    ----------
    frames : iterable of mapping of columns
        As for `dumped_grains`; none where no dump is kept.
    packing, compressed, path
        As for `compression_grains`, which every packing keeps.

    Returns
    -------
    dict of ndarray
        state, radius_m, x_m, y_m and z_m.

    Raises
    ------
    ValueError
        When there are more frames than states.

    Examples
    --------
    >>> path = {"state": np.array([0, 1]), "leg": np.array(["loading", "loading"])}
    >>> one = np.ones(1)
    >>> frame = {"x": one, "y": one, "z": one, "radius": one}
    >>> saved_grains([frame, frame], (np.zeros((1, 3)), one, 4.0), {}, path)["state"].tolist()
    [0, 1]
    """
    kept = list(frames)
    if kept:
        return dumped_grains(kept, path["state"])
    return compression_grains(packing, compressed, path)


def compression_grains(
    packing: tuple[NDArray, NDArray, float], compressed: Table, path: Table
) -> dict[str, NDArray]:
    """Return a row for each grain in the two states whose positions every packing keeps.

    Parameters
    ----------
    packing : tuple
        Positions, shape (N, 3), radii, shape (N,), and edge of `packing.npz` [m].
    compressed : DataFrame
        `compressed.parquet`, the end of the loading.
    path : DataFrame
        `path.csv`.

    Returns
    -------
    dict of ndarray
        state, radius_m, x_m, y_m and z_m; as `grains.parquet` of a packing whose grains break.

    Examples
    --------
    >>> one = np.ones(1)
    >>> end = {"x_m": 0 * one, "y_m": one, "z_m": one, "radius_m": one}
    >>> path = {"state": np.array([0, 1, 2]),
    ...         "leg": np.array(["loading", "loading", "unloading"])}
    >>> grains = compression_grains((np.zeros((1, 3)), one, 4.0), end, path)
    >>> grains["state"].tolist(), grains["y_m"].tolist()
    ([0, 1], [0.0, 1.0])
    """
    positions, radii, _ = packing
    loading = np.asarray(path["state"])[np.asarray(path["leg"]) == "loading"]
    if loading[-1] == 0:  # one frame of another code is both
        return {"state": np.zeros(len(radii), dtype=int)} | {
            name: np.asarray(compressed[name]) for name in ("radius_m", *_COORDINATES)
        }
    columns = dict(zip(_COORDINATES, np.asarray(positions).T, strict=True))
    columns = {**columns, "radius_m": np.asarray(radii)}
    sizes = [len(radii), len(compressed["radius_m"])]
    return {
        "state": np.repeat([0, int(loading[-1])], sizes),
        **{
            name: np.concatenate([column, np.asarray(compressed[name])])
            for name, column in columns.items()
        },
    }


def dumped_grains(
    frames: Iterable[Mapping[str, NDArray]], states: Iterable[int]
) -> dict[str, NDArray]:
    """Return a row for each grain in each state that LAMMPS dumped.

    Parameters
    ----------
    frames : iterable of mapping of columns
        x, y, z and radius of the grains by their numbers, a frame a state; of
        `particles.dump.gz`, by `lammps.files.read_dump`.
    states : iterable of int
        Numbers of the saved states; where fewer frames were kept they are those of the last.

    Returns
    -------
    dict of ndarray
        state, radius_m, x_m, y_m and z_m; as `compression_grains`.

    Raises
    ------
    ValueError
        When there is no frame, or there are more than states.

    Examples
    --------
    >>> one = np.ones(2)
    >>> grains = dumped_grains([{"x": one, "y": one, "z": one, "radius": one}], [0, 1, 2])
    >>> grains["state"].tolist()
    [2, 2]
    """
    kept, numbers = list(frames), [int(state) for state in states]
    if not 0 < len(kept) <= len(numbers):
        raise ValueError(f"the dump holds {len(kept)} frames of {len(numbers)} saved states")
    sizes = [len(frame["radius"]) for frame in kept]
    return {
        "state": np.repeat(numbers[-len(kept) :], sizes),
        **{
            f"{name}_m": np.concatenate([np.asarray(frame[name]) for frame in kept])
            for name in ("radius", "x", "y", "z")
        },
    }


def viewer_states(
    grains: Table,
    path: Table,
    contacts: Table,
    walls: Table,
    *,
    contact_exponent: float,
    loose: NDArray | None = None,
    reading: Mapping[str, Any] | None = None,
) -> list[ViewerState]:
    """Return the saved states of a packing whose positions are known, as the page draws them.

    Parameters
    ----------
    grains : mapping of columns, or DataFrame
        state, radius_m, x_m, y_m and z_m, state after state, and generation where grains break.
    path : mapping of columns, or DataFrame
        `path.csv`: a row for each saved state.
    contacts, walls : mapping of columns, or DataFrame
        `contacts.parquet` and `wall_contacts.parquet`; i and j count the rows of the state.
    contact_exponent : float
        m of F ~ overlap^m: 1 for linear contacts, 3/2 for Hertz.
    loose : ndarray, shape (N, 3), optional
        Positions of state 0, where `grains` does not have them [m].
    reading : mapping, optional
        `reading.json` of a packing that another code made: its cells, and frames for states.

    Returns
    -------
    list of ViewerState
        In the order of the path.
    """
    rows = {int(state): k for k, state in enumerate(np.asarray(path["state"]))}
    states = list(rows)
    parts = state_rows(grains["state"], states)
    held = state_rows(walls["state"], states)
    cells, labels = path_cells(path, reading), _labels(path, reading)
    directions = np.column_stack(
        [np.asarray(walls[name], dtype=float) for name in DIRECTION_COLUMNS]
    )
    drawn = []
    for state, part, at_wall in zip(states, parts, held, strict=True):
        places = np.column_stack([np.asarray(grains[name])[part] for name in _COORDINATES])
        if state == 0 and loose is not None:
            places = loose
        if not len(places) or not np.all(np.isfinite(places)):
            continue
        radius = np.asarray(grains["radius_m"])[part]
        network = next(state_networks(radius, contacts, walls, [state]))
        drawn.append(
            ViewerState(
                state=state,
                label=labels[rows[state]],
                cell=cells[rows[state]],
                solid_fraction=float(np.asarray(path["solid_fraction"])[rows[state]]),
                mean_stress=float(np.asarray(path["mean_stress_Pa"])[rows[state]]),
                positions=places,
                radius=radius,
                energy=grain_energy(network, contact_exponent),
                pressure=grain_stress_volume(network) / sphere_volume(radius),
                i=network.i,
                j=network.j,
                force=network.force,
                wall_grain=network.wall_grain,
                wall_direction=directions[at_wall],
                wall_force=network.wall_force,
                generation=np.asarray(grains["generation"])[part] if _breaks(grains) else None,
            )
        )
    return drawn


def _breaks(grains: Any) -> bool:
    return "generation" in grains


def _labels(path: Table, reading: Mapping[str, Any] | None) -> list[str]:
    """Return what each state is, in a word or two."""
    legs = [str(leg) for leg in np.asarray(path["leg"])]
    if reading is None:
        known = {0: "placed at random", 1: "end of the approach"}
    else:  # the first alone, where it is the densest as well
        known = {legs.count("loading") - 1: "densest frame", 0: "first frame"}
    return [known.get(row, leg) for row, leg in enumerate(legs)]
