"""Forms of the crushing model beside a crushing: where they begin, and what is left out."""

import numpy as np
import pandas as pd
import pytest

from branchcrush.branches.mixing import mixing_path
from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.errors import FitError
from branchcrush.gradings.forms import uniform
from branchcrush.samples.crushed_forms import beside_forms, fitted_law, pooled_law
from tests.unit.samples.crushed_runs import SAMPLE

FIRST = uniform(0.4e-3, 0.6e-3)
LAW = PowerLawElasticity(1e9, 1.0)
ONSET = 0.0125
SETTINGS = {"hardening_exponent": 2.0, "rod_gap": 0.7769, "exponent": 3.0}


@pytest.fixture(scope="module")
def jamming():
    path = mixing_path(FIRST, SAMPLE.ultimate(FIRST), SAMPLE.law, gap=SETTINGS["rod_gap"])
    return float(path.solid_fraction[0])


def told(jamming, strains):
    states = pd.DataFrame({"state": range(len(strains))})
    states["solid_fraction"] = jamming / (1.0 - np.array(strains))
    return beside_forms(states, FIRST, LAW, ONSET, SAMPLE, SETTINGS)


def test_every_form_begins_at_the_elastic_strain_of_the_simulation(jamming):
    table, said = told(jamming, [-0.01, 0.99 * ONSET, 1.01 * ONSET, 0.03])
    assert not said and set(table["form"]) == {
        "moving_jamming", "paper", "density", "einav", "tengattini"
    }  # fmt: skip
    for _, rows in table.groupby("form"):
        crushing = rows["crushing"].to_numpy()
        assert np.isnan(crushing[0])  # the grains are apart
        assert crushing[1] == 0.0 and 0.0 < crushing[2] < crushing[3]
        assert rows["stress_Pa"].iloc[1] == pytest.approx(1e9 * 0.99 * ONSET)
        assert rows["dissipated_J_per_m3"].iloc[1] == 0.0
        assert rows["dissipated_J_per_m3"].iloc[3] > 0.0


def test_the_forms_of_the_paper_and_of_einav_crush_as_their_equation_says(jamming):
    table, _ = told(jamming, [0.03])
    # theta Psi = E_c0/(1 - C)^2, and E_c0 is theta Psi at the onset: theta cancels.
    expected = 1.0 - ONSET / 0.03
    for form in ("paper", "einav"):
        assert table.set_index("form").loc[form, "crushing"] == pytest.approx(expected)


def test_a_form_by_which_crushing_costs_energy_is_left_out_and_says_so(jamming):
    states = pd.DataFrame({"state": [1], "solid_fraction": [jamming / 0.97]})
    settings = {**SETTINGS, "exponent": 1.0}  # then many fine branches hold more
    table, said = beside_forms(states, FIRST, LAW, ONSET, SAMPLE, settings)
    assert "density" not in set(table["form"])
    assert said == [
        "The form “paper with branch density” is not drawn: by it crushing costs elastic energy "
        "from the beginning on."
    ]


def test_a_limit_above_every_grain_leaves_no_form(jamming):
    states = pd.DataFrame({"state": [1], "solid_fraction": [0.7]})
    table, said = beside_forms(states, FIRST, LAW, ONSET, SAMPLE._replace(limit=2e-3), SETTINGS)
    assert len(table) == 0 and "no form has a way to go" in said[0]


def test_a_law_needs_three_rising_states():
    strain = np.array([0.01, 0.02, 0.03])
    law = pooled_law([(strain[:2], 2e9 * strain[:2]), (strain[2:], 2e9 * strain[2:])])
    assert (law.modulus, law.exponent) == pytest.approx((2e9, 1.0))
    with pytest.raises(FitError, match="2 loaded states"):
        fitted_law(strain[:2], strain[:2])
    with pytest.raises(FitError, match="does not rise"):
        fitted_law(strain, 1.0 / strain)
