"""What breakage will make of a sample: beside simulations that were run, and by hand."""

import math
from dataclasses import replace

import pytest

from branchcrush.breakage.rules import Breakage
from branchcrush.breakage.strength import Strength
from branchcrush.gradings.forms import uniform
from branchcrush.gradings.mixtures import single
from branchcrush.loading.sample import Sample
from branchcrush.loading.targets import Loading
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.study.preview import sample_plan
from branchcrush.study.preview_breakage import breaking
from branchcrush.study.preview_breakage_words import grains_words, strength_words
from branchcrush.study.preview_text import fixed_seconds, preview_text

SAND = Strength(strength=2e7, weibull_modulus=3.0, reference_diameter=1e-3, size_exponent=1.0)
RULES = Breakage(strength=SAND, smallest_diameter=2.5e-4)
MM = ("mm", 1e-3)
SAMPLE = Sample(
    grading=uniform(4e-4, 6e-4),
    sampling="random",
    grains=300,
    boundary="periodic",
    initial_solid_fraction=0.16,
    law=LinearContact(1e6),
    loading=Loading("solid_fraction", 0.73, states=26, approach_solid_fraction=0.6),
    strain_step=1.7e-3,
    seeds=(1,),
)


def found_of(solid_fraction=0.73, rules=RULES, evaluations=37_000.0, unit=MM, **keys):
    loading = replace(SAMPLE.loading, value=solid_fraction, **keys.pop("loading", {}))
    sample = replace(SAMPLE, loading=loading, **keys)
    return breaking(sample, rules, evaluations, 2e-7, unit)


def with_strength(**keys):
    return replace(RULES, strength=replace(SAND, **keys))


# Simulations, not this model: grains in the end of one run, or the mean of two.
MEASURED = [
    (500, 2.5e-4, 0.661, 929),
    (500, 2.5e-4, 0.677, 1449),
    (500, 2.5e-4, 0.710, 4413),
    (500, 2.5e-4, 0.745, 10107),
    (300, 2.5e-4, 0.6811, 989),
    (300, 2.5e-4, 0.7077, 2465),
    (300, 2.5e-4, 0.73, 4467),
    (200, 5e-4, 0.6767, 616),
    (200, 5e-4, 0.72, 1565),
]


@pytest.mark.parametrize(("grains", "limit", "solid_fraction", "measured"), MEASURED)
def test_as_many_grains_as_simulations_made(grains, limit, solid_fraction, measured):
    rules = replace(RULES, smallest_diameter=limit)
    found = found_of(solid_fraction, rules, grains=grains)
    assert found.grains == pytest.approx(measured, rel=0.35)
    assert found.densest is None and found.solid_fraction == pytest.approx(solid_fraction)
    assert found.warnings == []


@pytest.mark.parametrize(
    ("solid_fraction", "measured"), [(0.619, 1019), (0.6445, 1669), (0.6715, 2943), (0.70, 4815)]
)
def test_as_many_between_walls_which_jam_looser(solid_fraction, measured):
    rules = replace(RULES, smallest_diameter=3e-4)
    loading = {"approach_solid_fraction": 0.55}
    given = {"grains": 200, "boundary": "walls", "loading": loading}
    assert found_of(solid_fraction, rules, **given).grains == pytest.approx(measured, rel=0.35)
    # Of more grains fewer are at a wall, and of each the less has to break.
    found = found_of(solid_fraction, rules, **{**given, "grains": 20_000})
    assert found.grains / 20_000 < measured / 200
    assert "rod map less a layer at each wall, at" in grains_words(found, periodic=False)


def test_as_many_of_other_grains_by_a_simulation_that_was_held_out():
    # Hertz, another Weibull modulus and size exponent: 1253 grains.
    material = replace(SAND, strength=5e7, weibull_modulus=6.0, size_exponent=0.5)
    rules = replace(RULES, strength=material, smallest_diameter=3e-4)
    law = HertzContact.of_material(70e9, 0.2)
    assert found_of(0.70, rules, law=law, grains=200).grains == pytest.approx(1253, rel=0.35)


def test_force_evaluations_and_time_are_about_those_of_two_runs():
    # 316 000 and 288 000, of which 37 000 without breakage; 6.4e8 of a grain in both.
    found = found_of()
    assert 150_000 < found.force_evaluations < 600_000
    assert 0.5 * 6.4e8 < found.seconds / 2e-7 < 2.0 * 6.4e8
    twice = found_of(seeds=(1, 2, 3), refined_seeds=1)
    assert twice.seconds == pytest.approx(5.0 * found.seconds)


def test_the_elastic_strain_is_that_of_grains_at_their_strength():
    # One size: F = s d^2 = 20 N, an overlap of 20 um of 1 mm.
    linear = found_of(grading=single(0.5e-3))
    assert linear.overlap == pytest.approx(0.04)
    assert linear.elastic_strain == pytest.approx(0.75 * 0.02)
    # F = K sqrt(R/2) delta^1.5.
    hertz = found_of(grading=single(0.5e-3), law=HertzContact(5e10))
    overlap = (20.0 / (5e10 * math.sqrt(0.25e-3))) ** (2 / 3)
    assert hertz.elastic_strain == pytest.approx(0.75 * overlap / 1e-3)


def test_strengths_are_those_of_the_smallest_the_median_and_the_largest():
    sizes, strengths = zip(*found_of().strengths, strict=True)
    # By mass (d^4 - 0.8^4)/(1.2^4 - 0.8^4).
    median = 1e-3 * (0.5 * (0.8**4 + 1.2**4)) ** 0.25
    assert sizes == pytest.approx([0.8e-3, median, 1.2e-3])
    assert strengths == pytest.approx([2e7 / 0.8, 2e4 / median, 2e7 / 1.2])


