"""Every saved state of a random packing, searched anew for contacts and weighed anew.

Nothing here but the positions and radii of the particle dump goes into the forces: overlaps are
found by measuring every pair of grains through every face of the cell.
"""

import itertools

import numpy as np
import pytest

from branchcrush.loading.targets import STEP_FORCE_EVALUATIONS
from tests.physics.search import BOUNDARIES, FACES, LAWS, STIFFNESS, Search

GRAINS = 120
STATES = 10
# Coordinates are a few millimetres and doubles: an overlap is known to 1e-18 m or so. No contact
# here is stiffer than 1e6 N/m.
OVERLAP_ERROR = 1e-17
FORCE_ERROR = 1.0e6 * OVERLAP_ERROR


@pytest.fixture(scope="module", params=itertools.product(BOUNDARIES, LAWS), ids="-".join)
def packing(request, random_grains, compressed, even_edges, frames, tmp_path_factory):
    boundary, law = request.param
    placed = random_grains(GRAINS, 1, periodic=boundary == "periodic")
    edge = placed[2]
    run = compressed(
        placed,
        tmp_path_factory.mktemp("random") / "run",
        boundary=boundary,
        law=law,
        stiffness=STIFFNESS[law],
        **even_edges(0.68 * edge, 0.60 * edge, steps=32, states=8),
    )
    particles = frames(run.folder / "particles.dump.gz")
    pairs = frames(run.folder / "pairs.dump.gz")
    assert len(particles) == len(pairs) == len(run.path) == STATES
    return run, particles, pairs


@pytest.fixture(scope="module")
def searched(packing):
    """Return for each state its row of the path, contacts, walls, frame and search."""
    run, particles, _ = packing
    periodic, law = run.variables["boundary"] == "periodic", run.variables["law"]
    return [
        (row, run.at("contacts", n), run.at("walls", n), frame, Search(frame, periodic, law))
        for (n, row), frame in zip(run.path.iterrows(), particles, strict=True)
    ]


def test_the_path_goes_from_loose_to_loaded(packing):
    path = packing[0].path
    assert not path["carries_load"].iloc[0]
    assert path["carries_load"].iloc[-2:].all()
    assert path["coordination_number"].iloc[-1] > 5.0


def test_the_cell_has_the_edges_asked_for(packing):
    run, particles, _ = packing
    first = np.ptp(particles[0].bounds[0])
    edges = [first, *(first * (0.68 - 0.08 * np.arange(9) / 8))]
    measured = [np.ptp(frame.bounds, axis=1) for frame in particles]
    # LAMMPS hands numbers on with 15 digits.
    np.testing.assert_allclose(measured, np.outer(edges, np.ones(3)), rtol=4e-15)
    np.testing.assert_allclose(run.path["volume_m3"], np.prod(measured, axis=1), rtol=1e-14)
    np.testing.assert_allclose(run.path["linear_strain"], 1 - np.array(edges) / first, atol=1e-14)
    np.testing.assert_allclose(
        run.path["volumetric_strain"], 1 - np.array(edges) ** 3 / first**3, atol=1e-14
    )


def test_grains_keep_their_radii(packing):
    _, particles, _ = packing
    for frame in particles:
        np.testing.assert_array_equal(frame.columns["id"], np.arange(1, GRAINS + 1))
        np.testing.assert_array_equal(frame.columns["radius"], particles[0].columns["radius"])


def test_no_grain_is_outside(packing):
    run, particles, _ = packing
    for frame in particles:
        lower, upper = frame.bounds.T
        place = frame.vectors("x", "y", "z")
        assert ((place >= lower) & (place <= upper)).all()
    assert (run.path["escaped"] == 0).all()


def test_contacts_are_those_found_from_the_positions_each_once(searched):
    for _, contacts, _, _, search in searched:
        listed = list(zip(contacts["i"], contacts["j"], strict=True))
        assert len(listed) == len(set(listed))
        # Two grains that only just touch may do so in one order of rounding and not in another.
        clear = {pair for pair, overlap in search.pairs.items() if overlap > OVERLAP_ERROR}
        assert clear <= set(listed)
        listed_clear = set(
            zip(
                *contacts[contacts["overlap_m"] > OVERLAP_ERROR][["i", "j"]].to_numpy().T,
                strict=True,
            )
        )
        assert listed_clear <= set(search.pairs)


