"""Equal spheres on cubic lattices in a periodic cell: every number is known in closed form.

Face-centred cubic is stable. Simple cubic is not, but neighbours share two coordinates bit for bit,
so that rounding gives it nothing to buckle from; body-centred cubic would buckle.
"""

import numpy as np
import pytest

STIFFNESS = 1.0e6
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


@pytest.fixture(scope="module", params=LATTICES)
def lattice(request, compressed, tmp_path_factory):
    sites, cell, neighbours, cells = LATTICES[request.param]
    corners = np.stack(np.meshgrid(*[np.arange(cells)] * 3), axis=-1).reshape(-1, 1, 3)
    # A quarter of a cell away from the faces, so that no site lies on one.
    places = (corners + np.array(sites) / 2.0 + 0.25).reshape(-1, 3) / cells - 0.5
    edge = cells * cell
    run = compressed(
        (places * 1.02 * edge, [RADIUS] * len(places), 1.02 * edge),
        tmp_path_factory.mktemp("lattice") / "run",
        boundary="periodic",
        approach_edge=edge,
        final_edge=edge * (1.0 - STRAIN),
        steps=30,
        steps_per_state=10,
    )
    return run, neighbours, len(places), edge * (1.0 - STRAIN)


def test_every_grain_has_the_neighbours_of_its_lattice(lattice):
    run, neighbours, grains, _ = lattice
    contacts = run.at("contacts", -1)
    number = np.bincount(np.r_[contacts["i"], contacts["j"]], minlength=grains)
    assert number.tolist() == [neighbours] * grains
    assert run.path["coordination_number"].iloc[-1] == neighbours


def test_every_force_is_that_of_the_affine_overlap(lattice):
    run, *_ = lattice
    contacts = run.at("contacts", -1)
    # 1e-12: the overlap is 3 % of a diameter and known to rounding of the positions.
    np.testing.assert_allclose(contacts["overlap_m"], 2 * RADIUS * STRAIN, rtol=1e-12)
    np.testing.assert_allclose(
        contacts["normal_force_N"], STIFFNESS * 2 * RADIUS * STRAIN, rtol=1e-12
    )


def test_stress_is_that_of_the_lattice(lattice):
    run, neighbours, grains, edge = lattice
    force, branch = STIFFNESS * 2 * RADIUS * STRAIN, 2 * RADIUS * (1 - STRAIN)
    stress = neighbours * grains / 2 * force * branch / (3 * edge**3)
    last = run.path.iloc[-1]
    np.testing.assert_allclose(last["mean_stress_Pa"], stress, rtol=1e-12)
    np.testing.assert_allclose(last["boundary_stress_Pa"], stress, rtol=1e-12)


def test_energy_grows_with_the_square_of_strain_and_is_the_work(lattice):
    run, neighbours, grains, _ = lattice
    strain = STRAIN * np.arange(1, 4) / 3
    energy = neighbours * grains / 2 * STIFFNESS * (2 * RADIUS * strain) ** 2 / 2
    path = run.path.iloc[2:]
    np.testing.assert_allclose(path["elastic_energy_J"], energy, rtol=1e-12)
    np.testing.assert_allclose(path["work_J"], energy, rtol=1e-12)


def test_nothing_is_dissipated_where_affine_motion_keeps_balance(lattice):
    run, *_ = lattice
    path = run.path.iloc[2:]
    assert (path["dissipated_J"].abs() <= 1e-12 * path["work_J"]).all()


def test_solid_fraction_is_that_of_the_lattice(lattice):
    run, _, grains, edge = lattice
    solid_fraction = grains * 4 / 3 * np.pi * RADIUS**3 / edge**3
    np.testing.assert_allclose(run.path["solid_fraction"].iloc[-1], solid_fraction, rtol=1e-14)
