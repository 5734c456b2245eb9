"""Compression line of grains that break: slopes that are known, and the line of the gradings."""

import numpy as np
import pandas as pd
import pytest

from branchcrush.packings.contact_laws import HertzContact
from branchcrush.samples.crushed_line import (
    compression_line,
    compression_slope,
    mean_interval,
    on_the_line,
)
from branchcrush.samples.crushed_path import crushed_path
from tests.unit.samples.crushed_runs import INTERVALS, SAMPLE, STRAIN, control, run


def states_of(*slopes, sample=SAMPLE, **more):
    parts = [
        crushed_path(*run(slope=slope, **more), control(), sample).assign(
            seed=seed, halved_step=False
        )
        for seed, slope in enumerate(slopes, 1)
    ]
    return pd.concat(parts, ignore_index=True)


def line_of(states, sample=SAMPLE):
    controls = {seed: control() for seed in states["seed"].unique()}
    return compression_line(states, controls, sample, INTERVALS)


# Broken so early that four states yield.
EARLY = (0, 0, 8, 16, 24, 40)


def test_slopes_of_seeds_are_found_with_their_mean():
    _, summary = line_of(states_of(0.4, 0.6, broken=EARLY))
    assert summary["slopes"] == pytest.approx([0.4, 0.6])
    assert summary["slope"] == pytest.approx(0.5)
    assert summary["slope_low"] < 0.4 and summary["slope_high"] > 0.6
    assert summary["slope_by_strength"] == 0.5
    assert summary["slope_by_number_exponent"] == pytest.approx(3.0 - summary["number_exponent"])


def test_one_seed_has_a_slope_and_no_interval():
    _, summary = line_of(states_of(0.4, broken=EARLY))
    assert summary["slope"] == pytest.approx(0.4) and np.isnan(summary["slope_low"])


def test_scatter_of_the_stress_does_not_flatten_the_slope():
    rng = np.random.default_rng(1)
    void = np.exp(np.linspace(np.log(0.5), np.log(0.38), 4000))
    stress = 1e6 * (void / 0.5) ** -2.0 * np.exp(0.2 * rng.standard_normal(void.size))
    assert compression_slope(void, stress) == pytest.approx(0.5, abs=0.02)
    flat = -np.polyfit(np.log(stress), np.log(void), 1)[0]
    assert flat < 0.4  # as the other way round would have it


def test_too_few_states_or_a_falling_stress_have_no_slope():
    assert np.isnan(compression_slope(np.array([0.5, 0.4]), np.array([1e6, 2e6])))
    assert np.isnan(compression_slope(np.geomspace(0.5, 0.4, 5), np.geomspace(2e6, 1e6, 5)))


def test_states_yield_from_a_twentieth_of_the_mass_on():
    assert on_the_line(states_of(0.5))["state"].tolist() == [3, 4, 5]


def test_the_line_of_the_gradings_is_theirs_with_the_measured_strain():
    table, summary = line_of(states_of(0.5))
    assert summary["elastic_strain_scale"] == pytest.approx(STRAIN)  # b = 1: one strain for all
    states = states_of(0.5).set_index("state").loc[table["state"]]
    jamming = states["jamming_by_rods"].to_numpy()
    assert table["predicted_void_ratio"].to_numpy() == pytest.approx((1 - STRAIN) / jamming - 1)
    # p_0 is 1 GPa times the strain.
    stiffness = states["stiffness_ratio"].to_numpy()
    assert table["predicted_stress_Pa"].to_numpy() == pytest.approx(stiffness * 1e9 * STRAIN)


@pytest.mark.parametrize(("b", "law", "power"), [(2.0, None, -1.0), (1.5, "hertz", -1.0)])
def test_the_elastic_strain_goes_with_the_contact_diameter(b, law, power):
    sample = SAMPLE._replace(size_exponent=b)
    if law:
        sample = sample._replace(law=HertzContact(1e9))
    states = states_of(0.5, sample=sample)
    table, _ = line_of(states, sample)
    ratio = states.set_index("state").loc[table["state"], "contact_diameter_ratio"] ** power
    told = table["predicted_elastic_strain"] / table["predicted_elastic_strain"].iloc[0]
    assert told.to_numpy() == pytest.approx((ratio / ratio.iloc[0]).to_numpy())


def test_where_nothing_yields_the_line_is_empty_and_its_numbers_unknown():
    table, summary = line_of(states_of(0.5, broken=(0,) * 6))
    assert len(table) == 0 and summary["states_on_line"] == 0
    assert np.isnan(summary["slope"]) and np.isnan(summary["elastic_strain_scale"])


def test_a_mean_of_one_seed_has_no_interval_and_of_none_no_value():
    assert np.isnan(mean_interval([2.0], INTERVALS).low)
    assert np.isnan(mean_interval([np.nan], INTERVALS).estimate)
    assert mean_interval([1.0, 3.0, np.nan], INTERVALS).estimate == 2.0
