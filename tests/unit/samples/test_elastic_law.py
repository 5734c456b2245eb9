"""The elastic law of paths whose law is known, and what rearrangement takes of their stress."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.errors import FitError
from branchcrush.samples.elastic_law import certified_jamming, measured_elasticity
from branchcrush.samples.rearrangement import elastic_law_table, rearrangement_sentence
from branchcrush.samples.thermodynamics import bands_sentence
from branchcrush.statistics.intervals import Interval

JAMMING, MODULUS, EXPONENT = 0.64, 300e6, 1.5
DENSE = np.linspace(0.66, 0.74, 30)
LOSS = 0.25  # of the stress that is stored, in rearrangement
KNOWN = Interval(JAMMING, 0.638, 0.642)


def path_of(jamming=JAMMING, exponent=EXPONENT, solid_fraction=DENSE):
    """Return a path with the energy of A eps^m exactly, and work that loses a share to it."""
    phi = np.append([0.16, 0.55], solid_fraction)
    strain = np.maximum(1 - jamming / phi, 0.0)
    stored = MODULUS / (exponent + 1) * strain ** (exponent + 1)  # per volume at jamming
    at_jamming = 1e-6 / jamming
    return pd.DataFrame(
        {
            "state": range(phi.size),
            "solid_fraction": phi,
            "volume_m3": 1e-6 / phi,
            "mean_stress_Pa": (1 + LOSS) * MODULUS * strain**exponent,
            "elastic_energy_J": stored * at_jamming,
            "work_J": (1 + LOSS) * stored * at_jamming,
        }
    )


def test_strains_count_from_the_jamming_point_of_the_certificate():
    found = measured_elasticity([path_of()] * 3, KNOWN)
    assert found.jamming == JAMMING
    assert_allclose([found.law.modulus, found.law.exponent], [MODULUS, EXPONENT], rtol=1e-9)
    assert_allclose(found.free[:2], [JAMMING, EXPONENT], rtol=1e-5)
    assert found.r_squared == pytest.approx(1.0, abs=1e-12)
    assert found.sentences[0].startswith(
        "Strains count from φ_J = 0.6400 ± 0.0020 of 3 packings by their stress: R² of the "
        "energies is 1.0000; fitted to the energies alone it would be 0.6400, with m = 1.50"
    )


def test_another_jamming_point_changes_the_exponent_and_the_fit_says_so():
    found = measured_elasticity([path_of()], Interval(0.65, np.nan, np.nan))
    assert found.jamming == 0.65
    assert found.law.exponent < 1.4
    assert found.r_squared < found.free[2]
    assert "φ_J = 0.6500 of 1 packing by its" not in found.sentences[0]
    assert "φ_J = 0.6500 of 1 packing by" in found.sentences[0]


@pytest.mark.parametrize(
    ("certified", "reason"),
    [
        (Interval(np.nan, np.nan, np.nan), "the certificate has no φ_J"),
        (Interval(0.739, 0.738, 0.74), "from that of the certificate, 0.7390, there is no law"),
    ],
)
def test_the_free_fit_is_the_fallback(certified, reason):
    found = measured_elasticity([path_of()], certified)
    assert_allclose([found.jamming, found.law.exponent], [JAMMING, EXPONENT], rtol=1e-5)
    assert found.ends == {}
    assert found.sentences[0].startswith(
        f"φ_J of the elastic law is fitted to the energies, 0.6400: {reason}"
    )


@pytest.mark.parametrize(
    ("kind", "exponent"),
    [("linear", 1.0), ("hertz", 1.5), ("pressure_dependent", 1 / (1 - 0.5)), ("power_law", 1.8)],
)
def test_the_kind_fixes_the_exponent(kind, exponent):
    found = measured_elasticity([path_of(exponent=exponent)], KNOWN, kind=kind)
    assert_allclose([found.law.modulus, found.law.exponent], [MODULUS, exponent], rtol=1e-8)
    summary = found.summary()
    # K = m A^(1/m) p^(1 - 1/m) at the reference pressure of 100 kPa.
    stiffness = exponent * MODULUS ** (1 / exponent) * 1e5 ** (1 - 1 / exponent)
    assert summary["modulus_at_reference_pressure_Pa"] == pytest.approx(stiffness, rel=1e-7)
    assert (summary["elasticity"], summary["elastic_exponent"]) == (kind, found.law.exponent)


def test_the_measured_law_goes_through_the_mean_of_the_states():
    found = measured_elasticity([path_of(), path_of()], KNOWN, kind="measured")
    strain = np.array([0.01, 0.05, 0.1])
    assert_allclose(found.law.pressure(strain), MODULUS * strain**EXPONENT, rtol=1e-9)
    assert (found.summary()["elastic_modulus_Pa"], found.summary()["elastic_exponent"]) == (
        None,
        None,
    )
    assert "goes through the mean energy of 30 states" in found.sentences[1]
    assert "rest on no packing" in found.sentences[1]


def test_the_limits_of_jamming_have_laws_of_their_own():
    found = measured_elasticity([path_of()], KNOWN)
    low, high = found.ends["low"], found.ends["high"]
    assert found.ends_without_law == {}
    # From a looser jamming point the same energy belongs to a larger strain.
    assert low.pressure(0.1) < found.law.pressure(0.1) < high.pressure(0.1)


@pytest.mark.parametrize(
    ("limits", "words"),
    [
        # States of four strains: from 0.739 on too few of them are left.
        ((0.64, 0.739), "at the lower end of the interval of φ_J; from the upper end, 0.7390, th"),
        ((0.738, 0.739), "between 0.7380 and 0.7390, but from neither end is there an elastic law"),
        ((0.63, 0.65), "at both ends of the interval of φ_J, one at a time; n is not in the form"),
        ((np.nan, np.nan), "no interval of φ_J or n is known"),
    ],
)
def test_ends_of_jamming_without_a_law_are_told_and_no_band_is_said_to_rest_on_them(limits, words):
    found = measured_elasticity([path_of()], Interval(JAMMING, *limits))
    assert words in bands_sentence(found, False, "einav")
    assert set(found.ends_without_law.values()) == {
        limit for limit in limits if limit in (0.738, 0.739)
    }
    if set(limits) == {0.64, 0.739}:
        both = bands_sentence(found, True, "paper")
        assert "interval of φ_J and both of that of n, one at a time; from the upper end" in both


def test_too_few_states():
    with pytest.raises(FitError, match="in the loading path: of all packings 3 states"):
        measured_elasticity([path_of(solid_fraction=DENSE[:3])], KNOWN)


@pytest.mark.parametrize("phi", [[0.4, 0.5, 0.6], [0.66, 0.68]])
def test_path_that_carries_load_in_too_few_states_is_no_data(phi):
    with pytest.raises(FitError, match="no elastic law in the loading path"):
        measured_elasticity([path_of(solid_fraction=phi)])


def test_it_is_known_up_to_the_densest_state_of_any_seed():
    found = measured_elasticity([path_of(solid_fraction=DENSE[:20]), path_of()], KNOWN)
    assert found.largest == pytest.approx(1 - JAMMING / 0.74, rel=1e-12)
    assert found.on_path


def test_the_interval_is_that_of_the_packings_used():
    jamming = pd.DataFrame({"jamming_solid_fraction_loading": [0.60, 0.62, 0.64, 0.9, np.nan]})
    found = certified_jamming(jamming, [0, 1, 2, 4])
    # Student's t of two degrees of freedom is 4.302653; the standard error 0.02/sqrt(3).
    assert_allclose(found, [0.62, 0.62 - 0.0496828, 0.62 + 0.0496828], atol=1e-6)
    assert certified_jamming(jamming, [3])[0] == 0.9
    assert np.isnan(certified_jamming(jamming, [4])).all()


def test_stress_is_what_the_law_gives_back_and_what_rearrangement_takes():
    paths = [path_of()] * 2
    table = elastic_law_table(paths, measured_elasticity(paths, KNOWN))
    assert len(table) == 30
    whole = table["law_stress_Pa"] + table["misfit_stress_Pa"] + table["rearrangement_stress_Pa"]
    assert_allclose(whole, table["mean_stress_Pa"], rtol=1e-12)
    inner = table[2:-1]
    taken = inner["rearrangement_stress_Pa"] / inner["mean_stress_Pa"]
    assert_allclose(taken, LOSS / (1 + LOSS), atol=0.01)
    assert_allclose(inner["misfit_stress_Pa"] / inner["mean_stress_Pa"], 0.0, atol=0.01)
    assert_allclose(
        table["elastic_energy_J_per_m3"] + table["dissipated_J_per_m3"], table["work_J_per_m3"]
    )
    assert_allclose(table["dissipated_J_per_m3"] / table["work_J_per_m3"], LOSS / (1 + LOSS))
    sentence = rearrangement_sentence(table)
    assert "gives back dΨ₀/dε, 80 % beyond a strain of 0.08 and 80 % nearer to jamming" in sentence
    assert "is lost: 20.0 % of the work" in sentence
    assert "above 100 %" not in sentence


@pytest.mark.parametrize(
    ("states", "words"),
    [
        (1, "own energies 1 loaded state is too few."),
        (4, "own energies 4 loaded states are too few."),
        (5, "the states themselves give back −dE/dV, 75 to 130 %, above 100 % where states are"),
    ],
)
def test_slopes_of_too_few_states_are_left_out(states, words):
    table = pd.DataFrame(
        {
            "volumetric_strain": [0.01, 0.02, 0.03, 0.05, 0.07][:states],
            "mean_stress_Pa": 1e6,
            "law_stress_Pa": 0.9e6,
            # The first and the last rest on one side alone.
            "energy_slope_Pa": np.array([3.6e6, 1.3e6, 0.75e6, 0.8e6, 2e6])[:states],
            "work_J_per_m3": 2.0,
            "dissipated_J_per_m3": 0.5,
        }
    )
    sentence = rearrangement_sentence(table)
    assert words in sentence
    # No half of the strains is told of where there is no other.
    assert "dΨ₀/dε, 90 %; " in sentence
    assert "360" not in sentence and "25.0 % of the work" in sentence
    above = rearrangement_sentence(table.assign(law_stress_Pa=1.2e6))
    assert "dΨ₀/dε, 120 %, above 100 % where it misses the states; " in above
