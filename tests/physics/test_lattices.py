"""Equal spheres on cubic lattices in a periodic cell: every number is known in closed form.

Face-centred cubic is stable. Simple cubic is not, but neighbours share two coordinates bit for bit,
so that rounding gives it nothing to buckle from; body-centred cubic would buckle.
"""

import itertools
from typing import NamedTuple

import numpy as np
import pytest
from scipy.optimize import brentq

RADIUS = 1.0e-3
STRAIN = 0.03

# Lattice sites of a cell, edge of the cell of touching spheres, neighbours, cells along an edge.
LATTICES = {
    "simple cubic": ([[0, 0, 0]], 2.0 * RADIUS, 6, 3),
    "face-centred cubic": (
        [[0, 0, 0], [0, 1, 1], [1, 0, 1], [1, 1, 0]],
        2.0 * np.sqrt(2.0) * RADIUS,
        12,
        2,
    ),
}
# Stiffness, exponent, and what an overlap to that power is to be multiplied with: the reduced
# radius of two equal spheres is R/2.
LAWS = {"linear": (1.0e6, 1.0, 1.0e6), "hertz": (1.0e9, 1.5, 1.0e9 * np.sqrt(RADIUS / 2.0))}


class Lattice(NamedTuple):
    """A lattice under a law, and what it is at an edge of the cell or a linear strain."""

    name: str
    law: str

    @property
    def edge(self):
        _, cell, _, cells = LATTICES[self.name]
        return cells * cell

    @property
    def contacts(self):
        sites, _, neighbours, cells = LATTICES[self.name]
        return len(sites) * cells**3 * neighbours / 2

    def places(self):
        sites, _, _, cells = LATTICES[self.name]
        corners = np.stack(np.meshgrid(*[np.arange(cells)] * 3), axis=-1).reshape(-1, 1, 3)
        # A quarter of a cell away from the faces, so that no site lies on one.
        return (corners + np.array(sites) / 2.0 + 0.25).reshape(-1, 3) / cells - 0.5

    def force(self, strain):
        _, exponent, factor = LAWS[self.law]
        return factor * (2.0 * RADIUS * strain) ** exponent

    def stress(self, strain):
        volume, branch = (self.edge * (1 - strain)) ** 3, 2 * RADIUS * (1 - strain)
        return self.contacts * self.force(strain) * branch / (3.0 * volume)

    def energy(self, strain):
        exponent = LAWS[self.law][1]
        return self.contacts * self.force(strain) * 2.0 * RADIUS * strain / (exponent + 1.0)


@pytest.fixture(scope="module")
def pressed(compressed, tmp_path_factory):
    """Return a function that compresses a lattice from an edge 2 % too large."""

    def run(lattice, **variables):
        places, edge = lattice.places(), 1.02 * lattice.edge
        return compressed(
            (places * edge, [RADIUS] * len(places), edge),
            tmp_path_factory.mktemp("lattice") / "run",
            boundary="periodic",
            law=lattice.law,
            stiffness=LAWS[lattice.law][0],
            # Where they just touch, what rounding leaves of a force moves them for ages.
            largest_relaxation=5000,
            **{"approach_edge": lattice.edge, **variables},
        )

    return run


@pytest.fixture(scope="module", params=itertools.product(LATTICES, LAWS), ids="-".join)
def lattice(request, pressed, even_edges):
    """Return the loading and unloading of a lattice: 30 steps there and 20 back."""
    lattice = Lattice(*request.param)
    edge = lattice.edge
    loading = even_edges(edge, edge * (1 - STRAIN), steps=30, states=3, unloading=True)
    # Not to where the spheres just touch, and rounding has its way.
    loading["targets"].pop()
    return pressed(lattice, **loading), lattice


# Strain of the states after the approach, and where the largest is.
STRAINS = STRAIN * np.array([0, 1, 2, 3, 2, 1]) / 3
DENSEST = 4


def test_every_grain_has_the_neighbours_of_its_lattice(lattice):
    run, known = lattice
    neighbours, grains = LATTICES[known.name][2], len(known.places())
    contacts = run.at("contacts", DENSEST)
    number = np.bincount(np.r_[contacts["i"], contacts["j"]], minlength=grains)
    assert number.tolist() == [neighbours] * grains
    assert run.path["coordination_number"].iloc[DENSEST] == neighbours


def test_every_force_is_that_of_the_affine_overlap(lattice):
    run, known = lattice
    for state, strain in enumerate(STRAINS, start=1):
        contacts = run.at("contacts", state)
        if strain:
            # 1e-11: the overlap is 1 to 3 % of a diameter and known to rounding of the positions.
            np.testing.assert_allclose(contacts["overlap_m"], 2 * RADIUS * strain, rtol=1e-11)
            np.testing.assert_allclose(contacts["normal_force_N"], known.force(strain), rtol=2e-11)


def test_stress_is_that_of_the_lattice(lattice):
    run, known = lattice
    path = run.path.iloc[1:]
    atol = 1e-10 * known.stress(STRAIN)
    for name in ("mean_stress_Pa", "boundary_stress_Pa"):
        np.testing.assert_allclose(path[name], known.stress(STRAINS), rtol=1e-12, atol=atol)
    last = run.path.iloc[DENSEST]
    np.testing.assert_allclose(last["mean_stress_Pa"], known.stress(STRAIN), rtol=1e-12)
    np.testing.assert_allclose(last["boundary_stress_Pa"], known.stress(STRAIN), rtol=1e-12)


