"""What a configuration asks of grains, files and folders; no input whatever gets past it."""

import os
from copy import deepcopy

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from branchcrush.config.build import grading_of
from branchcrush.config.checks import checked_study, sample_problems
from branchcrush.config.sample import sample_of
from branchcrush.errors import ConfigError
from branchcrush.gradings.representativity import representativity
from branchcrush.gradings.sampling import sampled_radii

SIZES = {"basis": "number", "size": "radius", "unit": "mm"}
UNIFORM = {"form": "uniform", **SIZES, "min": 0.5, "max": 1.0}
SIEVE = {"form": "sieve", "basis": "mass", "size": "diameter", "unit": "mm", "file": "sand.csv"}
SAMPLE = {
    "grading": UNIFORM,
    "sampling": "random",
    "grains": 1000,
    "allow_unrepresentative": False,
    "boundary": "walls",
    "initial_solid_fraction": 0.16,
    "contact": {"law": "linear", "normal_stiffness": 1e6},
    "loading": {"edge_reduction": 0.4, "states": 5, "quality": "draft", "unloading": True},
    "seeds": [1, 2],
    "refined_seeds": 1,
}
NORMAL = {"form": "normal", **SIZES, "min": 0.5, "max": 1, "mean": 0.7, "standard_deviation": 0.1}
OTHER = {
    **SAMPLE,
    "grading": {
        "form": "mixture",
        "basis": "mass",
        "components": [{"weight": 1, "grading": NORMAL}, {"weight": 2, "grading": UNIFORM}],
    },
    "contact": {"law": "hertz", "young_modulus": 7e10, "poisson_ratio": 0.2},
    "loading": {"mean_stress": {"from": 1e5, "to": 1e6, "states": 3}},
}
STUDY = {
    "samples": {"one": SAMPLE, "other": OTHER},
    "energy_split": {"bins": 20, "confidence": 0.95, "resamples": 2000},
    "thermodynamics": {"ultimate_alpha": 2.6, "critical_energy": 2e5, "hardening_exponent": 2.0},
    "figures": {"dpi": 300},
}
INTERNALS = ["pydantic", "http", "[key]", "type=", "<class", "function-", "Input should", "np."]
INTERNALS += ["None", "True", "False", "Error", "Section", "validator"]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def locked(monkeypatch, folder):
    """Return a function that takes all permissions from a path, also for who is allowed all."""

    def lock(name):
        asked = folder / name
        monkeypatch.setattr(os, "access", lambda path, _: (folder / path).resolve() != asked)

    return lock


def lines_of(raw):
    with pytest.raises(ConfigError) as refused:
        checked_study(raw)
    lines = str(refused.value).splitlines()
    for line in lines:
        assert line.startswith("config: ")
        assert not [word for word in INTERNALS if word in line], line
    return lines


def study_of(**keys):
    return {"samples": {"mine": {**deepcopy(SAMPLE), **keys}}}


# --- lists of grains -----------------------------------------------------------------------------


def listed(folder, **keys):
    """Return a study of a list of a hundred diameters, without grains and sampling."""
    (folder / "list.txt").write_text("\n".join(f"{1 + k % 7 / 10}" for k in range(100)))
    grading = {**SIZES, "form": "radii", "size": "diameter", "file": "list.txt"}
    sample = {**SAMPLE, "grading": grading, **keys}
    for key in {"grains", "sampling"} - set(keys):
        del sample[key]
    return {"samples": {"mine": sample}}


@pytest.mark.parametrize("keys", [{}, {"grains": 100}, {"sampling": "listed"}])
def test_a_list_is_taken_as_it_is_where_nothing_else_is_asked_for(folder, keys):
    sample = sample_of(checked_study(listed(folder, **keys)).samples["mine"].settings())
    assert (sample.grains, sample.sampling) == (100, "listed")
    radii = sampled_radii(sample.grading, sample.grains, sample.sampling, None)
    assert radii.tolist() == sorted(((1 + k % 7 / 10) * 5e-4 for k in range(100)), reverse=True)


def test_a_list_of_another_length_is_refused_with_both_ways_out(folder):
    (line,) = lines_of(listed(folder, grains=90))
    assert line.startswith("config: samples.mine.grains = 90: the list list.txt has 100; leave")
    assert "sampling: random" in line and "to draw 90 of such sizes" in line


def test_sampling_draws_from_a_list_as_many_as_are_asked_for(folder):
    settings = (
        checked_study(listed(folder, grains=90, sampling="random")).samples["mine"].settings()
    )
    sample = sample_of(settings)
    assert (sample.grains, sample.sampling) == (90, "random")
    settings = checked_study(listed(folder, sampling="random")).samples["mine"].settings()
    assert sample_of(settings).grains == 100


