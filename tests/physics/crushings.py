"""Small packings whose grains break, and what tests of them ask."""

from contextlib import contextmanager

import numpy as np
import pytest

from branchcrush.breakage.rules import Breakage
from branchcrush.breakage.strength import Strength
from branchcrush.lammps import checkpoint
from branchcrush.lammps.checkpoint import Checkpoint
from branchcrush.lammps.compression import Packing, compression_variables
from branchcrush.loading.targets import Loading
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing

LINEAR, GLASS = LinearContact(1e6), HertzContact.of_material(70e9, 0.17)
LIMIT = 2.5e-4


def loose(grains=60, *, periodic=True):
    """Return a loose packing of grains of 0.8 to 1.2 mm."""
    rng = np.random.default_rng(1)
    radii = rng.uniform(0.4e-3, 0.6e-3, grains)
    edge = cube_edge(radii, 0.2)
    return Packing(random_packing(radii, edge, periodic=periodic, rng=rng), radii, edge)


def variables(packing, *, solid_fraction=0.67, states=5, law=LINEAR, periodic=True, **others):
    loading = Loading(
        "solid_fraction",
        solid_fraction,
        states=states,
        approach_solid_fraction=others.pop("approach", 0.58),
        unloading=others.pop("unloading", False),
    )
    boundary = "periodic" if periodic else "walls"
    return {
        **compression_variables(
            packing.radii, 0.2, boundary=boundary, law=law, loading=loading, strain_step=2e-3,
            state_tolerance=1e-6,
        ),
        **others,
    }  # fmt: skip


def rules(strength=1e7, *, scale=1.0, modulus=3.0, **others):
    material = Strength(
        strength=strength, weibull_modulus=modulus, reference_diameter=1e-3, size_exponent=1.0
    )
    return Breakage(strength=material, **{"smallest_diameter": scale * LIMIT, **others})


def alike(one, other):
    """Return the columns in which two crushings differ."""
    return [
        f"{kind}.{name}"
        for kind, table in one._asdict().items()
        for name, column in table.items()
        if not np.array_equal(
            column, getattr(other, kind)[name], equal_nan=column.dtype.kind == "f"
        )
    ]


def stored_in(path):
    """Return what the account of a path leaves open, over the work."""
    taken = path["dissipated_breakage_J"] + path["dissipated_rearrangement_J"]
    return np.abs(path["work_J"] - path["elastic_energy_J"] - taken)[2:] / path["work_J"][2:]


class Killed(Exception):
    """A run dies here."""


@contextmanager
def killed_after(targets):
    """Let a run die when it has kept the state of so many targets."""
    note = Checkpoint.note

    def note_and_die(self, session, reached, *others):
        note(self, session, reached, *others)
        if reached == targets:
            # What is written on after a state is cut off.
            with (self.folder / "states.csv").open("a") as file:
                file.write("9,9")
            raise Killed

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Checkpoint, "note", note_and_die)
        patch.setattr(checkpoint, "LEAST_SECONDS", 0.0)
        with pytest.raises(Killed):
            yield
