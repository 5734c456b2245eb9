"""The loading path: a row for each saved state of a compression."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from branchcrush.loading.measures import (
    cell_measures,
    coordination_measures,
    energy_measures,
    overlap_measures,
    rest_measures,
    stress_measures,
)
from branchcrush.loading.states import Columns, force_floor, law_error
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.packings.geometry import solid_volume


def path_row(
    scalars: Mapping[str, Any],
    particles: Columns,
    contacts: Columns,
    walls: Columns,
    *,
    first_edge: float,
    law: LinearContact | HertzContact,
    periodic: bool,
) -> dict[str, Any]:
    """Return the row of `path.csv` of a state.

    Parameters
    ----------
    scalars : mapping
        The state's line of `states.csv` as in.compress writes it.
    particles : mapping of columns
        Its frame of the particle dump, sorted by id.
    contacts, walls : mapping of columns
        From `states.state_contacts` and `states.wall_contacts`.
    first_edge : float
        Edge of the cell before loading [m].
    law : LinearContact or HertzContact
    periodic : bool
        Then the stress of the boundary is what LAMMPS sums over its pairs.

    Returns
    -------
    dict
        The state, all that `loading.measures` has of it, `contact_law_error`, and what the run
        counted. Names carry their units; strains and stress are positive in compression.
    """
    edge = float(scalars["edge"])
    radii = np.asarray(particles["radius"])
    net_force = np.column_stack([particles[f"f{axis}"] for axis in "xyz"])
    stresses = stress_measures(
        contacts, walls, radii, edge, float(scalars["pair_pressure"]) if periodic else None
    )
    return {
        "state": int(scalars["state"]),
        **cell_measures(edge, first_edge, solid_volume(radii)),
        **stresses,
        **energy_measures(contacts, walls, radii, law, float(scalars["work"])),
        **coordination_measures(contacts, walls, radii.size),
        **rest_measures(
            contacts["normal_force_N"],
            net_force,
            force_floor=force_floor(radii, law),
            kinetic_energy=float(scalars["kinetic_energy"]),
            solid_volume=solid_volume(radii),
            stress=stresses["mean_stress_Pa"],
        ),
        **overlap_measures(contacts),
        "contact_law_error": law_error(contacts, walls, radii, law),
        "escaped": int(scalars["escaped"]),
        "lost": int(scalars["lost"]),
        "force_evaluations": int(scalars["evaluations"]),
    }
