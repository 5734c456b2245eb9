"""What a configuration asks of grains, files and folders; no input whatever gets past it."""

import pytest

from branchcrush.config.build import grading_of
from branchcrush.config.checks import checked_study, sample_problems
from branchcrush.config.sample import sample_of
from branchcrush.errors import ConfigError
from branchcrush.gradings.representativity import representativity
from branchcrush.gradings.sampling import sampled_radii
from tests.unit.config.studies import OTHER, SAMPLE, SIZES, STUDY, UNIFORM, lines_of, study_of

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
    (line,) = lines_of(study_of(loading={"mean_stress": [1e5, 1e12]}))
    assert line.startswith("config: samples.mine.loading.mean_stress = 1e+12 Pa: would press")
    assert line.endswith("ask for less, or raise the stiffness of contact")


def test_a_stress_that_is_no_load_is_refused_beside_one_that_is_too_much(folder):
    # Mean radius 0.75 mm: F_0/(pi R^2) = 1e6 * 1e-4/(pi 0.75e-3) = 42.4 kPa.
    checked_study(study_of(loading={"mean_stress": [4.3e4, 1e5]}))
    low, high = lines_of(study_of(loading={"mean_stress": [4.2e4, 1e12]}))
    assert low.startswith("config: samples.mine.loading.mean_stress = 42000 Pa: below 4.24e+04 Pa")
    assert high.startswith("config: samples.mine.loading.mean_stress = 1e+12 Pa: would press")


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
