"""What a run of `lammps_inputs/in.compress` leaves, made into tables state by state."""

from collections.abc import Mapping
from contextlib import contextmanager
from functools import partial
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from pyarrow import csv

from branchcrush.errors import SimulationError
from branchcrush.lammps.files import read_dump
from branchcrush.loading.path import path_row
from branchcrush.loading.states import state_contacts, wall_contacts
from branchcrush.packings.contact_laws import CONTACT_LAWS
from branchcrush.packings.geometry import cube

DUMPS = ("particles.dump", "pairs.dump")


class Compression(NamedTuple):
    """What a compression leaves: a table for each kind of thing, as a dict of columns."""

    path: dict  # a row for each state, as `loading.path.path_row`
    contacts: dict  # a row for each contact and state, as `loading.states.state_contacts`
    walls: dict  # the same with walls, as `loading.states.wall_contacts`
    steps: dict  # a row for each strain step
    compressed: dict  # a row for each grain at the end of the loading, before any unloading


def read_compression(
    folder: str | PathLike[str], variables: Mapping[str, Any], stopped: str
) -> Compression:
    """Return the loading path and the contacts of a run; one state's dump is held at a time.

    Parameters
    ----------
    folder : path-like
        Holds states.csv, steps.csv and the `DUMPS`.
    variables : dict
        Those of the run, as `lammps.compression.compression_variables`.
    stopped : str
        Why it stopped before its end; empty where it did not.

    Returns
    -------
    Compression

    Raises
    ------
    SimulationError
        When no state was saved, a contact is listed twice, or a file is not whole: a dump without
        a frame for each state, or one that breaks off.
    """
    folder = Path(folder)
    with _whole():
        scalars, steps = (_columns(folder / f"{name}.csv") for name in ("states", "steps"))
    lines = [dict(zip(scalars, line, strict=True)) for line in zip(*scalars.values(), strict=True)]
    if not lines:
        raise SimulationError(stopped or "LAMMPS saved no state: is the disk full?")
    frames = [_frames(folder / name) for name in DUMPS]
    compressed = {}
    state = partial(
        _state, variables=variables, first_edge=scalars["edge"][0], compressed=compressed
    )
    # Unlike a loop over zip, map lets go of a frame before it reads the next one.
    found = list(map(state, lines, *frames))
    if len(found) < len(lines) or any(next(frame, None) is not None for frame in frames):
        raise SimulationError(
            f"LAMMPS saved {len(lines)} states, and other numbers of frames in {DUMPS}: "
            "is the disk full?"
        )
    path, contacts, walls = zip(*found, strict=True)
    path[-1]["stopped"] = stopped
    path = {name: np.array([row[name] for row in path]) for name in path[0]}
    # Work is counted from the end of the approach, the second state: what it holds was put in.
    held = path["elastic_energy_J"][1:2].sum()
    steps["work"] = steps["work"] + held
    for name in ("work_J", "dissipated_J"):
        path[name][1:] += held
    return Compression(
        path,
        _table(path["state"], contacts),
        _table(path["state"], walls),
        _steps(steps, path["solid_fraction"][0] * path["volume_m3"][0]),
        compressed,
    )


@contextmanager
def _whole():
    """Refuse files that break off: LAMMPS does not look whether what it prints is written."""
    try:
        yield
    except (ValueError, IndexError) as error:
        raise SimulationError(
            f"what LAMMPS saved is not whole ({str(error).partition(chr(10))[0]}): is the disk "
            "full? free some space, then repeat the command"
        ) from error


def _frames(path):
    """Yield the frames of a dump."""
    with _whole():
        yield from read_dump(path)


def _columns(path):
    """Return the columns of a file that LAMMPS printed, line by line."""
    # Arrow's own `to_numpy` would import pandas, which takes half a second.
    options = csv.ReadOptions(use_threads=False), None, csv.ConvertOptions(null_values=[])
    columns = csv.read_csv(path, *options).to_pydict()
    return {name: np.array(column) for name, column in columns.items()}


def _state(line, particles, pairs, *, variables, first_edge, compressed):
    """Return the row of the path, the contacts and the wall contacts of a state.

    The grains of a state of the loading take the place of those of an earlier one.
    """
    law = CONTACT_LAWS[variables["law"]].kind(variables["stiffness"])
    touching = state_contacts(_by_row(pairs, particles["id"]), particles["radius"], law)
    at_wall = wall_contacts(particles, line["edge"])
    row = path_row(
        line,
        particles,
        touching,
        at_wall,
        first_edge=first_edge,
        law=law,
        periodic=variables["boundary"] == "periodic",
    )
    leg = _leg(row["state"], variables)
    if leg == "loading":
        # Copies: a view would keep the whole frame.
        grains = {f"{name}_m": particles[name].copy() for name in ("x", "y", "z", "radius")}
        compressed.update(grains)
    return {**row, "leg": leg, "stopped": ""}, touching, at_wall


def _by_row(pairs, ids):
    """Return pairs with grains counted by their rows, from 1: where some broke, ids leave gaps."""
    if ids[-1] == len(ids):
        return pairs
    return {**pairs, **{name: np.searchsorted(ids, pairs[name]) + 1 for name in ("id1", "id2")}}


def _leg(state, variables):
    """Return whether a state is on the way to the furthest target, or on the way back."""
    # Targets that go back unload. Two states come before the first target.
    targets = np.asarray(variables["targets"]) * (-1 if variables["control"] == "edge" else 1)
    return "loading" if state - 2 <= int(np.argmax(targets)) else "unloading"


def _table(states, parts):
    """Return one table of the columns of each state, and empty the parts on the way."""
    columns = {"state": np.repeat(states, [len(part["i"]) for part in parts])}
    for name in list(parts[0]):
        # Taken away, so that one column at most is in memory twice.
        columns[name] = np.concatenate([part.pop(name) for part in parts])
    return columns


def _steps(steps, solid_volume):
    """Return the strain steps with units in the names."""
    volume = cube(steps["edge"])
    return {
        "step": steps["step"],
        "solid_fraction": solid_volume / volume,
        "volume_m3": volume,
        "mean_stress_Pa": steps["mean_stress"],
        "work_J": steps["work"],
        "unbalanced_force_ratio": steps["unbalanced"],
        "contacts": steps["contacts"],
        "force_evaluations": steps["evaluations"],
    }
