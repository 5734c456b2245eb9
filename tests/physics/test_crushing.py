"""Grains that break: what holds of any crushing, on small packings, and two grains told by hand."""

import numpy as np
import pytest

from branchcrush.breakage.fragments import packed_spheres
from branchcrush.breakage.rules import Breakage
from branchcrush.breakage.strength import Strength, weibull_factor
from branchcrush.errors import SimulationError
from branchcrush.lammps.compression import Packing, compress, compression_variables
from branchcrush.lammps.crush import LARGEST_RELAXATION, crush
from branchcrush.lammps.progress import Progress
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


@pytest.fixture(scope="module")
def run(tmp_path_factory, lammps_inputs):
    """Return a function that crushes a packing in a folder of its own."""

    def crushed(packing, given, how, **others):
        folder = tmp_path_factory.mktemp("crushing")
        chosen = {"seed": 1, "keep_dumps": "none", **others}
        return crush(
            *packing, given, how, inputs=lammps_inputs, folder=folder, log=folder / "log", **chosen
        )

    return crushed


@pytest.fixture(scope="module")
def usual(run):
    """Return one crushing that many tests read."""
    packing = loose()
    return run(packing, variables(packing), rules())


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


def test_grains_break_and_no_mass_is_lost(usual):
    grains, path = usual.grains, usual.path
    assert path["breakages"][-1] > 5
    mass = np.bincount(grains["state"], grains["radius_m"] ** 3)
    assert mass == pytest.approx(mass[0], rel=1e-9)
    for state in path["state"]:
        of_state = grains["grain"][grains["state"] == state]
        assert np.unique(of_state).size == of_state.size == path["grains"][state]


def test_fragments_are_those_of_their_parents(usual):
    first = {number: n for n, number in reversed(list(enumerate(usual.grains["grain"])))}
    broken = set(usual.breakages["grain"])
    fragments = [row for number, row in first.items() if usual.grains["parent"][row] >= 0]
    assert {usual.grains["parent"][row] for row in fragments} == broken
    radius = dict(zip(usual.breakages["grain"], usual.breakages["radius_m"], strict=True))
    generation = dict(zip(usual.breakages["grain"], usual.breakages["generation"], strict=True))
    for row in fragments:
        parent = usual.grains["parent"][row]
        assert usual.grains["radius_m"][row] < radius[parent]
        assert usual.grains["generation"][row] == generation[parent] + 1


def test_work_is_stored_or_taken_by_what_is_booked(usual):
    assert np.all(stored_in(usual.path) < 1e-6)
    for name in ("dissipated_breakage_J", "dissipated_rearrangement_J", "released_by_parents_J"):
        assert np.all(np.diff(usual.path[name])[1:] >= 0.0)
    # By parts that are not made of each other.
    released = usual.breakages["released_J"].sum()
    assert usual.path["released_by_parents_J"][-1] <= released * (1.0 + 1e-12)


def test_without_dashpots_all_that_is_taken_is_motion_at_the_stops(run):
    packing = loose()
    # Without dashpots a packing comes to rest by its stops alone, and in shorter time steps its
    # energy is kept between them.
    given = variables(packing, solid_fraction=0.68, normal_damping=0.0, time_step=0.3)
    path = run(packing, given, rules(3e6)).path
    assert path["breakages"][-1] > 5
    stopped = path["stopped_kinetic_energy_J"][-1] - path["stopped_kinetic_energy_J"][1]
    taken = path["dissipated_breakage_J"][-1] + path["dissipated_rearrangement_J"][-1]
    put_in, out = path["growth_work_J"][-1], path["exchanged_energy_J"][-1]
    assert out + stopped == pytest.approx(taken + put_in, rel=0.05)
    assert stopped > 0.5 * taken


def test_no_grain_above_the_limit_is_overloaded_at_a_saved_state(usual):
    grains = usual.grains
    large = 2.0 * grains["radius_m"] > LIMIT
    assert np.all(grains["stress_Pa"][large] < grains["strength_Pa"][large])
    assert np.all(usual.breakages["stress_Pa"] >= usual.breakages["strength_Pa"])
    assert not usual.path["escaped"].any()
    assert np.all(usual.path["contact_law_error"] < 1e-9)
    loaded = usual.path["carries_load"]
    assert loaded.any()
    assert np.all(usual.path["unbalanced_force_ratio"][loaded] <= 1e-6)


def test_the_same_run_twice_is_the_same(run, usual):
    packing = loose()
    assert alike(usual, run(packing, variables(packing), rules())) == []


