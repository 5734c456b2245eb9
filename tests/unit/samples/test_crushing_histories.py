"""Own histories, events and bands of the crushing curves."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.crushing.curves import LinearCurve, TabulatedCurve
from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.resistance import CriticalEnergy
from branchcrush.samples.crushing_bands import BANDS, with_bands
from branchcrush.samples.crushing_curves import events_table, form_curves, history_curves

# theta = 0.6, E_c0 = 1e-3, s = 2, p_0 = eps: C = 1 - eps_y/eps, eps_y = 0.0577350.
FORM, LAW = ModelForm(LinearCurve(0.6)), PowerLawElasticity(1.0, 1.0)
RESISTANCE = CriticalEnergy(1e-3, 2.0)
YIELD = 0.05773502691896258


def test_a_history_has_a_row_for_each_load():
    loads = np.array([0.05, 0.1, 0.02, 0.1, 0.2])
    rows, evolution = history_curves(FORM, LAW, RESISTANCE, "strain", loads)
    assert (rows["path"] == "history").all()
    assert_allclose(rows["volumetric_strain"], loads)
    crushed = 1 - YIELD / np.array([YIELD, 0.1, 0.1, 0.1, 0.2])
    assert_allclose(rows["crushing"], crushed, atol=1e-12)
    assert rows["stress_Pa"][1] == pytest.approx(0.07464101615137755, rel=1e-12)
    kept = rows["free_energy_J_per_m3"] + rows["dissipated_J_per_m3"]
    assert_allclose(rows["work_J_per_m3"], kept, rtol=1e-10)
    events = events_table(FORM, LAW, evolution)
    assert events["event"].tolist() == ["yield"] and events["load"].tolist() == [1]
    assert_allclose(events[["volumetric_strain", "stress_Pa"]], [[YIELD, YIELD]], rtol=1e-12)


def test_a_history_of_stress_and_its_jump():
    # Softening from C = 0.4 on: a stress that rises finds no next C until 0.6.
    form = ModelForm(TabulatedCurve((0.0, 0.2, 0.4, 0.6, 1.0), (1.0, 0.95, 0.9, 0.5, 0.4)))
    loads = np.array([0.05, 0.18])
    rows, evolution = history_curves(form, LAW, CriticalEnergy(2e-3, 0.5), "stress", loads)
    assert_allclose(rows["stress_Pa"], loads, rtol=1e-10)
    events = events_table(form, LAW, evolution).set_index("event")
    jump = events.loc[["jump"]].iloc[0]
    assert jump["crushing_after"] > jump["crushing"] and jump["load"] == 1
    assert 0.0 < jump["dissipated_J_per_m3"] <= rows["dissipated_J_per_m3"].iloc[-1]


def test_loads_of_events_are_counted_in_whole_numbers_also_where_none_happens():
    _, evolution = history_curves(FORM, LAW, RESISTANCE, "strain", np.array([0.5 * YIELD]))
    events = events_table(FORM, LAW, evolution)
    assert events.empty and events["load"].dtype == int


def test_bands_are_the_curves_at_the_ends():
    stiff, soft = PowerLawElasticity(1.2, 1.0), PowerLawElasticity(0.9, 1.0)
    rows, _ = form_curves(FORM, LAW, RESISTANCE, 0.2, fixed=(0.5,))
    loads = np.array([0.05, 0.2])
    own, _ = history_curves(FORM, LAW, RESISTANCE, "strain", loads)
    together = pd.concat([rows, own], ignore_index=True)
    banded = with_bands(together, [(FORM, stiff), (FORM, soft)], RESISTANCE, ("strain", loads))
    fixed = banded[banded["path"] == "fixed"]
    assert_allclose(fixed["stress_low_Pa"], 0.9 * fixed["stress_Pa"], rtol=1e-12)
    assert_allclose(fixed["free_energy_high_J_per_m3"], 1.2 * fixed["free_energy_J_per_m3"])
    before = banded[(banded["path"] == "history")].iloc[0]
    assert_allclose(before[["stress_low_Pa", "stress_high_Pa"]].astype(float), [0.045, 0.06])
    # Of p_0 = A eps, sigma = 0.4 A eps + 0.6 A eps_y, eps_y = sqrt(2 E_c0/(0.6 A)).
    after = banded[(banded["path"] == "history")].iloc[1]
    ends = [0.4 * a * 0.2 + 0.6 * a * np.sqrt(2e-3 / (0.6 * a)) for a in (0.9, 1.2)]
    assert_allclose(after[["stress_low_Pa", "stress_high_Pa"]].astype(float), ends, rtol=1e-10)


def test_the_side_of_an_end_without_a_law_is_empty():
    rows, _ = form_curves(FORM, LAW, RESISTANCE, 0.2, fixed=(0.5,))
    banded = with_bands(rows, [(FORM, PowerLawElasticity(0.9, 1.0))], RESISTANCE, None, 1)
    loaded = banded[(banded["path"] == "fixed") & (banded["stress_Pa"] > 0)]
    assert_allclose(loaded["stress_low_Pa"], 0.9 * loaded["stress_Pa"], rtol=1e-12)
    assert banded.filter(like="_high_").isna().all(axis=None)
    # Bands of n alone would leave out what phi_J does.
    of_exponent = [(FORM, LAW), (ModelForm(LinearCurve(0.5)), LAW)]
    neither = with_bands(rows, of_exponent, RESISTANCE, None, 2)
    assert neither[list(BANDS)].isna().all(axis=None)


def test_bands_without_ends_are_empty():
    rows, _ = form_curves(FORM, LAW, RESISTANCE, 0.2, fixed=())
    assert with_bands(rows, [], RESISTANCE)[list(BANDS)].isna().all(axis=None)
