"""What is kept of the contacts of the seeds, and in which order they are read."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tests.unit.samples.drawn_contacts import STATES, growing_sample


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