def test_a_list_that_is_not_there_is_named_once(folder):
    study = listed(folder)
    (folder / "list.txt").unlink()
    (line,) = lines_of(study)
    assert "list.txt': there is no such file" in line


def test_no_other_form_goes_without_a_number_or_is_taken_as_listed(folder):
    (line,) = lines_of(study_of(grains=None))
    assert line == (
        "config: samples.mine.grains = nothing: must be a whole number from 2 to 10000000"
    )
    (line,) = lines_of(study_of(sampling="listed"))
    assert line.startswith("config: samples.mine.sampling = 'listed': takes the grains of a list")


# --- grains --------------------------------------------------------------------------------------


def test_a_sound_study_is_returned(folder):
    assert set(checked_study(STUDY).samples) == {"one", "other"}
    assert sample_problems(SAMPLE) == sample_problems(OTHER) == []
    assert list(folder.iterdir()) == []


def test_too_few_grains_are_refused_unless_allowed(folder):
    wide = {**UNIFORM, "min": 0.005}
    (line,) = lines_of(study_of(grading=wide, grains=40))
    assert line.startswith("config: samples.mine.grains = 40: 40 grains put ")
    assert line.endswith("or set allow_unrepresentative: true, which the report will repeat")
    checked_study(study_of(grading=wide, grains=40, allow_unrepresentative=True))


def test_too_few_grains_are_told_which_part_of_the_grading_they_could_stand_for(folder):
    # Of a fractal the coarse end: 400 grains stand for a ratio of 1.8 between its ends.
    fractal = {"form": "fractal", **SIZES, "min": 0.005, "max": 1.0, "alpha": 2.6}
    (line,) = lines_of(study_of(grading=fractal, grains=400))
    part = line.split("with 400 grains radii ")[1].split(", ")[0]
    low, _, high, unit = part.split()
    assert (high, unit) == ("1", "mm") and 0.5 < float(low) < 0.7
    narrower = {**fractal, "min": float(low)}
    checked_study(study_of(grading=narrower, grains=400))
    assert representativity(grading_of(narrower), 400, 0.16 / 0.6**3).verdict == "accept"


def test_a_preview_lets_too_few_grains_through(folder):
    wide = {**UNIFORM, "min": 0.005}
    few = study_of(grading=wide, grains=40)
    assert checked_study(few, few_grains=True).samples["mine"].grains == 40
    with pytest.raises(ConfigError, match="allow_unrepresentative"):
        checked_study(few)


def test_a_cell_smaller_than_its_largest_grain_is_refused_though_allowed(folder):
    grading = {**UNIFORM, "min": 0.005}
    loading = {"solid_fraction": 1.1}
    (line,) = lines_of(
        study_of(grading=grading, grains=2, loading=loading, allow_unrepresentative=True)
    )
    assert "the cell would end at an edge of" in line
    assert line.endswith("use more grains or load less")


def test_a_stress_that_would_crush_the_grains_into_each_other_is_refused(folder):
    (line,) = lines_of(study_of(loading={"mean_stress": [1e3, 1e12]}))
    assert line.startswith("config: samples.mine.loading.mean_stress = 1e+12 Pa: would press")
    assert line.endswith("ask for less, or raise the stiffness of contact")


def test_grains_may_be_pressed_together_by_half_the_median_radius_by_mass(folder):
    # R^4 is in the middle of 0.5^4 and 1: R = 0.854 mm. Of linear contacts, an overlap of R/2 takes
    # a stress of 0.5 * 0.64 * 6 k / (4 pi R) = 179 MPa.
    checked_study(study_of(loading={"mean_stress": [1e5, 1.78e8]}))
    (line,) = lines_of(study_of(loading={"mean_stress": [1e5, 1.80e8]}))
    assert "median radius by mass, 0.000854 m, together by about 50% of it" in line


def test_grains_are_checked_though_another_key_is_wrong(folder):
    lines = lines_of(study_of(grading={**UNIFORM, "min": 0.005}, grains=40, seeds=0, boundary="w"))
    assert [line.split(" = ")[0] for line in lines] == [
        "config: samples.mine.boundary",
        "config: samples.mine.seeds",
        "config: samples.mine.grains",
    ]


