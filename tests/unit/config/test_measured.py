"""The section `measured`: what it asks for, what it refuses, and that all is told at once."""

import pytest

from branchcrush.config.checks import checked_study
from branchcrush.config.schema import checked_config
from branchcrush.errors import ConfigError

GRADING = {
    "form": "uniform",
    "basis": "mass",
    "size": "diameter",
    "unit": "mm",
    "min": 1.0,
    "max": 2.0,
}
SAMPLE = {"grading": GRADING, "grains": 2000, "loading": {"edge_reduction": 0.4}, "seeds": 1}
SMALLEST = {"size": "diameter", "unit": "mm", "value": 0.02}
MATERIAL = {"before": GRADING, "after": {**GRADING, "min": 0.1}, "ultimate_smallest": SMALLEST}
COMPRESSION = {
    "file": "curve.csv",
    "stress_unit": "MPa",
    "values": "strain",
    "lateral_stress_ratio": 0.45,
    "contact": {"law": "linear", "normal_stiffness": 1e6},
}
CURVE = "stress [MPa],strain\n" + "\n".join(f"{2**k},{0.01 * k}" for k in range(1, 8))


def study(material, **others):
    return {"samples": {"mine": SAMPLE}, "measured": {"sand": material}, **others}


@pytest.fixture
def problems(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "curve.csv").write_text(CURVE)

    def told(material, name="sand"):
        with pytest.raises(ConfigError) as error:
            checked_study({**study(material), "measured": {name: material}})
        return str(error.value).splitlines()

    return told


def test_a_study_without_the_section_has_no_materials():
    assert checked_config({"samples": {"mine": SAMPLE}}).measured == {}


def test_a_material_still_needs_samples():
    with pytest.raises(ConfigError, match="samples: missing"):
        checked_config({"measured": {"sand": MATERIAL}})


def test_defaults_and_plain_values(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "curve.csv").write_text(CURVE)
    config = checked_study(study({**MATERIAL, "compression": COMPRESSION}))
    settings = config.measured["sand"].settings()
    assert settings["ultimate_alpha"] == 2.6
    assert settings["ultimate_smallest"] == pytest.approx(1e-5)  # a radius [m]
    assert settings["compression"]["share_of_affine"] == 0.8
    assert settings["before"] == checked_config(study(MATERIAL)).measured["sand"].before.model_dump(
        exclude_none=True
    )


@pytest.mark.parametrize(
    ("size", "unit", "radius"), [("radius", "um", 2e-8), ("diameter", "m", 0.01)]
)
def test_the_smallest_size_has_a_unit_and_says_what_it_is(size, unit, radius):
    smallest = {"size": size, "unit": unit, "value": 0.02}
    material = {**MATERIAL, "ultimate_smallest": smallest}
    assert checked_config(study(material)).measured["sand"].ultimate_smallest.radius == (
        pytest.approx(radius)
    )


def test_what_decides_is_asked_for(problems):
    material = {"before": GRADING, "after": GRADING, "compression": {"file": "curve.csv"}}
    said = "\n".join(problems(material))
    assert "measured.sand.ultimate_smallest: missing; must be a section with size, unit" in said
    assert "which decides B" in said
    for key in ("stress_unit", "values", "lateral_stress_ratio", "contact"):
        assert f"measured.sand.compression.{key}: missing" in said
    assert "about 0.4 to 0.5 of an oedometer" in said


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"after": None}, "measured.sand: must have after, the grading after the test"),
        ({"befor": GRADING}, "measured.sand.befor: unknown key; did you mean before?"),
        ({"ultimate_alpha": 3}, "ultimate_alpha = 3: must be a number above 0 and below 3"),
        ({"after": {**GRADING, "min": 3}}, "after.max = 2 mm: must be above min 3 mm"),
        ({"after": {**GRADING, "form": "siev"}}, "after.form = 'siev': must be 'uniform'"),
        ({"after": {"form": "radii", "file": "no.txt"}}, "after.file = 'no.txt': there is no"),
        (
            {"ultimate_smallest": {**SMALLEST, "value": 2}},
            "ultimate_smallest.value = 2 mm: must be below the largest size of the grading before",
        ),
        (
            {"ultimate_smallest": {**SMALLEST, "value": 1.5}},
            "the ultimate grading would be no finer than the one before: lower it",
        ),
        ({"ultimate_smallest": {**SMALLEST, "value": -1}}, "must be a number from 0 to 1e+06"),
    ],
)
def test_a_material_that_makes_no_sense_is_refused(problems, changes, said):
    assert any(said in line for line in problems({**MATERIAL, **changes}))


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"stress_unit": "bar"}, "compression.stress_unit = 'bar': must be 'Pa', 'kPa' or 'MPa'"),
        ({"values": "void_ratio"}, "initial_void_ratio: missing; must be the void ratio at the"),
        ({"columns": [1, 2, 3]}, "columns = [1, 2, 3]: must be a list of two columns"),
        ({"sheet": 0}, "sheet = 0: must be the name of a sheet"),
        ({"lateral_stress_ratio": 1.5}, "lateral_stress_ratio = 1.5: must be a number above 0"),
        ({"contact": {"law": "hertz"}}, "compression.contact.young_modulus: missing"),
        ({"contact": {"law": "linear"}}, "contact.normal_stiffness: missing; give that of the"),
        ({"file": "none.csv"}, "compression.file = 'none.csv': there is no such file"),
        ({"stress_unit": "kPa"}, "compression.file: curve.csv, the file and the keys disagree"),
        ({"values": "percent_strian"}, "values = 'percent_strian': must be 'void_ratio'"),
        ({"fil": "curve.csv"}, "compression.fil: unknown key; did you mean file?"),
    ],
)
def test_a_compression_that_makes_no_sense_is_refused(problems, changes, said):
    material = {**MATERIAL, "compression": {**COMPRESSION, **changes}}
    assert any(said in line for line in problems(material))


