"""Every saved state of a random packing, searched anew for contacts and weighed anew.

Nothing here but the positions and radii of the particle dump goes into the forces: overlaps are
found by measuring every pair of grains through every face of the cell.
"""

import itertools

import numpy as np
import pytest

from branchcrush.loading.targets import STEP_FORCE_EVALUATIONS

GRAINS = 120
STATES = 10
BOUNDARIES, LAWS = ("walls", "periodic"), ("linear", "hertz")
STIFFNESS = {"linear": 1.0e6, "hertz": 1.0e9}
# Coordinates are a few millimetres and doubles: an overlap is known to 1e-18 m or so. No contact
# here is stiffer than 1e6 N/m.
OVERLAP_ERROR = 1e-17
FORCE_ERROR = 1.0e6 * OVERLAP_ERROR
FACES = [(axis, side, f"{'-+'[side]}{'xyz'[axis]}") for axis in range(3) for side in (0, 1)]


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


def contact_force(law, overlap, radius, other=np.inf):
    """Return F of an overlap; the reduced radius is 1/(1/R + 1/R'), with a wall R."""
    if law == "linear":
        return STIFFNESS[law] * overlap
    reduced = 1.0 / (1.0 / radius + 1.0 / other)
    return STIFFNESS[law] * np.sqrt(reduced) * overlap**1.5


class Search:
    """The contacts of one frame of the particle dump: overlap and force of each."""

    def __init__(self, frame, periodic, law):
        lower, upper = frame.bounds.T
        place, radius = frame.vectors("x", "y", "z"), frame.columns["radius"]
        self.law, self.net = law, np.zeros_like(place)
        self.pairs, self.walls, self.force, self.radius = {}, {}, {}, radius
        images = itertools.product((-1, 0, 1), repeat=3) if periodic else [(0, 0, 0)]
        for image in images:
            vector = place[:, None] - place[None, :] - np.array(image) * (upper - lower)
            distance = np.linalg.norm(vector, axis=-1)
            overlap = radius[:, None] + radius[None, :] - distance
            # Both orders of a pair are met: each once with its image and once with the opposite.
            for i, j in np.argwhere((overlap > 0) & ~np.eye(len(radius), dtype=bool)):
                force = contact_force(law, overlap[i, j], radius[i], radius[j])
                self.net[i] += force * vector[i, j] / distance[i, j]
                if i < j:
                    assert (i, j) not in self.pairs, "the cell is too small for one image a pair"
                    self.pairs[i, j], self.force[i, j] = overlap[i, j], force
        for axis, side, name in [] if periodic else FACES:
            gap = (place[:, axis] - lower[axis], upper[axis] - place[:, axis])[side]
            for i in np.flatnonzero(radius - gap > 0):
                force = contact_force(law, (radius - gap)[i], radius[i])
                self.net[i, axis] += force * (1, -1)[side]
                self.walls[i, name], self.force[i, name] = (radius - gap)[i], force

    def virial(self):
        """Return the sum of force times branch, or times the distance of the centre at a wall."""
        branch = {(i, j): self.radius[[i, j]].sum() - d for (i, j), d in self.pairs.items()}
        distance = {(i, wall): self.radius[i] - d for (i, wall), d in self.walls.items()}
        return sum(self.force[key] * length for key, length in {**branch, **distance}.items())

    def energies(self):
        """Return the integral of the force over the overlap of each contact."""
        exponent = {"linear": 1.0, "hertz": 1.5}[self.law]
        overlaps = {**self.pairs, **self.walls}
        return {key: self.force[key] * overlaps[key] / (exponent + 1.0) for key in overlaps}


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


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("law", LAWS)
def test_work_of_a_step_is_what_the_forces_of_its_affine_motion_do(
    random_grains, compressed, frames, tmp_path, boundary, law
):
    periodic = boundary == "periodic"
    placed = random_grains(60, 2, periodic=periodic)
    edges = placed[2] * np.array([0.625, 0.622, 0.619, 0.616])
    run = compressed(
        placed,
        tmp_path / "run",
        boundary=boundary,
        law=law,
        stiffness=STIFFNESS[law],
        approach_edge=float(edges[0]),
        targets=edges[1:].tolist(),
        # One step to each state.
        strain_step=1.0,
    )
    work = run.path["work_J"].to_numpy()
    states = frames(run.folder / "particles.dump.gz")[1:]
    assert run.path["carries_load"].iloc[1:].all()
    for n, (before, after) in enumerate(itertools.pairwise(edges), start=1):
        ends = [before, (before + after) / 2.0, after]
        first, middle, last = (
            Search(shrunk(states[n - 1], edge / before), periodic, law) for edge in ends
        )
        pushes = [
            search.virial() / edge for search, edge in zip((first, middle, last), ends, strict=True)
        ]
        simpson = (before - after) / 6.0 * np.dot([1.0, 4.0, 1.0], pushes)
        np.testing.assert_allclose(work[n + 1] - work[n], simpson, rtol=1e-9)
        added = sum(last.energies().values()) - sum(first.energies().values())
        # Contacts close or open within the step: a few of some hundred.
        np.testing.assert_allclose(simpson, added, rtol=2e-3)


def shrunk(frame, factor):
    """Return a frame with the cell and the grain centres scaled."""
    places = {axis: factor * frame.columns[axis] for axis in "xyz"}
    return frame._replace(bounds=factor * frame.bounds, columns={**frame.columns, **places})


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


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("offset", [0.01, 0.05])
def test_a_fine_grain_caught_between_a_large_one_and_a_wall_stays_inside(
    compressed, tmp_path, offset, law
):
    # One strain step closes the gap to a fortieth of the fine grain's size.
    x = 1e-3 * np.array([-offset, 1.1])
    run = compressed(
        (np.column_stack([x, np.zeros((2, 2))]), 1e-3 * np.array([1, 0.02]), 2.3e-3),
        tmp_path / "run",
        law=law,
        approach_edge=2.25e-3,
        targets=[2.001e-3],
        strain_step=1.0,
    )
    # The large grain on the left wall, the fine one between it and the right wall: 3 contacts in
    # a row share what the diameters are too long by. One force: linear, one overlap; Hertz, an
    # overlap that goes with the third root of the curvature 1/R*.
    shortening, curvature = 1e-3 * (2 * (1 + 0.02) - 2.001), np.array([1, 1 / 0.02, 1 + 1 / 0.02])
    shares = np.ones(3) if law == "linear" else np.cbrt(curvature)
    large, fine, between = shortening * shares / shares.sum()
    walls = run.at("walls", -1)
    assert list(zip(walls["i"], walls["wall"], strict=True)) == [(0, "-x"), (1, "+x")]
    np.testing.assert_allclose(walls["overlap_m"], [large, fine], rtol=1e-6)
    np.testing.assert_allclose(run.at("contacts", -1)["overlap_m"], between, rtol=1e-6)


def test_nothing_moves_in_a_saved_state(packing):
    path = packing[0].path
    loaded = path[path["carries_load"]]
    assert (loaded["inertial_number"] < 1e-4).all()
