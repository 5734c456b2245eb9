"""Whatever is configured is taken, or refused in words."""

from copy import deepcopy

from hypothesis import given, settings
from hypothesis import strategies as st

from branchcrush.config.checks import checked_study
from branchcrush.errors import ConfigError
from tests.unit.config.studies import INTERNALS, STUDY

# --- anything ------------------------------------------------------------------------------------


def paths(value, path=()):
    """Return the paths of all keys and items below a value."""
    items = value.items() if isinstance(value, dict) else enumerate(value)
    for key, item in items:
        yield (*path, key)
        if isinstance(item, (dict, list)):
            yield from paths(item, (*path, key))


ODD = [None, True, False, 0, -1, 1, 2, 0.5, 1e-300, 1e300, 10**400, -(10**30), 1e9, 2**63]
ODD += [float("nan"), float("inf"), "", "nan", "1e6", "-1", "text", "1,5", "a b/../c", "\0", "é"]
ODD += [[], [1], [None], [[]], [1, 1], {}, {"a": 1}, {1: None}, {"form": "single"}, {"law": None}]
# Not every text there is: the words looked for below must not be the input's.
text = st.text("ab1é/. \n\x1e{", max_size=8)
anything = st.sampled_from(ODD) | st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | text,
    lambda below: st.lists(below, max_size=3) | st.dictionaries(text, below),
    max_leaves=5,
)


@st.composite
def mutated(draw):
    """Return the study with one to three of its keys replaced, misspelt or left out."""
    raw = deepcopy(STUDY)
    for _ in range(draw(st.integers(1, 3))):
        here = raw
        *sections, last = draw(st.sampled_from(list(paths(STUDY))))
        try:
            for key in sections:
                here = here[key]
            here[last]
        except (KeyError, IndexError, TypeError):
            continue  # changed before
        what = draw(st.sampled_from(["replace", "replace", "misspell", "delete"]))
        if what == "replace" or not isinstance(here, dict):
            if isinstance(here, (dict, list)):
                here[last] = draw(anything)
        elif what == "misspell":
            here[f"{last}x"] = here.pop(last)
        else:
            del here[last]
    return raw


@given(mutated())
@settings(max_examples=300, deadline=None)
def test_any_configuration_is_taken_or_refused_in_words(raw):
    before = repr(raw)
    try:
        checked_study(raw)
    except ConfigError as error:
        for line in str(error).split("\n"):
            assert line.startswith("config: "), line
            assert not [word for word in INTERNALS if word in line], line
    assert repr(raw) == before
