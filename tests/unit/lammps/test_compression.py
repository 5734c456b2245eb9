"""What in.compress is told of a packing and its loading; how a sample is placed and tried."""

import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from branchcrush.errors import SimulationError
from branchcrush.gradings.forms import uniform
from branchcrush.gradings.mixtures import single
from branchcrush.gradings.sampling import sampled_radii
from branchcrush.lammps import compression
from branchcrush.lammps.compression import (
    compression_variables,
    placed_packing,
    sample_variables,
    trial,
)
from branchcrush.lammps.run import declared_variables
from branchcrush.loading.sample import Sample
from branchcrush.loading.targets import Loading
from branchcrush.packings.contact_laws import HertzContact, LinearContact

SCRIPT = Path(__file__).parents[3] / "lammps_inputs" / "in.compress"
EIGHT = [1e-3] * 8
# Of eight balls of radius 1 mm [m3].
SOLID = 8 * 4 / 3 * math.pi * 1e-9
LINEAR = LinearContact(1e6)
LOADING = Loading("edge_reduction", 0.4, states=2, approach_solid_fraction=0.3)


def variables_of(radii=EIGHT, boundary="walls", law=LINEAR, loading=LOADING):
    return compression_variables(
        radii, 0.16, boundary=boundary, law=law, loading=loading, strain_step=1.7e-3
    )


def sample_with(**values):
    defaults = {
        "grading": uniform(1e-3, 2e-3),
        "sampling": "random",
        "grains": 30,
        "boundary": "walls",
        "initial_solid_fraction": 0.16,
        "law": LINEAR,
        "loading": LOADING,
        "strain_step": 1.7e-3,
    }
    return Sample(**{**defaults, **values})


# --- variables -----------------------------------------------------------------------------------


def test_variables_of_a_loading_to_a_strain():
    variables = variables_of()
    first, last = (SOLID / 0.3) ** (1 / 3), (SOLID / (0.16 / 0.6**3)) ** (1 / 3)
    assert_allclose(variables.pop("targets"), [(first + last) / 2, last], rtol=1e-12)
    assert variables.pop("approach_edge") == pytest.approx(first, rel=1e-12)
    # A ten thousandth of the radius, times the stiffness.
    assert variables.pop("force_floor") == pytest.approx(0.1)
    assert variables.pop("skin") == pytest.approx(0.6e-3)
    assert variables == {
        "boundary": "walls",
        "law": "linear",
        "stiffness": 1e6,
        "control": "edge",
        "strain_step": 1.7e-3,
        "step_tolerance": 3e-2,
        "step_evaluations": 200,
        "state_tolerance": 1e-7,
        "inertial_tolerance": 1e-4,
        "largest_radius": 1e-3,
        "neighbour_style": "bin",
        "collections": "none",
        "neighbours": 2008,
    }


def test_variables_of_a_loading_to_stresses_in_a_periodic_cell():
    loading = Loading("mean_stress", [1e5, 1e6], unloading=True)
    variables = variables_of([1e-3, 3e-3], "periodic", HertzContact(7e10), loading)
    assert (variables["boundary"], variables["control"]) == ("periodic", "stress")
    assert variables["targets"] == [1e5, 1e6, 1e5]
    assert (variables["law"], variables["stiffness"]) == ("hertz", 7e10)
    # Steps to a stress are told from each other more closely.
    assert variables["step_tolerance"] == 5e-3
    assert variables["largest_radius"] == 3e-3
    # K R*^(1/2) (1e-4 R)^(3/2), where R is the mean of 2 mm and R* half of it.
    assert variables["force_floor"] == pytest.approx(7e10 * 1e-3**0.5 * 2e-7**1.5)


@pytest.mark.parametrize(("approach", "style"), [(0.3, "multi"), (0.25, "bin")])
def test_neighbours_are_searched_as_fits_the_end_of_the_approach(approach, style):
    # A cell of 53.5 or 56.9 mm; from 56.1 on a cube as large as the largest grain holds under 50.
    radii = [1e-3] * 990 + [1e-2] * 10
    loading = Loading("solid_fraction", 0.7, approach_solid_fraction=approach)
    assert variables_of(radii, loading=loading)["neighbour_style"] == style


def test_the_script_declares_every_variable():
    assert set(variables_of()) <= set(declared_variables(SCRIPT))


def test_cell_that_ends_smaller_than_its_largest_grain_is_refused():
    # One ball in a cell that it fills by 0.74: an edge of 1.78 radii.
    with pytest.raises(SimulationError, match=r"ends at an edge of 0\.001782 m, .* 0\.002 m"):
        variables_of([1e-3])
    # Of two, 2.24 radii.
    assert variables_of([1e-3, 1e-3])["targets"][-1] == pytest.approx(2.245e-3, rel=1e-3)


