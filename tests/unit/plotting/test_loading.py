"""The loading path: lines against the tables of its seeds."""

import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.plotting import loading

pytestmark = pytest.mark.filterwarnings("error")


def seeds(unloading=False):
    """Two seeds, the second 0.02 denser and of twice the stress and energies."""
    states = (0.5, 0.6, 0.7) + ((0.65,) if unloading else ())
    rows = [
        {
            "state": state,
            "seed_number": number,
            "leg": "unloading" if state == 3 else "loading",
            "solid_fraction": phi + 0.02 * number,
            "mean_stress_Pa": 1e6 * state * (1 + number),
            "volume_m3": 2.0,
            "work_J": 8e6 * state * (1 + number),
            "elastic_energy_J": 4e6 * state * (1 + number),
            "dissipated_J": 2e6 * state * (1 + number),
            "coordination_number": 4.0 + state + number,
            "mechanical_coordination_number": 6.0 + state + number,
            "rattler_fraction": 0.1 * (1 + number),
            "carries_load": state > 0,
        }
        for number in range(2)
        for state, phi in enumerate(states)
    ]
    return pd.DataFrame(rows)


PHI = [0.51, 0.61, 0.71]


def test_stress_of_every_seed_and_its_mean_is_in_megapascal(shown):
    ax = loading.plot_mean_stress(seeds())
    assert_allclose(shown.line(ax, "each seed"), [[0.5, 0.6, 0.7], [0, 1, 2]])
    assert_allclose(shown.points(ax.lines[1]), [[0.52, 0.62, 0.72], [0, 2, 4]])
    assert_allclose(shown.line(ax, "mean of seeds"), [PHI, [0, 1.5, 3]])


def test_way_back_is_marked(shown):
    ax = loading.plot_mean_stress(seeds(unloading=True))
    assert_allclose(shown.line(ax, "unloading, mean"), [[0.66], [4.5]])


def test_energies_are_per_volume_and_means_of_the_seeds(shown):
    ax = loading.plot_energy_balance(seeds())
    for label, scale in (
        ("work on the boundary", 4.0),
        ("stored, elastic", 2.0),
        ("dissipated by rearrangement", 1.0),
    ):
        assert_allclose(shown.line(ax, label), [PHI[1:], [1.5 * scale, 3.0 * scale]])


def test_coordination_is_that_of_loaded_states(shown):
    ax = loading.plot_coordination(seeds())
    assert_allclose(shown.line(ax, r"$\kappa$ of all grains"), [PHI[1:], [5.5, 6.5]])
    assert_allclose(shown.line(ax, r"$\kappa^*$ without rattlers"), [PHI[1:], [7.5, 8.5]])
    (right,) = (other for other in ax.figure.axes if other is not ax)
    assert_allclose(shown.points(right.lines[0]), [PHI[1:], [15.0, 15.0]])


def test_one_loaded_state_has_an_axis_of_some_width():
    table = seeds()
    table["carries_load"] = table["state"] == 2
    low, high = loading.plot_coordination(table).get_xlim()
    assert high - low > 0.049 and low < 0.71 < high


def test_elastic_energy_and_its_law_are_per_volume_at_jamming(shown):
    jamming = 0.58
    model = {
        "jamming_solid_fraction": jamming,
        "elastic_modulus_Pa": 3e8,
        "elastic_exponent": 2.0,
        "elastic_r_squared": 0.99,
    }
    path = seeds(unloading=True)
    ax = loading.plot_elastic_law(path, model)
    strain, density = shown.line(ax, "each seed")
    # State 2 of both seeds, and the states 1: the first is far below jamming, the last unloads.
    phi = [0.6, 0.7, 0.62, 0.72]
    assert_allclose(strain, [100 * (1 - jamming / one) for one in phi])
    energy = [2.0, 4.0, 4.0, 8.0]  # per present volume [MJ/m3]
    assert_allclose(density, [e * jamming / one for e, one in zip(energy, phi, strict=True)])
    line, law = shown.points(ax.lines[1])
    # A eps^3/3 with A = 300 MPa: 0.1 MJ/m3 at 10 %.
    assert law[-1] == pytest.approx(100.0 * (1 - jamming / 0.72) ** 3)
    assert line[-1] == pytest.approx(100 * (1 - jamming / 0.72))


def test_rattlers_and_the_other_lines_are_below_the_legend(shown):
    assert shown.legend_is_above(loading.plot_coordination(seeds()))


def test_energies_say_per_which_volume_they_are():
    model = {
        "jamming_solid_fraction": 0.58,
        "elastic_modulus_Pa": 3e8,
        "elastic_exponent": 2.0,
        "elastic_r_squared": 0.99,
    }
    assert "current volume" in loading.plot_energy_balance(seeds()).get_ylabel()
    assert "volume\nat jamming" in loading.plot_elastic_law(seeds(), model).get_ylabel()


def test_compression_curve_has_loaded_states_of_each_seed_and_their_mean():
    path = pd.DataFrame(
        {
            "seed_number": [0, 0, 0, 1, 1, 1],
            "state": [1, 2, 3] * 2,
            "leg": "loading",
            "carries_load": [False, True, True] * 2,
            "mean_stress_Pa": [0.0, 1e6, 4e6, 0.0, 3e6, 8e6],
            "void_ratio": [0.9, 0.6, 0.5, 0.9, 0.62, 0.54],
        }
    )
    ax = loading.plot_compression_curve(path)
    first, second, mean = ax.lines
    assert first.get_xydata().tolist() == [[1.0, 0.6], [4.0, 0.5]]
    assert second.get_xydata().tolist() == [[3.0, 0.62], [8.0, 0.54]]
    assert_allclose(mean.get_xydata(), [[2.0, 0.61], [6.0, 0.52]])
    assert ax.get_xscale() == "log"
