"""Packings, their compression, and a reader of dumps that owes nothing to the package."""

import gzip
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
import pytest

from branchcrush.lammps.compression import compress
from branchcrush.lammps.crush import crush
from branchcrush.loading.states import force_floor
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing
from tests.physics.crushings import loose, rules, variables

STIFFNESS = {"linear": 1.0e6, "hertz": 1.0e9}
LAWS = {"linear": LinearContact, "hertz": HertzContact}


class Compression(NamedTuple):
    """What `compress` returned, and what it was asked."""

    path: pd.DataFrame
    contacts: pd.DataFrame
    walls: pd.DataFrame
    steps: pd.DataFrame
    compressed: pd.DataFrame
    variables: dict
    folder: Path

    def at(self, table, state):
        """Return the rows of one state of `contacts` or `walls`; -1 is the last state."""
        table = getattr(self, table)
        state = self.path["state"].iloc[state]
        return table[table["state"] == state].reset_index(drop=True)


class Frame(NamedTuple):
    """One frame of a dump: lower and upper faces of the cell, and the columns by name."""

    bounds: np.ndarray
    columns: dict

    def vectors(self, *names):
        return np.column_stack([self.columns[name] for name in names])


@pytest.fixture(scope="session")
def random_grains():
    """Return a function that places grains of radius 0.2 to 1 mm: positions, radii, edge."""

    def place(grains, seed, *, periodic):
        rng = np.random.default_rng(seed)
        radii = np.sort(rng.uniform(0.2e-3, 1e-3, grains))[::-1]
        edge = cube_edge(radii, 0.16)
        return random_packing(radii, edge, periodic=periodic, rng=rng), radii, edge

    return place


@pytest.fixture(scope="session")
def compressed(lammps_inputs):
    """Return a function that compresses a packing; any variable of in.compress may be given."""

    def run(packing, folder, *, inputs=lammps_inputs, **variables):
        positions, radii, edge = packing
        law = variables.get("law", "linear")
        stiffness = variables.get("stiffness", STIFFNESS[law])
        largest = float(np.max(radii))
        variables = {
            "boundary": "walls",
            "control": "edge",
            "law": law,
            "stiffness": stiffness,
            "state_tolerance": 1e-7,
            "force_floor": force_floor(radii, LAWS[law](stiffness)),
            "largest_radius": largest,
            "skin": 0.1 * largest,
            **variables,
        }
        tables = compress(
            np.asarray(positions, dtype=float),
            np.asarray(radii, dtype=float),
            edge,
            variables,
            inputs=inputs,
            folder=folder,
            log=folder.with_suffix(".log"),
        )
        return Compression(*map(pd.DataFrame, tables), variables, folder)

    return run


@pytest.fixture(scope="session")
def even_edges():
    """Return a function that gives the variables of equal steps from one edge to another."""

    def variables(first, last, *, steps, states, unloading=False):
        edges = [first + (last - first) * k / states for k in range(states + 1)]
        # Where the cell is smallest, equal steps strain it most.
        strain = np.log(edges[-2] / edges[-1]) * states / steps
        back = edges[-2::-1] if unloading else []
        targets = [float(edge) for edge in edges[1:] + back]
        return {"approach_edge": first, "targets": targets, "strain_step": float(strain)}

    return variables


@pytest.fixture(scope="session")
def frames():
    """Return a function that reads the frames of a dump, plain or gzipped, line by line."""

    def read(path):
        with (gzip.open if path.suffix == ".gz" else open)(path, "rt") as file:
            lines = iter(file.read().splitlines())
        found = []
        for line in lines:
            assert line == "ITEM: TIMESTEP"
            next(lines)
            assert next(lines).startswith("ITEM: NUMBER OF ")
            rows = int(next(lines))
            assert next(lines).startswith("ITEM: BOX BOUNDS ")
            bounds = np.array([next(lines).split() for _ in range(3)], dtype=float)
            names = next(lines).split()[2:]
            values = [next(lines).split() for _ in range(rows)]
            columns = np.array(values, dtype=float).reshape(rows, len(names)).T
            found.append(Frame(bounds, dict(zip(names, columns, strict=True))))
        return found

    return read


@pytest.fixture(scope="session")
def crushed(tmp_path_factory, lammps_inputs):
    """Return a function that crushes a packing in a folder of its own."""

    def run(packing, given, how, **others):
        folder = tmp_path_factory.mktemp("crushing")
        chosen = {"seed": 1, "keep_dumps": "none", **others}
        return crush(
            *packing, given, how, inputs=lammps_inputs, folder=folder, log=folder / "log", **chosen
        )

    return run


@pytest.fixture(scope="session")
def usual(crushed):
    """Return one crushing that many tests read."""
    packing = loose()
    return crushed(packing, variables(packing), rules())