SINGLE = {"form": "single", "size": "diameter", "unit": "mm"}
# Means by mass of ln D, in mm: of one size its own, of the ultimate grading from 0 to 1 mm with
# alpha = 2.6 ln 1 - 1/(3 - 2.6) = -2.5; so B = ln(1/D)/2.5.
ONE_SIZE = {
    "before": {**SINGLE, "value": 1.0},
    "ultimate_smallest": {"size": "diameter", "unit": "mm", "value": 0},
}


@pytest.mark.parametrize(
    ("diameter", "said"),
    [
        (2.0, "sand.after: coarser than before, Einav's B = -0.277, and crushing makes none"),
        (0.05, "= 0 mm: the grading after is finer than the ultimate one, Einav's B = 1.2, which"),
    ],
)
def test_a_grading_after_that_crushing_does_not_lead_to_is_refused(problems, diameter, said):
    (line,) = problems({**ONE_SIZE, "after": {**SINGLE, "value": diameter}})
    assert said in line
    assert ("exchanged?" in line) == (diameter > 1)
    assert ("raise ultimate_alpha" in line) == (diameter < 1)


def test_a_smallest_size_above_the_grading_after_is_to_be_lowered(problems):
    smallest = {**SMALLEST, "value": 0.9}
    after = {**SINGLE, "value": 0.5}
    (line,) = problems({"before": GRADING, "after": after, "ultimate_smallest": smallest})
    assert "sand.ultimate_smallest.value = 0.9 mm: the grading after is finer" in line
    assert "lower it, or raise ultimate_alpha" in line


@pytest.mark.parametrize("diameter", [1.0, 1.04, 0.09])
def test_a_grading_after_that_differs_as_two_sieve_analyses_do_is_accepted(diameter):
    after = {**SINGLE, "value": diameter}
    assert checked_study(study({**ONE_SIZE, "after": after}))


def test_a_compression_needs_a_smallest_grain_to_crush_to(problems):
    smallest = {**SMALLEST, "value": 0}
    assert checked_config(study({**MATERIAL, "ultimate_smallest": smallest}))
    (line,) = problems({**MATERIAL, "ultimate_smallest": smallest, "compression": COMPRESSION})
    assert line.startswith(
        "config: measured.sand.ultimate_smallest.value = 0 mm: must be above 0 where a compression"
    )


@pytest.mark.parametrize("name", ["a/b", "measured", "x-refined", "report.html"])
def test_a_name_that_names_no_folder_of_its_own_is_refused(problems, name):
    assert any(f"measured.{name} = " in line for line in problems(MATERIAL, name))


def test_all_problems_are_told_at_once_with_those_of_the_samples():
    raw = study({**MATERIAL, "ultimate_alpha": 9, "after": {"form": "radii", "file": "no.txt"}})
    raw["samples"]["mine"] = {**SAMPLE, "seeds": 0}
    with pytest.raises(ConfigError) as error:
        checked_study(raw)
    said = str(error.value)
    assert "samples.mine.seeds" in said
    assert "measured.sand.ultimate_alpha" in said
    assert "measured.sand.after.file" in said
