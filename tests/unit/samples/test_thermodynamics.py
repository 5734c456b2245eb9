"""Every form of the crushing model on a path whose elastic law is known."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.config.crushing import Thermodynamics
from branchcrush.crushing.curves import LinearCurve
from branchcrush.crushing.forms import ModelForm
from branchcrush.energy.fit import EnergySplitFit
from branchcrush.gradings.forms import fractal, uniform
from branchcrush.gradings.mixtures import single
from branchcrush.packings.contact_laws import LinearContact
from branchcrush.samples import thermodynamics
from branchcrush.samples.crushing_model import crushing_model
from branchcrush.samples.elastic_law import measured_elasticity
from branchcrush.samples.forms_of_sample import forms_of
from branchcrush.samples.thermodynamics import crushing_results
from branchcrush.statistics.intervals import Interval

JAMMING, MODULUS, EXPONENT, LAST = 0.64, 300e6, 1.5, 0.74
LARGEST = 1 - JAMMING / LAST
INITIAL, LAW = uniform(1e-4, 1e-3), LinearContact(1e6)
FIT = replace(
    EnergySplitFit.without("-"),
    reason=None,
    exponent=Interval(3.0, 2.9, 3.1),
    reference_length=9e-4,
)
NUMBERS = pd.DataFrame({"state": 1, "mean_radius_m": [1e-4, 1e-3], "contact_number": [6.0, 6.0]})
HISTORY = ("stress", np.array([1e5, 2e6, 0.0, 5e6]))
FORMS = ["moving_jamming", "paper", "density", "measured_contacts", "einav", "tengattini"]


def path_to(last):
    """Return a path with the energy of A eps^m exactly, per volume at jamming."""
    phi = np.array([0.16, 0.55, *np.linspace(0.57, last, 15)])
    strain = np.maximum(1 - JAMMING / phi, 0.0)
    energy = MODULUS / (EXPONENT + 1) * strain ** (EXPONENT + 1)
    volume = 1e-6 / phi
    return pd.DataFrame(
        {
            "state": range(phi.size),
            "leg": "loading",
            "solid_fraction": phi,
            "volume_m3": volume,
            "elastic_energy_J": energy * volume * phi / JAMMING,
            "mean_stress_Pa": MODULUS * strain**EXPONENT,
            "work_J": energy * volume * phi / JAMMING,
            "carries_load": energy > 0,
        }
    )


def settings(**keys):
    return Thermodynamics(**keys).model_dump()


def results(fit=FIT, initial=INITIAL):
    # The other seed went further.
    paths = [path_to(LAST), path_to(0.80)]
    certificate = pd.concat(
        [path.assign(seed=k, certified=True) for k, path in enumerate(paths)], ignore_index=True
    )
    certificate.loc[certificate.index[-1], "certified"] = False
    jamming = pd.DataFrame({"jamming_solid_fraction_loading": [JAMMING, JAMMING]})
    return crushing_results(
        fit, certificate, paths, initial, LAW, NUMBERS, settings(), jamming, HISTORY
    )


@pytest.fixture(scope="module")
def forms():
    ultimate = fractal(1e-4, 1e-3, 2.6)
    return forms_of(INITIAL, ultimate, 3.0, LAW, NUMBERS, settings())


@pytest.fixture(scope="module")
def made(forms):
    with pytest.MonkeyPatch.context() as patch:  # they take most of the time
        patch.setattr(thermodynamics, "forms_of", lambda *asked: forms)
        return results()


def model(forms, **keys):
    measured = measured_elasticity([path_to(LAST)])
    return crushing_model(forms, measured, FIT.exponent, 9e-4, LAW, settings(**keys))[:3]


@pytest.fixture(scope="module")
def strained(forms):
    return model(forms, resistance="elastic_strain", form="paper")


def of(table, form, path=None):
    rows = table[table["form"] == form]
    return rows if path is None else rows[rows["path"] == path]


def test_every_form_is_there_in_its_order(made):
    curves, table, summary = made[:3]
    assert list(summary["forms"]) == FORMS
    assert list(curves["form"].unique()) == list(table["form"].unique()) == FORMS
    assert all(form["reason"] is None for form in summary["forms"].values())


def test_work_is_stored_or_dissipated_and_crushing_never_heals(made, strained):
    for curves in (made[0], strained[0]):
        for _, path in curves[curves["path"] == "crushing"].groupby("form"):
            kept = path["free_energy_J_per_m3"] + path["dissipated_J_per_m3"]
            most = path["work_J_per_m3"].max()
            assert_allclose(path["work_J_per_m3"], kept, rtol=1e-10, atol=1e-10 * most)
            assert (np.diff(path["crushing"]) >= 0).all()


# --- the paper's form by hand --------------------------------------------------------------------


def moment(power, low=1e-4, high=1e-3):
    """Return <R^k> of radii that are uniform by number."""
    return (high ** (power + 1) - low ** (power + 1)) / ((power + 1) * (high - low))


# <l^3> = 2 <R^3> + 6 <R> <R^2> of two radii drawn alike.
CUBE_OF_LENGTH = 2 * moment(3) + 6 * moment(1) * moment(2)


def test_the_law_is_that_of_the_certified_seeds_alone(made):
    _, _, summary = made[:3]
    assert_allclose(summary["elastic_modulus_Pa"], MODULUS, rtol=1e-3)
    assert_allclose(summary["largest_strain"], LARGEST, rtol=1e-5)
    assert_allclose(summary["initial_moment"], CUBE_OF_LENGTH, rtol=1e-9)
    assert_allclose(summary["theta"], 1 - summary["ultimate_moment"] / CUBE_OF_LENGTH, rtol=1e-9)
    assert 0.9 < summary["theta"] < 1


def test_reference_energy_is_that_of_the_initial_grading_in_the_paper_form(made):
    curves, _, _ = made[:3]
    paper = of(curves, "paper")
    expected = paper["elastic_energy_J_per_m3"] * 9e-4**3 / CUBE_OF_LENGTH
    assert_allclose(paper["reference_energy_J_per_m3"], expected, rtol=1e-9)
    assert of(curves, "moving_jamming")["reference_energy_J_per_m3"].isna().all()


def test_stress_at_fixed_crushing_is_what_is_left_of_the_elastic_one(made):
    curves, _, summary = made[:3]
    fixed = of(curves, "paper", "fixed")
    assert sorted(fixed["crushing"].unique()) == [0.0, 0.25, 0.5, 0.75, 1.0]
    strain, left = fixed["volumetric_strain"], 1 - summary["theta"] * fixed["crushing"]
    assert_allclose(fixed["stress_Pa"], left * MODULUS * strain**1.5, rtol=1e-3, atol=1.0)
    stiffness = 1.5 * left * MODULUS * strain**0.5
    assert_allclose(fixed["tangent_stiffness_Pa"], stiffness, rtol=1e-3, atol=1.0)
    force = summary["theta"] * MODULUS / 2.5 * strain**2.5
    assert_allclose(fixed["driving_force_J_per_m3"], force, rtol=1e-3, atol=1.0)
    assert_allclose(strain.max(), LARGEST, rtol=1e-5)


def test_crushing_begins_where_the_released_energy_meets_the_critical_one(made):
    curves, _, summary = made[:3]
    paper = summary["forms"]["paper"]
    # theta A eps^(m+1)/(m+1) = E_c0.
    strain = (2.5 * 2e5 / (summary["theta"] * MODULUS)) ** (1 / 2.5)
    assert_allclose(paper["yield_strain"], strain, rtol=1e-3)
    assert_allclose(paper["yield_stress_Pa"], MODULUS * strain**1.5, rtol=1e-3)
    # At the largest strain (1 - C)^2 theta Psi_0 = E_c0.
    energy = MODULUS / 2.5 * LARGEST**2.5
    expected = 1 - (2e5 / (summary["theta"] * energy)) ** 0.5
    assert_allclose(paper["crushing_at_end"], expected, rtol=1e-3)
    least = summary["theta"] * (1 + 1 / 1.5)
    assert_allclose(paper["least_hardening_exponent"], least, rtol=1e-4)
    assert paper["hardens_at_onset"] and paper["snaps"] == [] and paper["admissible"]
    path = of(curves, "paper", "crushing")["volumetric_strain"].to_numpy()
    turn = int(np.argmax(path))
    assert (np.diff(path[: turn + 1]) > 0).all() and (np.diff(path[turn:]) < 0).all()
    assert_allclose([path[turn], path[-1]], [LARGEST, 0.6 * LARGEST], rtol=1e-5)


def test_a_softer_resistance_than_the_elastic_law_needs_snaps(forms):
    _, _, summary = model(alone(forms, "paper"), hardening_exponent=1.0, form="paper")
    assert summary["hardens_at_onset"] is False
    assert summary["forms"]["paper"]["snaps"] == [pytest.approx(0.0, abs=1e-6)]


# --- the moving jamming point --------------------------------------------------------------------


def test_the_moving_jamming_point_is_on_the_front_and_ends_where_mixing_does(made):
    curves, table, summary = made[:3]
    moving = summary["forms"]["moving_jamming"]
    assert (summary["form"], summary["form_reason"]) == ("moving_jamming", None)
    assert summary["inadmissible_from"] == moving["inadmissible_from"]
    assert 0.3 < moving["inadmissible_from"] < 0.6 and not summary["admissible"]
    assert moving["sentences"][0].startswith(f"From C = {moving['inadmissible_from']:.3g} on")
    path = of(curves, "moving_jamming", "crushing")
    assert path["crushing"].max() <= moving["inadmissible_from"]
    assert path["elastic_strain"].max() <= LARGEST * (1 + 1e-6)
    assert (path["plastic_work_J_per_m3"].iloc[-1] / path["dissipated_J_per_m3"].iloc[-1]) > 0.8
    rows = of(table, "moving_jamming")
    assert_allclose(rows["jamming_solid_fraction"].iloc[0], JAMMING, rtol=1e-5)
    assert rows["jamming_solid_fraction"].max() > 0.7


def test_a_limit_of_elastic_strain_is_held_and_gives_the_compression_line(strained):
    curves, table, summary = strained
    path = of(curves, "moving_jamming", "crushing")
    crushing = path[path["crushing"] > 0].iloc[:-10]
    assert_allclose(crushing["elastic_strain"], 0.0125, rtol=1e-6)
    rows = of(table, "moving_jamming")
    # Beyond the densest mixture C does not grow.
    costs = rows["driving_force_over_pressure"] < -1e-9
    assert costs.any() and rows.loc[costs, ["void_ratio", "yield_stress_Pa"]].isna().all(axis=None)
    rows = rows[~costs]
    density = rows["jamming_solid_fraction"]
    assert_allclose(rows["void_ratio"], (1 - 0.0125) / density - 1, rtol=1e-8)
    stress = rows["stiffness_ratio"] * MODULUS * 0.0125**1.5
    assert_allclose(rows["yield_stress_Pa"], stress, rtol=1e-2)
    assert summary["least_hardening_exponent"] is None


def strained_alone(forms, name, form):
    """Return summary and events of one form at a limit of the elastic strain."""
    keys = settings(resistance="elastic_strain", form=name)
    only = replace(alone(forms, name), made={name: form})
    measured = measured_elasticity([path_to(LAST)])
    return crushing_model(only, measured, FIT.exponent, 9e-4, LAW, keys)[1:]


def test_what_costs_energy_at_all_c_never_yields(forms):
    table, summary, events = strained_alone(forms, "density", ModelForm(LinearCurve(-0.2)))
    told = summary["forms"]["density"]
    assert told["inadmissible_from"] == 0.0
    assert told["yield_strain"] is told["yield_stress_Pa"] is told["hardens_at_onset"] is None
    assert not told["yields_on_path"] and told["crushing_at_end"] == 0.0
    assert table[["yield_stress_Pa", "void_ratio"]].isna().all(axis=None)
    assert events["event"].tolist() == ["lock"]


def test_what_crushes_to_the_ultimate_grading_ends_at_one_and_is_complete(forms):
    _, summary, events = strained_alone(forms, "paper", forms.made["paper"])
    assert summary["crushing_at_end"] == 1.0
    assert events["event"].iloc[-1] == "complete"
    assert events["crushing"].iloc[-1] == events["crushing_after"].iloc[-1] == 1.0
    # g falls at a strain that is held.
    assert summary["hardens_at_onset"] is False and summary["forms"]["paper"]["snaps"]


def test_energies_beside_each_other(made):
    _, table, _ = made[:3]
    for form in FORMS:
        rows = of(table, form)
        ratio = rows["stiffness_ratio"]
        assert_allclose(rows["energy_at_equal_strain"], ratio, rtol=1e-12)
        assert_allclose(rows["energy_at_equal_stress"], ratio ** (-1 / 1.5), rtol=1e-3)
        first = rows.filter(like="energy_at").iloc[0]
        assert_allclose(first, 1.0, rtol=1e-9)


def test_equal_contacts_of_all_grains_are_no_contacts(made):
    _, table, _ = made[:3]
    with_contacts = of(table, "measured_contacts")["stiffness_ratio"]
    assert_allclose(with_contacts, of(table, "density")["stiffness_ratio"], rtol=1e-2)


# --- what there is none of -----------------------------------------------------------------------


def alone(forms, name):
    missing = {other: "not asked for" for other in FORMS if other != name}
    return replace(forms, made={name: forms.made[name]}, missing=missing)


def test_resistance_beyond_the_path_is_never_reached(forms):
    curves, _, summary = model(alone(forms, "moving_jamming"), critical_energy=1e14)
    assert not summary["yields_on_path"] and summary["crushing_at_end"] == 0.0
    assert (curves.loc[curves["path"] == "crushing", "crushing"] == 0).all()


def test_a_form_on_the_front_that_is_not_there_says_why_and_no_other_is_lost(forms):
    curves, table, summary = model(alone(forms, "einav"), form="paper")
    assert summary["form_reason"] == summary["forms"]["paper"]["reason"] == "not asked for"
    assert summary["yield_strain"] is summary["admissible"] is None
    assert set(curves["form"]) == set(table["form"]) == {"einav"}
    # Every form tells the same, there or not.
    (keys,) = {tuple(form) for form in summary["forms"].values()}
    assert summary["forms"]["paper"]["sentences"] == [] and "theta" in keys


@pytest.mark.parametrize(
    ("fit", "initial", "why"),
    [
        (EnergySplitFit.without("branches of one length"), INITIAL, "branches of one length"),
        (FIT, single(1e-3), "grains of a single size have no finer grading"),
    ],
)
def test_without_data_there_is_a_reason(fit, initial, why):
    curves, table, summary = results(fit=fit, initial=initial)[:3]
    assert curves == table and list(curves) == list(summary) == ["reason"]
    assert summary["reason"].startswith(why)


# --- own histories, bands, and what rearrangement takes -------------------------------------------


def test_every_form_follows_the_history_of_the_user(made):
    for name in FORMS:
        rows = of(made.curves, name, "history")
        assert_allclose(rows["stress_Pa"], HISTORY[1], rtol=1e-9, atol=1e-3)
        kept = rows["free_energy_J_per_m3"] + rows["dissipated_J_per_m3"]
        most = rows["work_J_per_m3"].max()
        assert_allclose(rows["work_J_per_m3"], kept, atol=1e-10 * most)
    assert set(made.events["path"]) == {"crushing", "history"}
    assert set(made.events["event"]) <= {"yield", "jump", "complete", "lock"}


def test_one_packing_has_no_bands_and_says_so(made):
    assert made.curves.filter(regex="_(low|high)_").isna().all(axis=None)
    # n has an interval, but the form on the front does not hold it.
    assert made.summary["bands"].startswith("The curves have no bands")


def test_nothing_is_taken_where_the_stress_is_that_of_the_law(made):
    assert_allclose(made.elastic["law_stress_Pa"], made.elastic["mean_stress_Pa"], rtol=1e-6)
    assert_allclose(made.elastic["dissipated_J_per_m3"], 0.0, atol=1e-3)
    assert "gives back dΨ₀/dε, 100 %" in made.summary["rearrangement"]
    assert made.summary["jamming_solid_fraction"] == JAMMING