@pytest.mark.parametrize("reached", [0, 2, 3, 4])
def test_a_run_that_was_stopped_goes_on_to_the_same_bytes(
    run, usual, reached, tmp_path, monkeypatch
):
    note = Progress.note_state

    def note_and_die(self, crushing, targets):
        note(self, crushing, targets)
        if targets == reached:
            # What is written on after a state is cut off.
            (self.folder / "states.csv").open("a").write("9,9")
            raise RuntimeError("killed")

    packing, folder = loose(), tmp_path / "unfinished"
    given = packing, variables(packing), rules()
    with monkeypatch.context() as patch, pytest.raises(SimulationError, match="killed"):
        patch.setattr(Progress, "note_state", note_and_die)
        run(*given, progress=folder)
    assert alike(usual, run(*given, progress=folder)) == []
    assert not folder.exists()


def test_what_another_job_left_is_not_gone_on_with(run, usual, tmp_path, monkeypatch):
    packing, folder = loose(), tmp_path / "unfinished"
    note = Progress.note_state

    def note_and_die(self, crushing, targets):
        note(self, crushing, targets)
        raise RuntimeError("killed")

    with monkeypatch.context() as patch, pytest.raises(SimulationError):
        patch.setattr(Progress, "note_state", note_and_die)
        run(packing, variables(packing), rules(2e7), progress=folder)
    assert alike(usual, run(packing, variables(packing), rules(), progress=folder)) == []


@pytest.mark.parametrize(
    "how", [rules(np.inf), rules(smallest_diameter=2e-3)], ids=["infinite", "limit above all"]
)
def test_grains_that_cannot_break_are_compressed(how, tmp_path, lammps_inputs):
    packing = loose()
    given = variables(packing)
    crushed = crush(
        *packing,
        given,
        how,
        seed=1,
        inputs=lammps_inputs,
        folder=tmp_path / "a",
        log=tmp_path / "log",
    )
    to_rest = {
        "step_tolerance": how.step_tolerance,
        "step_evaluations": LARGEST_RELAXATION,
        "largest_relaxation": LARGEST_RELAXATION,
    }
    plain = compress(
        *packing,
        {**given, **to_rest},
        inputs=lammps_inputs,
        folder=tmp_path / "b",
        log=tmp_path / "log",
    )
    for kind in ("path", "contacts", "walls", "steps"):
        for name, column in getattr(plain, kind).items():
            assert np.array_equal(
                column, getattr(crushed, kind)[name], equal_nan=column.dtype.kind == "f"
            ), (kind, name)
    for dump in ("particles.dump.gz", "pairs.dump.gz"):
        assert (tmp_path / "a" / dump).read_bytes() == (tmp_path / "b" / dump).read_bytes()
    assert not crushed.breakages["grain"].size


def body_centred(scale=1.0):
    """Return two grains of 1 mm, each in the middle of eight images of the other."""
    edge = scale * 1.5e-3
    return Packing(np.array([[-edge / 4] * 3, [edge / 4] * 3]), np.full(2, scale * 5e-4), edge)


def of_two(target, *, scale=1.0):
    """Return the variables of their compression to an edge; they touch at 1.1547 mm."""
    packing = body_centred(scale)
    return variables(packing, targets=[target], approach_edge=scale * 1.16e-3)


@pytest.mark.parametrize(("stepping", "above"), [("strain_step", None), ("events", 1e-9)])
def test_one_grain_breaks_at_its_strength(run, stepping, above):
    factors = [weibull_factor(1, (number,), 3.0) for number in (0, 1)]
    weak = int(np.argmin(factors))
    strength = 2e7 * factors[weak]
    diameter, stiffness = 1e-3, 1e6
    overlap = strength * diameter**2 / stiffness
    breaks_at = (diameter - overlap) * 2.0 / np.sqrt(3.0)
    # What they break into is too fine to break.
    how = rules(2e7, stepping=stepping, event_tolerance=above or 1e-2, smallest_diameter=6e-4)
    out = run(body_centred(), of_two(0.998 * breaks_at), how)
    broken = {name: column[0] for name, column in out.breakages.items()}
    assert broken["grain"] == weak
    edge = np.cbrt(2.0 * np.pi / 6.0 * diameter**3 / broken["solid_fraction"])
    if stepping == "events":
        assert broken["stress_Pa"] / strength == pytest.approx(1.0, abs=2e-9)
        assert edge == pytest.approx(breaks_at, rel=1e-9)
    else:
        edges = np.cbrt(out.steps["volume_m3"])
        assert edge == pytest.approx(edges[edges < breaks_at][0], rel=1e-12)
        assert edges[edges >= breaks_at][-1] / edge < 1.0 + 2.1e-3
    force = stiffness * (diameter - np.sqrt(3.0) / 2.0 * edge)
    assert broken["largest_force_N"] == pytest.approx(force, rel=1e-9)
    assert broken["contacts"] == 8
    assert broken["released_J"] == pytest.approx(8 * force**2 / (2 * stiffness), rel=1e-9)
    state = int(broken["state"])
    fragments = out.grains["parent"] == weak
    fragments &= out.grains["state"] == state
    spheres = packed_spheres(14)[:, 3]
    radii = 5e-4 * spheres / np.cbrt((spheres**3).sum())
    assert np.sort(out.grains["radius_m"][fragments])[::-1] == pytest.approx(radii, rel=1e-12)


