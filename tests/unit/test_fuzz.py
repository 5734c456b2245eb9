"""Damaged files: every reader gives an error in words or a sound result, and nothing else.

`python -m benchmarks fuzz` reads 100 000 of them, by a seeded generator; here Hypothesis chooses,
and reduces what it finds.
"""

import signal
import tempfile

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from benchmarks import fuzz
from benchmarks.fuzz import outcome
from benchmarks.fuzz_readers import readers
from benchmarks.mutations import mutated

# Readers that are alike share their examples.
KINDS = sorted({name.partition(".")[0] for name in readers()})


@pytest.mark.parametrize("name", sorted(readers()))
def test_the_sound_file_is_sound(name, tmp_path):
    assert outcome(name, readers()[name].data, tmp_path) == ("sound", "")


@pytest.mark.parametrize("kind", KINDS)
@settings(max_examples=25, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_a_damaged_file_is_read_or_refused_in_words(kind, data):
    name = data.draw(st.sampled_from([n for n in readers() if n.partition(".")[0] == kind]))
    rng = data.draw(st.randoms(use_true_random=False))
    content = mutated(rng, readers()[name].data)
    with tempfile.TemporaryDirectory() as folder:
        found, fault = outcome(name, content, folder)
    assert (found == "fault", fault) == (False, "")


@pytest.mark.parametrize("number", [1221, 1786])
def test_brackets_that_are_never_closed_are_read_once(number, monkeypatch):
    # A search that begins anew at each of them took more than ten seconds of a processor.
    before = signal.signal(signal.SIGPROF, fuzz._too_slow)
    try:
        _, faults, _, _ = fuzz._read_chunk("compression", 1, number, number + 1)
    finally:
        signal.signal(signal.SIGPROF, before)
    assert faults == []
