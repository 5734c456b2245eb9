"""What is kept of the contacts of the seeds, and in which order they are read."""

import numpy as np
import pandas as pd
import pytest
from numpy.testing import assert_allclose

from branchcrush.gradings.forms import uniform
from branchcrush.samples.seed_contacts import sample_classes, sample_contacts
from tests.unit.samples.drawn_contacts import NO_WALLS, STATES, contact_table, growing_sample


@pytest.fixture(scope="module")
def growing():
    return growing_sample()


def test_classes_reach_from_one_end_of_the_grading_to_the_other(growing):
    *_, classes = growing
    assert (classes[0], classes[-1]) == (1.0, 20.0)
    assert np.all(np.diff(classes) > 0)
    assert 5 <= classes.size <= 11


def test_lengths_of_the_last_state_are_kept_branch_by_branch(growing):
    packings, kept, _ = growing
    for (radii, contacts), seed in zip(packings, kept, strict=True):
        last = contacts[contacts["state"] == STATES[-1]]
        assert_allclose(seed.length, radii[last["i"]] + radii[last["j"]], rtol=1e-15)
        assert seed.lengths.sum(axis=1).tolist() == [3000, 3000]


def test_classes_are_those_of_the_last_state_of_the_first_seed():
    # 21 radii; weight of a grain 1/21, and its share of the ends of contacts. In the last state
    # the two largest hold all of these: half of the weight.
    radii = np.arange(1.0, 22.0)
    first = contact_table(0, np.arange(0, 20), np.arange(1, 21))
    last = contact_table(3, np.array([19]), np.array([20]))
    tables = [
        pd.concat([first, last], ignore_index=True),
        pd.concat([last.assign(state=0), first.assign(state=3)], ignore_index=True),
    ]
    read = []

    def read_seed(number):
        read.append(number)
        return radii, tables[number], NO_WALLS

    _, classes = sample_contacts(uniform(1.0, 21.0), read_seed, [0, 1], [0, 3])
    assert read == [0, 1]
    # Ten classes of 0.2: that is 4.2 grains without contacts; the other ends are with the largest.
    assert classes.tolist() == [1.0, 5.0, 9.0, 13.0, 17.0, 20.0, 21.0]


def test_classes_stay_within_the_grading():
    radii = np.arange(1.0, 21.0)
    table = contact_table(0, np.arange(0, 19), np.arange(1, 20))
    classes = sample_classes(uniform(8.0, 13.0), radii, table, NO_WALLS, 0)
    assert (classes[0], classes[-1]) == (8.0, 13.0)
    assert (np.diff(classes) > 0).all()