# --- files ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "content",
    [
        "1,0\n2,60\n8,100\n",
        "opening_mm,percent\n1,0\n2,60\n8,100\n",
        "# of the river\n\n1,0\n\n2,60  # twice\n8,100\n",
        "\ufeff1,0\n2,60\n8,100\n",
        "1;0\n2;60\n8;100\n",
        "1,0;0,0\n2,0;60,0\n8;1e2\n",
        "8,100\n2,60\n1,0\n",
        "1,0\n2,60\n2,60\n8,100\n",
        "1\t0\r\n2\t60\r\n8\t100\r\n",
    ],
)
def test_every_dialect_of_a_table_gives_the_same_grading(folder, content):
    (folder / "sand.csv").write_bytes(content.encode())
    checked_study(study_of(grading=SIEVE, allow_unrepresentative=True))
    grading = grading_of(SIEVE)
    (folder / "sand.csv").write_text("1,0\n2,60\n8,100\n")
    expected = grading_of(SIEVE)
    radii = np.geomspace(0.5e-3, 4e-3, 9)
    assert grading.mass_cdf(radii).tolist() == expected.mass_cdf(radii).tolist()


def test_files_of_all_parts_of_a_mixture_are_named(folder):
    (folder / "wrong.csv").write_text("1,0\n2,110\n8,x\n")
    parts = [{**SIEVE, "file": name} for name in ("no.csv", "wrong.csv", ".")]
    components = [{"weight": 1, "grading": part} for part in parts]
    lines = lines_of(
        study_of(grading={"form": "mixture", "basis": "mass", "components": components})
    )
    place = "config: samples.mine.grading.components"
    assert [line.removeprefix(place)[:43] for line in lines] == [
        ".0.grading.file = 'no.csv': there is no suc",
        ".1.grading.file: wrong.csv, line 2: percent",
        ".1.grading.file: wrong.csv, line 3: percent",
        ".2.grading.file = '.': is a folder; give th",
    ]


@pytest.mark.parametrize("name", ["a\0b", "n" * 300, "/dev/null", "no/such.csv"])
def test_a_name_of_no_file_is_refused(folder, name):
    (line,) = lines_of(study_of(grading={**SIEVE, "file": name}))
    assert line.startswith("config: samples.mine.grading.file = '")


def test_a_missing_file_is_named_besides_another_mistake(folder):
    lines = lines_of(study_of(grading={**SIEVE, "unit": "ft"}))
    assert [line.split(" = ")[0][-12:] for line in lines] == ["grading.unit", "grading.file"]


def test_missing_files_of_a_mixture_are_named_besides_another_mistake(folder):
    parts = [{**SIEVE, "file": "no.csv"}, {**UNIFORM, "unit": "ft"}]
    components = [{"weight": 1, "grading": part} for part in parts]
    wrong, missing = lines_of(
        study_of(grading={"form": "mixture", "basis": "mass", "components": components})
    )
    assert wrong.startswith("config: samples.mine.grading.components.1.grading.unit = 'ft'")
    assert missing.startswith("config: samples.mine.grading.components.0.grading.file = 'no.csv'")


def test_a_file_that_may_not_be_read_is_named(folder, locked):
    (folder / "sand.csv").write_text("1,0\n2,60\n8,100\n")
    locked("sand.csv")
    (line,) = lines_of(study_of(grading=SIEVE))
    expected = "grading.file = 'sand.csv': cannot be read: change its permissions"
    assert line == f"config: samples.mine.{expected}"


# --- folders -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "place", ["results", "logs", "results/mine", "results/mine-refined", "results/figures/mine"]
)
def test_a_file_in_the_way_of_results_is_named(folder, place):
    (folder / place).parent.mkdir(parents=True, exist_ok=True)
    (folder / place).touch()
    expected = f"config: {place} is a file, and results need a folder there: move it"
    assert lines_of(study_of()) == [expected]


@pytest.mark.parametrize("place", ["results", "logs/mine", "results/mine-refined"])
def test_a_folder_of_results_that_may_not_be_written_is_named(folder, locked, place):
    (folder / place).mkdir(parents=True)
    locked(place)
    assert lines_of(study_of()) == [f"config: {place} cannot be written to: change its permissions"]


def test_a_study_in_a_folder_that_may_not_be_written_is_refused(folder, locked):
    locked(".")
    (line,) = lines_of(study_of())
    assert line == f"config: the folder {folder} cannot be written to: run in one of your own"


def test_a_name_that_leads_elsewhere_is_only_refused(folder):
    (folder / "results").mkdir()
    (folder / "up").touch()
    (line,) = lines_of({"samples": {"../up": SAMPLE}})
    assert "it names a folder" in line


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