def test_overlaps_and_forces_are_those_found_from_the_positions(searched):
    for _, contacts, _, frame, search in searched:
        found = [search.pairs.get((i, j), 0.0) for i, j in contacts[["i", "j"]].to_numpy()]
        found = np.array(found, dtype=float)
        radius = frame.columns["radius"]
        np.testing.assert_array_equal(contacts["radius_i_m"], radius[contacts["i"]])
        np.testing.assert_array_equal(contacts["radius_j_m"], radius[contacts["j"]])
        np.testing.assert_allclose(contacts["overlap_m"], found, rtol=0, atol=OVERLAP_ERROR)
        pairs = list(zip(contacts["i"], contacts["j"], strict=True))
        force = [search.force.get(pair, 0.0) for pair in pairs]
        np.testing.assert_allclose(contacts["normal_force_N"], force, rtol=0, atol=FORCE_ERROR)
        found = search.energies()
        energy = [found.get(pair, 0.0) for pair in pairs]
        np.testing.assert_allclose(contacts["energy_J"], energy, rtol=1e-9, atol=FORCE_ERROR**2)


def test_wall_contacts_have_the_sides_and_forces_found_from_the_positions(searched):
    for _, _, walls, _, search in searched:
        listed = dict(
            zip(zip(walls["i"], walls["wall"], strict=True), walls["overlap_m"], strict=True)
        )
        assert len(listed) == len(walls)
        assert listed.keys() == search.walls.keys()
        np.testing.assert_allclose(
            [listed[key] for key in search.walls],
            list(search.walls.values()),
            rtol=0,
            atol=OVERLAP_ERROR,
        )
        force = [search.force[key] for key in zip(walls["i"], walls["wall"], strict=True)]
        np.testing.assert_allclose(walls["normal_force_N"], force, rtol=0, atol=FORCE_ERROR)


def test_all_six_walls_are_pressed_or_none_in_a_periodic_cell(packing):
    run, *_ = packing
    walls = {"walls": {name for *_, name in FACES}, "periodic": set()}[run.variables["boundary"]]
    assert set(run.at("walls", -1)["wall"]) == walls


def test_the_forces_found_from_the_positions_balance_on_every_grain(searched):
    for row, contacts, _, frame, search in searched:
        # Twenty forces at most act on a grain, each known to FORCE_ERROR.
        np.testing.assert_allclose(
            search.net, frame.vectors("fx", "fy", "fz"), rtol=0, atol=20 * FORCE_ERROR
        )
        if row["carries_load"]:
            net = np.linalg.norm(search.net, axis=1)
            assert net.mean() <= 1e-6 * contacts["normal_force_N"].mean()
            np.testing.assert_allclose(
                row["unbalanced_force_ratio"],
                net.mean() / contacts["normal_force_N"].mean(),
                rtol=1e-3,
            )


def test_every_saved_state_is_at_rest(packing):
    path = packing[0].path
    limit = np.where(path["carries_load"], 1e-6, 1e-3)
    assert (path["unbalanced_force_ratio"] <= limit).all()
    assert path["carries_load"].sum() > 2


def test_stress_of_the_branches_is_that_of_the_boundary(packing):
    path = packing[0].path
    loaded = path[path["carries_load"]]
    np.testing.assert_allclose(loaded["mean_stress_Pa"], loaded["boundary_stress_Pa"], rtol=1e-6)


def test_stress_is_the_virial_of_the_forces_found_from_the_positions(packing, searched):
    _, _, pairs = packing
    for (row, _, _, frame, search), pair_frame in zip(searched, pairs, strict=True):
        if not row["carries_load"]:
            continue
        branch = pair_frame.vectors("branch_x", "branch_y", "branch_z")
        force = pair_frame.vectors("force_x", "force_y", "force_z")
        volume = np.prod(np.ptp(frame.bounds, axis=1))
        # A wall's branch ends where it touches the grain: radius less overlap from its centre.
        radius = frame.columns["radius"]
        at_walls = sum(search.force[key] * (radius[key[0]] - d) for key, d in search.walls.items())
        stress = (np.sum(branch * force) + at_walls) / (3.0 * volume)
        np.testing.assert_allclose(row["mean_stress_Pa"], stress, rtol=1e-12)


def test_the_pair_dump_points_from_the_second_grain_to_the_first_and_pushes_the_first(packing):
    _, particles, pairs = packing
    frame, pair = particles[-1], pairs[-1]
    place, edge = frame.vectors("x", "y", "z"), np.ptp(frame.bounds[0])
    first, second = (pair.columns[name].astype(int) - 1 for name in ("id1", "id2"))
    branch = place[first] - place[second]
    if packing[0].variables["boundary"] == "periodic":
        branch -= edge * np.round(branch / edge)
    length = np.linalg.norm(branch, axis=1)
    dumped = pair.vectors("branch_x", "branch_y", "branch_z")
    np.testing.assert_allclose(dumped, branch, rtol=0, atol=OVERLAP_ERROR)
    np.testing.assert_allclose(pair.columns["branch"], length, rtol=1e-14)
    np.testing.assert_allclose(
        pair.vectors("force_x", "force_y", "force_z"),
        (pair.columns["force"] / length)[:, None] * branch,
        rtol=0,
        atol=1e-12 * pair.columns["force"].max(),
    )
    assert (pair.columns["force"] >= 0).all()


