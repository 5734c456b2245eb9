"""The seeds of a sample together: which states and which of the seeds a fit may use."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.errors import FitError
from branchcrush.samples.ensemble import (
    certified_loading,
    end_of_loading,
    mean_path,
    on_the_way_in,
    stacked,
)


def path_of(carries_load, solid_fraction=0.7):
    states = np.arange(len(carries_load))
    return pd.DataFrame(
        {
            "state": states,
            "leg": "loading",
            "solid_fraction": solid_fraction + 0.01 * states,
            "carries_load": carries_load,
        }
    )


def certificate_of(*seeds):
    """Return a `certificate.csv`: a word for each seed, of c certified and n not, u unloading."""
    rows = [
        {
            "seed": seed,
            "state": state,
            "leg": "unloading" if letter == "u" else "loading",
            "certified": letter in "cu",
        }
        for seed, letters in enumerate(seeds, start=3)
        for state, letter in enumerate(letters)
    ]
    return pd.DataFrame(rows)


def paths_of(seeds, states=4):
    return [path_of([False] + [True] * (states - 1), 0.7 + 0.01 * seed) for seed in range(seeds)]


def states_in(tables):
    return [sorted(set(table["state"])) for table in tables]


def test_certified_states_of_all_seeds_are_used():
    used, paths = certified_loading(certificate_of("nccc", "nccc"), paths_of(2))
    assert used == [0, 1]
    assert states_in(paths) == [[1, 2, 3]] * 2
    assert paths[0].index.tolist() == [0, 1, 2]


def test_state_that_is_not_certified_in_one_seed_is_left_out_of_all():
    used, paths = certified_loading(certificate_of("nccc", "nncc"), paths_of(2))
    assert used == [0, 1]
    assert states_in(paths) == [[2, 3]] * 2


def test_seed_that_is_not_certified_at_its_end_is_dropped_and_its_states_do_not_count():
    used, paths = certified_loading(certificate_of("nccc", "nncn", "nccc"), paths_of(3))
    assert used == [0, 2]
    assert states_in(paths) == [[1, 2, 3]] * 2
    assert [path["solid_fraction"].iloc[0] for path in paths] == pytest.approx([0.71, 0.73])


def test_seed_that_stopped_on_the_way_is_dropped():
    paths = paths_of(2)
    used, _ = certified_loading(certificate_of("nccc", "ncc"), [paths[0], paths[1][:3]])
    assert used == [0]


def test_states_on_the_way_back_are_left_out():
    paths = paths_of(1, states=5)
    paths[0].loc[3:, "leg"] = "unloading"
    used, paths = certified_loading(certificate_of("nccuu"), paths)
    assert used == [0]
    assert states_in(paths) == [[1, 2]]


def test_only_the_first_seeds_of_a_certificate_may_be_asked_for():
    used, _ = certified_loading(certificate_of("nccc", "nncc", "nccn"), paths_of(2))
    assert used == [0, 1]


def test_sample_without_a_certified_end_is_no_data_and_says_how_far_it_came():
    paths = paths_of(2)
    paths[1]["carries_load"] = False
    with pytest.raises(FitError) as refused:
        certified_loading(certificate_of("nccn", "nnnn"), paths)
    # The mean of 0.73 and 0.74.
    assert str(refused.value) == (
        "no packing is certified at the end of its loading: 1 of 2 carry load there, at a solid "
        "fraction of 0.7350"
    )


def test_end_of_the_loading_is_before_the_way_back():
    path = path_of([True] * 4)
    assert end_of_loading(path)["state"] == 3
    path.loc[2:, "leg"] = "unloading"
    assert end_of_loading(path)["state"] == 1


def test_way_in_keeps_the_states_before_any_load():
    paths = paths_of(3)
    for path in paths:
        path.loc[3, "leg"] = "unloading"
    assert states_in(on_the_way_in(paths, [0, 2])) == [[0, 1, 2]] * 2


def test_stacked_paths_keep_their_seeds_apart():
    together = stacked([path_of([True, True]), path_of([True, True], 0.8)])
    assert together["seed_number"].tolist() == [0, 0, 1, 1]
    assert together["solid_fraction"].tolist() == [0.7, 0.71, 0.8, 0.81]
    assert together.index.tolist() == [0, 1, 2, 3]


def test_mean_path_has_a_row_a_state_with_the_means_of_the_seeds():
    paths = [
        pd.DataFrame(
            {
                "state": [4, 9],
                "solid_fraction": [0.66 + shift, 0.70 + shift],
                "mean_stress_Pa": [1e4 * factor, 5e4 * factor],
                "leg": "loading",
            }
        )
        for shift, factor in ((0.0, 1.0), (0.02, 2.0), (0.01, 3.0))
    ]
    found = mean_path(paths, 0.65)
    assert found.columns.tolist() == [
        "state",
        "solid_fraction",
        "solid_fraction_above_jamming",
        "mean_stress_Pa",
    ]
    assert found["state"].tolist() == [4, 9]
    assert_allclose(found["solid_fraction"], [0.67, 0.71], rtol=1e-12)
    assert_allclose(found["solid_fraction_above_jamming"], [0.02, 0.06], rtol=1e-9)
    assert_allclose(found["mean_stress_Pa"], [2e4, 1e5], rtol=1e-12)
    assert_allclose(mean_path(paths[::-1], 0.65), found, rtol=1e-12)