def test_stronger_grains_are_fewer_and_grains_too_strong_do_not_break():
    numbers = [found_of(rules=with_strength(strength=s)).grains for s in (1e6, 1e7, 3e7, 6e7)]
    assert numbers == sorted(numbers, reverse=True) and numbers[0] > 2.0 * numbers[3]
    found = found_of(rules=with_strength(strength=1e12), seeds=(1, 2))
    assert found.grains == 300
    # What it takes without breakage, and no round.
    assert found.force_evaluations == pytest.approx(37_000)
    assert found.seconds == pytest.approx(2 * 37_000 * 300 * 2e-7)
    assert any(text.startswith("hardly a grain will break") for text in found.warnings)
    assert any("overlap by up to" in text for text in found.warnings)


def test_where_there_may_be_no_more_grains_the_run_ends():
    found = found_of(rules=replace(RULES, largest_grains=2000))
    assert found.grains == 2000 and 0.68 < found.solid_fraction < 0.72
    assert f"about {found.solid_fraction:.3f}, before the target 0.730 -> " in found.warnings[0]
    # A loading to there has as many.
    assert found_of(found.solid_fraction).grains == pytest.approx(2000, rel=1e-3)
    assert found.force_evaluations < found_of().force_evaluations
    assert "about 2 000 at" in grains_words(found, periodic=True)


def test_a_target_denser_than_all_gradings_known_is_said_to_be_so():
    found = found_of(0.85)
    assert 0.75 < found.densest < 0.85
    assert any("the target 0.850 is denser than any grading" in text for text in found.warnings)
    assert grains_words(found, periodic=True).startswith("at least about ")
    assert found_of(found.densest - 1e-3).densest is None


def test_nothing_breaks_on_the_way_back_but_all_fragments_are_there():
    there, back = found_of(), found_of(evaluations=74_000.0, loading={"unloading": True})
    assert back.grains == there.grains and back.warnings == []
    steps = back.force_evaluations - there.force_evaluations
    assert steps == pytest.approx(37_000, rel=1e-9)
    assert back.seconds - there.seconds == pytest.approx(steps * there.grains * 2e-7, rel=1e-3)


def test_a_run_that_ends_early_does_not_go_back():
    rules = replace(RULES, largest_mean_stress=1e6)
    (warning,) = found_of(rules=rules, loading={"unloading": True}).warnings
    assert warning.startswith("a run that breakage.largest_mean_stress ends does not go back")
    assert found_of(rules=rules).warnings == []
    assert "fewer where largest_mean_stress" in grains_words(found_of(rules=rules), periodic=True)


@pytest.mark.parametrize(
    ("reference", "warned"), [(7.9e-5, True), (8.1e-5, False), (1.19e-2, False), (1.21e-2, True)]
)
def test_a_strength_of_grains_far_from_all_is_warned_of(reference, warned):
    # Of grains of 0.8 to 1.2 mm, as strong as before.
    rules = with_strength(reference_diameter=reference, strength=2e7 * 1e-3 / reference)
    texts = found_of(rules=rules).warnings
    assert len(texts) == warned
    if warned:
        assert f"breakage.reference_diameter {reference * 1e3:.3g} mm is far from" in texts[0]
        assert "0.8 to 1.2 mm: check it and its unit" in texts[0]


@pytest.mark.parametrize(
    ("unit", "expected"),
    [
        (MM, ["25 MPa of the smallest (0.8 mm)", "of 0.25 mm or finer", "has 0.0665 mm"]),
        (("um", 1e-6), ["(800 um)", "16.7 MPa of the largest (1200 um)", "of 250 um or finer"]),
    ],
)
def test_words_are_in_the_unit_of_the_user(unit, expected):
    text = strength_words(found_of(unit=unit), *unit)
    assert [part for part in expected if part not in text] == []


# --- in the preview ------------------------------------------------------------------------------


def plan_of(breakage):
    return sample_plan(SAMPLE, [5e-4] * 300, 1e-7, None, unit=MM, breakage=breakage)


def text_of(plan, cores=2):
    return preview_text({"sand": plan}, cores, {"sand": "a.png"}, {})


def test_the_preview_tells_strength_grains_and_time():
    plan = plan_of(RULES)
    lines = text_of(plan).splitlines()
    assert max(map(len, lines)) <= 96
    text = " ".join(" ".join(lines).split())
    for part in (
        "breakage strength that 37 % survive 25 MPa of the smallest (0.8 mm)",
        "grains about 4 800 at a solid fraction of 0.730, half or twice as many (an estimate:",
        "time compression about",
        "crushing about",
    ):
        assert part in text
    assert "crushing about" not in text_of(plan_of(None))
    assert "breakage" not in text_of(plan_of(None))


def test_crushing_counts_in_the_time_of_all_the_memory_and_the_jobs():
    plain, plan = plan_of(None), plan_of(RULES)
    assert fixed_seconds(plan) - fixed_seconds(plain) == pytest.approx(1.2)
    # 300 bytes a contact, 3 a grain, 27 states and one more.
    more = plan.breaking.grains - 300
    assert plan.memory - plain.memory == pytest.approx(300 * 3 * more * (plan.states + 2))
    # One packing on one core: 3 s to start, four jobs of all, compression and crushing.
    slow = plan._replace(seconds=600.0, breaking=plan.breaking._replace(seconds=3000.0))
    assert "all samples together: about 60 min" in text_of(slow)
    assert "crushing about 50 min on 2 cores" in " ".join(text_of(slow).split())


def test_warnings_of_breakage_are_among_those_of_the_sample():
    plan = plan_of(replace(RULES, largest_grains=1000))
    assert any(text.startswith("largest_grains 1000 are reached") for text in plan.warnings)