def test_elastic_energy_is_that_of_the_overlaps_found_from_the_positions(searched):
    for row, *_, search in searched:
        # dE = F dx: in an unloaded state the overlaps are near their rounding.
        error = sum(search.force.values()) * OVERLAP_ERROR
        energy = sum(search.energies().values())
        np.testing.assert_allclose(row["elastic_energy_J"], energy, rtol=1e-13, atol=error)


def test_work_is_stored_or_dissipated_and_dissipation_never_runs_backwards(packing):
    path = packing[0].path
    work = path["work_J"].iloc[-1]
    np.testing.assert_allclose(
        path["work_J"] - path["elastic_energy_J"], path["dissipated_J"], rtol=0, atol=1e-12 * work
    )
    # Where contacts close within a step, Simpson's rule errs either way.
    assert (path["dissipated_J"] >= -1e-6 * work).all()
    assert (path["dissipated_J"].diff().iloc[1:] >= -1e-6 * work).all()
    # Rearrangements do dissipate: the account is not trivially closed.
    assert path["dissipated_J"].iloc[-1] > 0.01 * work


def test_every_force_follows_the_law(packing):
    path = packing[0].path
    assert (path["contact_law_error"] < 1e-12).all()


def test_overlap_ratios_are_those_of_the_overlaps_found(searched):
    for row, _, _, frame, search in searched:
        radius = frame.columns["radius"]
        ratios = [overlap / min(radius[[i, j]]) for (i, j), overlap in search.pairs.items()]
        if row["carries_load"]:
            found = [np.median(ratios), np.quantile(ratios, 0.95), max(ratios)]
            columns = ["median_overlap_ratio", "overlap_ratio_95", "max_overlap_ratio"]
            np.testing.assert_allclose(row[columns].astype(float), found, rtol=1e-9)


def test_the_steps_agree_with_the_states(packing):
    run, *_ = packing
    steps, path = run.steps, run.path.iloc[1:]
    assert steps["step"].tolist() == list(range(33))
    at_states = steps.iloc[::4].reset_index(drop=True)
    for name in ("force_evaluations", "volume_m3", "work_J"):
        np.testing.assert_array_equal(at_states[name], path[name])
    for name in ("solid_fraction", "mean_stress_Pa", "unbalanced_force_ratio"):
        scale = path[name].max()
        np.testing.assert_allclose(at_states[name], path[name], rtol=1e-12, atol=1e-12 * scale)
    counted = run.contacts["state"].value_counts().reindex(path["state"], fill_value=0)
    assert at_states["contacts"].tolist() == counted.tolist()
    strain = -np.diff(np.log(steps["volume_m3"])) / 3.0
    assert (strain > 0).all()
    # To a target the steps are equal in the edge: it is their mean strain that is bounded.
    assert strain.reshape(8, 4).mean(axis=1).max() <= run.variables["strain_step"] * (1 + 1e-6)
    # A step comes to rest, or is left after so many evaluations.
    taken = np.diff(steps["force_evaluations"])
    at_rest = steps["unbalanced_force_ratio"].iloc[1:] <= 1e-2
    assert (at_rest | (taken >= STEP_FORCE_EVALUATIONS)).all()
    assert at_rest.mean() > 0.5
    assert (taken > 0).all()


def test_nothing_moves_in_a_saved_state(packing):
    path = packing[0].path
    loaded = path[path["carries_load"]]
    assert (loaded["inertial_number"] < 1e-4).all()


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_a_state_goes_on_until_it_hardly_moves(
    boundary, law, random_grains, compressed, even_edges, tmp_path
):
    packing = random_grains(60, 2, periodic=boundary == "periodic")
    edges = even_edges(0.66 * packing[2], 0.60 * packing[2], steps=12, states=4)

    def inertial_numbers(tolerance):
        run = compressed(
            packing,
            tmp_path / f"{tolerance}",
            boundary=boundary,
            law=law,
            state_tolerance=1e-5,
            inertial_tolerance=tolerance,
            **edges,
        )
        loaded = run.path[run.path["carries_load"]]
        assert (loaded["unbalanced_force_ratio"] <= 1e-5).all()
        return loaded["inertial_number"]

    # So far forces alone bring it to rest.
    assert inertial_numbers(1.0).max() > 1e-7
    assert inertial_numbers(1e-8).max() <= 1e-8