def test_energy_is_that_of_the_overlaps_and_comes_back(lattice):
    run, known = lattice
    largest = known.energy(STRAIN)
    energy = run.path["elastic_energy_J"].iloc[1:]
    np.testing.assert_allclose(energy, known.energy(STRAINS), rtol=1e-11, atol=1e-14 * largest)
    loading, unloading = run.path.iloc[2 : DENSEST + 1], run.path.iloc[DENSEST:]
    for name in ("elastic_energy_J", "work_J", "mean_stress_Pa", "volume_m3"):
        np.testing.assert_allclose(
            loading[name], unloading[name][::-1], rtol=1e-11, atol=1e-12 * loading[name].max()
        )


# In the first of ten steps to a state the contacts close: there Simpson's rule takes 0.4024 for
# the 2/5 of a Hertz contact, in the part 30^(-5/2) of the energy.
WORK_ERROR = {"linear": 1e-12, "hertz": 0.006 * 30**-2.5}


def test_energy_is_the_work(lattice):
    run, known = lattice
    error = 1.1 * WORK_ERROR[known.law] * known.energy(STRAIN)
    path = run.path.iloc[1:]
    np.testing.assert_allclose(path["work_J"], known.energy(STRAINS), rtol=0, atol=error)


@pytest.mark.parametrize("name", LATTICES)
def test_work_of_closed_hertz_contacts_is_their_energy_to_high_accuracy(pressed, even_edges, name):
    lattice = Lattice(name, "hertz")
    ends = lattice.edge * (1 - STRAIN / 3), lattice.edge * (1 - STRAIN)
    path = pressed(lattice, **even_edges(*ends, steps=20, states=2)).path.iloc[1:]
    # The work of the approach to the first edge is taken for what is stored there.
    energy = lattice.energy(STRAINS[1:4])
    np.testing.assert_allclose(path["elastic_energy_J"], energy, rtol=1e-11)
    np.testing.assert_allclose(path["work_J"], energy, rtol=1e-8)


def test_nothing_is_dissipated_where_affine_motion_keeps_balance(lattice):
    run, known = lattice
    error = 1.1 * WORK_ERROR[known.law] * run.path["work_J"].max()
    assert (run.path["dissipated_J"].abs() <= error).all()


def test_the_way_back_is_told_from_the_way_there(lattice):
    legs = lattice[0].path["leg"].tolist()
    assert legs == ["loading"] * (DENSEST + 1) + ["unloading"] * 2


def test_solid_fraction_is_that_of_the_lattice(lattice):
    run, known = lattice
    volume = (known.edge * (1 - STRAINS)) ** 3
    solid_fraction = len(known.places()) * 4 / 3 * np.pi * RADIUS**3 / volume
    np.testing.assert_allclose(run.path["solid_fraction"].iloc[1:], solid_fraction, rtol=1e-14)


@pytest.mark.parametrize("name", LATTICES)
def test_a_step_in_which_contacts_close_has_the_error_of_simpsons_rule(pressed, name):
    # From a strain of -e to e in one step: push is 0, 0 and F, so that the work is a sixth of F
    # times the change of branch length, 2/3 of the energy F times overlap over 2.
    lattice, strain = Lattice(name, "linear"), 1e-4
    run = pressed(
        lattice,
        approach_edge=lattice.edge * (1 + strain),
        targets=[lattice.edge * (1 - strain)],
        strain_step=1.0,
    )
    last = run.path.iloc[-1]
    np.testing.assert_allclose(last["elastic_energy_J"], lattice.energy(strain), rtol=1e-9)
    np.testing.assert_allclose(last["work_J"], 2 / 3 * lattice.energy(strain), rtol=1e-9)


@pytest.mark.parametrize("name", LATTICES)
@pytest.mark.parametrize("law", LAWS)
def test_a_stress_is_reached_at_the_edge_where_the_lattice_has_it(pressed, name, law):
    lattice = Lattice(name, law)
    strains = np.geomspace(1e-4, 0.05, 4)
    targets = [float(stress) for stress in lattice.stress(strains)]
    run = pressed(lattice, control="stress", targets=targets + targets[-2::-1], strain_step=5e-3)
    path = run.path.iloc[2:]
    wanted = np.array(targets + targets[-2::-1])
    assert path["stopped"].tolist() == [""] * 7
    np.testing.assert_allclose(path["mean_stress_Pa"], wanted, rtol=5e-3)
    edge = np.cbrt(path["volume_m3"])
    for found, stress, measured in zip(edge, wanted, path["mean_stress_Pa"], strict=True):
        exactly = brentq(lambda e, p: lattice.stress(e) - p, 0.0, 0.1, args=(stress,), xtol=1e-14)
        strain = 1 - found / lattice.edge
        # Stress grows at least as fast as strain: half a percent of it is at most that of strain.
        np.testing.assert_allclose(strain, exactly, rtol=5.1e-3)
        np.testing.assert_allclose(measured, lattice.stress(strain), rtol=1e-9)
    # Contacts close within the first step.
    assert (path["dissipated_J"].abs() <= 1e-3 * path["work_J"].max()).all()