def test_stress_that_needs_no_load_is_refused():
    # 0.1 N on a circle of radius 1 mm: 31.83 kPa.
    assert variables_of(loading=Loading("mean_stress", [3.19e4]))["targets"] == [3.19e4]
    with pytest.raises(SimulationError, match=r"3\.17e\+04 Pa is below 3\.183e\+04 Pa"):
        variables_of(loading=Loading("mean_stress", [3.17e4, 1e6]))


def test_variables_of_a_sample_are_those_of_its_values():
    law, loading = HertzContact(7e10), Loading("mean_stress", [1e6], approach_solid_fraction=0.5)
    sample = sample_with(
        boundary="periodic", law=law, loading=loading, strain_step=4e-3, state_tolerance=1e-6
    )
    variables = sample_variables(sample, EIGHT)
    assert (variables["boundary"], variables["law"]) == ("periodic", "hertz")
    assert (variables["targets"], variables["strain_step"]) == ([1e6], 4e-3)
    assert variables["state_tolerance"] == 1e-6
    assert variables["approach_edge"] == pytest.approx((SOLID / 0.5) ** (1 / 3))
    # From twice as dense, to an end that is.
    to_strain = sample_with(initial_solid_fraction=0.2)
    assert sample_variables(to_strain, EIGHT)["targets"][-1] == pytest.approx(
        (SOLID * 0.6**3 / 0.2) ** (1 / 3)
    )


# --- packings ------------------------------------------------------------------------------------


def test_packing_fills_its_cell_as_the_sample_says():
    sample = sample_with(grading=single(1e-3), grains=8, initial_solid_fraction=0.2)
    packing = placed_packing(sample, np.random.default_rng(1))
    assert_array_equal(packing.radii, EIGHT)
    assert packing.edge == pytest.approx((SOLID / 0.2) ** (1 / 3))
    assert packing.positions.shape == (8, 3)


@pytest.mark.parametrize("boundary", ["walls", "periodic"])
def test_grains_keep_off_walls_and_from_each_other(boundary):
    sample = sample_with(boundary=boundary, grains=60, initial_solid_fraction=0.3)
    positions, radii, edge = placed_packing(sample, np.random.default_rng(2))
    outside = np.abs(positions).max(axis=1) + radii > edge / 2
    assert outside.any() == (boundary == "periodic")
    apart = positions[:, None] - positions
    if boundary == "periodic":
        apart -= edge * np.round(apart / edge)
    gaps = np.linalg.norm(apart, axis=-1) - radii[:, None] - radii
    assert gaps[~np.eye(60, dtype=bool)].min() > 0


def test_radii_are_drawn_before_the_places():
    sample = sample_with()
    packing = placed_packing(sample, np.random.default_rng(3))
    drawn = sampled_radii(sample.grading, 30, "random", np.random.default_rng(3))
    assert_array_equal(packing.radii, drawn)


# --- trial ---------------------------------------------------------------------------------------


@pytest.fixture
def tried(monkeypatch):
    """Stand in for LAMMPS: 300 force evaluations in 6 s. Holds what it was given."""
    given = SimpleNamespace()

    def compress(positions, radii, edge, variables, **places):
        vars(given).update(radii=radii, edge=edge, variables=variables, **places)
        return SimpleNamespace(path={"force_evaluations": np.array([0, 120, 300])})

    clock = iter([10.0, 16.0])
    monkeypatch.setattr(compression, "compress", compress)
    monkeypatch.setattr(compression.time, "perf_counter", lambda: next(clock))
    return given


@pytest.mark.parametrize(("grains", "few"), [(20, 20), (5000, 1000)])
def test_trial_tells_the_time_of_a_grain_and_evaluation(tmp_path, tried, grains, few):
    sample = sample_with(grading=single(1e-3), grains=grains)
    places = {"inputs": "there", "folder": tmp_path, "log": "log"}
    assert trial(sample, np.random.default_rng(1), **places) == pytest.approx(6 / 300 / few)
    assert (len(tried.radii), tried.inputs, tried.log) == (few, "there", "log")
    # Nothing is left.
    assert list(tmp_path.iterdir()) == []


def test_trial_takes_one_strain_step_to_a_loaded_packing(tmp_path, tried):
    sample = sample_with(grains=8, loading=Loading("mean_stress", [1e6]))
    trial(sample, np.random.default_rng(1), inputs="there", folder=tmp_path, log="log")
    # The middles of eight parts of equal number, the largest first.
    assert_allclose(tried.radii, 1e-3 * (1 + (np.arange(8)[::-1] + 0.5) / 8))
    solid = 4 / 3 * math.pi * (tried.radii**3).sum()
    assert (tried.variables["control"], tried.variables["strain_step"]) == ("edge", 1.0)
    assert_allclose(tried.variables["targets"], [(solid / 0.68) ** (1 / 3)], rtol=1e-12)
    assert tried.variables["approach_steps"] == 20