def test_lengths_scale_out(run):
    # Of twice the size all forces are twice as large, and so is what breaks a grain with b = 1.
    how = {"stepping": "events", "event_tolerance": 1e-9}
    one, twice = (
        run(
            body_centred(scale),
            of_two(scale * 1.13e-3, scale=scale),
            rules(2e7, smallest_diameter=scale * 6e-4, **how),
        ).breakages
        for scale in (1.0, 2.0)
    )
    factors = {"solid_fraction": 1.0, "largest_force_N": 2.0, "stress_Pa": 0.5, "released_J": 4.0}
    for name, factor in factors.items():
        assert twice[name][0] == pytest.approx(factor * one[name][0], rel=1e-8)


@pytest.mark.parametrize(
    ("case", "how"),
    [
        ({"periodic": False, "approach": 0.5, "solid_fraction": 0.62}, {"strength": 2e7}),
        ({"law": GLASS}, {"strength": 5e7}),
        ({"unloading": True}, {"strength": 1e7}),
        ({}, {"strength": 1e7, "criterion": "octahedral_stress", "per_round": "one"}),
        ({}, {"strength": 1e7, "growth_stages": 0, "fragments": 20}),
        ({"solid_fraction": 0.655}, {"strength": 1e7, "stepping": "events"}),
        ({"law": GLASS, "solid_fraction": 0.69, "states": 1}, {"strength": 3e7}),
    ],
    ids=["walls", "Hertz", "unloading", "octahedral", "at once", "events", "Hertz in many rounds"],
)
def test_the_account_closes_in_every_case(run, case, how):
    periodic = case.get("periodic", True)
    packing = loose(periodic=periodic)
    out = run(packing, variables(packing, **case), rules(**how))
    assert out.path["breakages"][-1] > 0
    assert np.all(stored_in(out.path) < 1e-6)
    mass = np.bincount(out.grains["state"], out.grains["radius_m"] ** 3)
    assert mass == pytest.approx(mass[0], rel=1e-9)
    large = 2.0 * out.grains["radius_m"] > LIMIT
    assert np.all(out.grains["stress_Pa"][large] < out.grains["strength_Pa"][large])
    loaded = out.path["carries_load"]
    assert out.path["boundary_stress_Pa"][loaded] == pytest.approx(
        out.path["mean_stress_Pa"][loaded], rel=1e-4
    )
    if not periodic:
        assert out.walls["i"].size


def test_unloading_and_reloading(run):
    packing = loose()
    given = variables(packing)
    *_, before, end = given["targets"]
    out = run(packing, {**given, "targets": [*given["targets"], before, end]}, rules())
    stress, grains = out.path["mean_stress_Pa"], out.path["grains"]
    assert stress[-2] < stress[-3]
    assert np.all(stored_in(out.path) < 1e-6)
    assert grains[-1] >= grains[-2] >= grains[-3]


def test_ranks_give_the_same_strengths_and_a_closed_account(run, usual):
    packing = loose()
    out = run(packing, variables(packing), rules(), ranks=2)
    first = usual.grains["state"] == 0
    assert np.array_equal(
        out.grains["strength_Pa"][out.grains["state"] == 0], usual.grains["strength_Pa"][first]
    )
    assert np.all(stored_in(out.path) < 1e-6)
    assert out.path["breakages"][-1] > 0


def test_a_run_ends_validly_before_it_has_too_many_grains(run):
    packing = loose()
    out = run(packing, variables(packing), rules(largest_grains=100))
    assert "largest_grains 100" in out.path["stopped"][-1]
    assert out.path["grains"].max() <= 100
    assert np.all(stored_in(out.path) < 1e-6)


def test_a_run_ends_validly_at_a_stress(run):
    packing = loose()
    out = run(packing, variables(packing), rules(np.inf, largest_mean_stress=1e5))
    assert "largest_mean_stress" in out.path["stopped"][-1]
    assert np.all(out.path["mean_stress_Pa"][:-1] < 1e5)


def test_a_packing_that_is_crushed_by_the_approach_says_so(run):
    packing = loose()
    with pytest.raises(SimulationError, match="approach_solid_fraction"):
        run(packing, variables(packing, approach=0.66), rules(1e5))


def test_a_loading_to_stresses_is_refused(run):
    packing = loose()
    given = {**variables(packing), "control": "stress"}
    with pytest.raises(SimulationError, match="way to a strain"):
        run(packing, given, rules())
