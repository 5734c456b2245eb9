"""Grains that break: what a user may ask, and what is refused in words."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from branchcrush.config.breakage import MOST_GRAINS
from branchcrush.config.breakage_checks import breakage_problems
from branchcrush.config.checks import checked_study, sample_problems
from branchcrush.config.sample import breakage_of
from branchcrush.config.units import UNITS
from branchcrush.gradings.forms import uniform
from tests.unit.config.studies import BREAKAGE, SAMPLE, lines_of, study_of

# Of the sample: radii from 0.5 to 1 mm, 1000 grains.
BEGIN = "config: samples.mine.breakage"


def broken(**keys):
    """Return a study with breakage, some of its keys replaced; None leaves one out."""
    section = {**BREAKAGE, **keys}
    return study_of(breakage={key: value for key, value in section.items() if value is not None})


def test_a_sound_section_becomes_rules_in_si_units(folder):
    study = checked_study(broken(unit="cm", reference_diameter=0.2, smallest_diameter=0.03))
    rules = breakage_of(study.samples["mine"].settings()["breakage"])
    assert rules.strength.reference_diameter == pytest.approx(2e-3)
    assert rules.smallest_diameter == pytest.approx(3e-4)
    # 3 over the Weibull modulus, where it is left out.
    assert rules.strength.size_exponent == pytest.approx(1.5)
    given = checked_study(broken(size_exponent=0)).samples["mine"].settings()["breakage"]
    assert given["size_exponent"] == 0.0


@pytest.mark.parametrize(
    ("keys", "shown", "allowed"),
    [
        ({"strength": 0}, "strength = 0 Pa", "must be a number above 0 and at most 1e+15 Pa"),
        ({"strength": "20 MPa"}, "strength = '20 MPa'", "must be a number above 0"),
        ({"strength": None}, "strength", "missing; must be a number above 0"),
        ({"weibull_modulus": 0.1}, "weibull_modulus = 0.1", "must be a number from 0.5 to 100"),
        ({"unit": "km"}, "unit = 'km'", "must be 'm', 'cm', 'mm', 'um' or 'inch'"),
        ({"reference_diameter": -1}, "reference_diameter = -1 mm", "a number above 0 mm"),
        ({"reference_diameter": 2e6}, "reference_diameter = 2e+06 mm", "from 1e-09 m to 1000 m"),
        ({"smallest_diameter": 0}, "smallest_diameter = 0 mm", "a number above 0 mm"),
        ({"smallest_diameter": "0,3"}, "smallest_diameter = '0,3'", "with a decimal point"),
        ({"size_exponent": 11}, "size_exponent = 11", "must be a number from 0 to 10"),
        ({"criterion": "force"}, "criterion = 'force'", "'largest_force' or 'octahedral_stress'"),
        ({"fragments": 3}, "fragments = 3", "must be a whole number from 4 to 50"),
        ({"growth_stages": -1}, "growth_stages = -1", "must be a whole number from 0 to 1000"),
        ({"per_round": "two"}, "per_round = 'two'", "must be 'all' or 'one'"),
        ({"stepping": "event"}, "stepping = 'event'", "did you mean 'events'?"),
        ({"largest_grains": 1}, "largest_grains = 1", "a whole number from 2 to 10000000"),
        ({"largest_mean_stress": 0}, "largest_mean_stress = 0 Pa", "must be a number above 0"),
        ({"strenght": 1}, "strenght", "unknown key; did you mean strength?"),
    ],
)
def test_a_key_that_is_wrong_is_told_with_what_is_allowed(folder, keys, shown, allowed):
    (line,) = lines_of(broken(**keys))
    assert line.startswith(f"{BEGIN}.{shown}: ")
    assert allowed in line


def test_all_that_is_wrong_is_told_at_once(folder):
    lines = lines_of(broken(strength=0, fragments=3, unit="km", smallest_diameter=0))
    assert [line.split(" = ")[0].removeprefix(f"{BEGIN}.") for line in lines] == [
        "strength",
        "unit",
        "smallest_diameter",
        "fragments",
    ]
    lines = lines_of({**broken(smallest_diameter=5, largest_grains=900), "figures": {"dpi": 1}})
    assert len(lines) == 3


def test_a_loading_to_stresses_is_refused_with_the_way_out(folder):
    (line,) = lines_of(study_of(breakage=BREAKAGE, loading={"mean_stress": [1e5, 1e6]}))
    assert line.startswith(
        "config: samples.mine: breakage cannot go with loading.mean_stress, since stress falls"
    )
    assert line.endswith("and breakage.largest_mean_stress to end at a stress")


def test_a_way_back_is_taken(folder):
    # Of the sample; a strain whichever way it is told.
    for loading in ({"solid_fraction": 0.7}, {"edge_reduction": 0.4}, {"volume_reduction": 0.8}):
        study = study_of(breakage=BREAKAGE, loading={**loading, "unloading": True})
        assert checked_study(study).samples["mine"].settings()["loading"]["unloading"] is True


# --- with the grains -----------------------------------------------------------------------------


def test_a_limit_that_no_grain_is_above_is_refused_in_the_words_of_the_user(folder):
    (line,) = lines_of(broken(smallest_diameter=2.5))
    assert line == (
        f"{BEGIN}.smallest_diameter = 2.5 mm: must be below the largest grain, 2 mm in diameter, "
        "or none can break (the grading has radii from 0.5 to 1 mm): check it and breakage.unit"
    )
    # A slip of the unit: 0.3 cm for 0.3 mm.
    (line,) = lines_of(broken(unit="cm"))
    assert "smallest_diameter = 0.3 cm: must be below the largest grain, 0.2 cm in" in line


def test_a_limit_that_makes_grains_without_end_is_refused_with_the_least(folder):
    (line,) = lines_of(broken(unit="um", reference_diameter=1))
    assert line.startswith(f"{BEGIN}.smallest_diameter = 0.3 um: must be at least ")
    assert "a packing may have 10000000: check it and breakage.unit" in line
    least = float(line.split("at least ")[1].split()[0])
    checked_study(broken(unit="um", reference_diameter=1, smallest_diameter=1.01 * least))
    assert lines_of(broken(unit="um", reference_diameter=1, smallest_diameter=0.98 * least))


@pytest.mark.parametrize(("most", "refused"), [(1013, False), (1012, True), (500, True)])
def test_one_grain_has_to_have_room_to_break(folder, most, refused):
    if not refused:
        checked_study(broken(largest_grains=most))
        return
    (line,) = lines_of(broken(largest_grains=most))
    assert line == (
        f"{BEGIN}.largest_grains = {most}: must be at least 1013, or none can break: there are "
        "1000 grains to begin with, and one that breaks into 14 fragments adds 13"
    )


def test_breakage_is_checked_though_another_key_is_wrong(folder):
    study = broken(smallest_diameter=2.5, largest_grains=900)
    study["samples"]["mine"]["grains"] = 1
    names = [line.split(" = ")[0] for line in lines_of(study)]
    assert names == ["config: samples.mine.grains", f"{BEGIN}.smallest_diameter"]


def test_a_section_that_is_none_is_passed_over():
    for raw in (None, [], "sand", {"strength": 1}):
        assert sample_problems({**SAMPLE, "breakage": raw}) == []


SMALLEST = st.floats(1e-8, 1e4)


@given(
    SMALLEST,
    st.sampled_from(sorted(UNITS)),
    st.integers(2, 10_000),
    st.integers(2, 20_000),
    st.integers(4, 50),
)
@settings(max_examples=200, deadline=None)
def test_what_is_refused_is_what_cannot_be(smallest, unit, grains, most, fragments):
    """No other section than one by which no grain could break, or more than there may be."""
    sizes = {"reference_diameter": 1e-3 / UNITS[unit], "smallest_diameter": smallest}
    raw = {**BREAKAGE, "unit": unit, **sizes, "largest_grains": most, "fragments": fragments}
    lines = breakage_problems(raw, uniform(5e-4, 1e-3), grains, "mm", "radius")
    limit = smallest * UNITS[unit]
    keys = [line.split(" = ")[0] for line in lines]
    if not 1e-9 <= limit <= 1e3:
        assert lines == []  # refused for what it is
        return
    assert ("breakage.largest_grains" in keys) == (most < grains + fragments - 1)
    at_limit = "breakage.smallest_diameter" in keys
    assert at_limit or limit < 2e-3
    # Broken down, so many grains have the volume of the largest: each has at most the limit's.
    assert at_limit or (2e-3 / limit) ** 3 < 1e3 * MOST_GRAINS
    assert not at_limit or limit >= 2e-3 or limit < 2e-3 / 50
    assert all(line.count("must be") == 1 for line in lines)
