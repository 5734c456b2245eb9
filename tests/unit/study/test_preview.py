"""What a study will cost, by hand."""

import math
from dataclasses import replace

import pytest

from branchcrush.gradings.curves import ultimate_grading
from branchcrush.gradings.forms import fractal, uniform
from branchcrush.gradings.mixtures import mixture, single
from branchcrush.gradings.tables import from_percent_finer
from branchcrush.loading.sample import Sample
from branchcrush.loading.targets import Loading
from branchcrush.packings.contact_laws import LinearContact
from branchcrush.study.preview import sample_plan

LOADING = Loading("edge_reduction", 0.4)
# Finer than the grains of 1 mm, so that they can be crushed to it, and not by so much that the
# paper's form degenerates.
TWO_SIZES = mixture([single(4e-4), single(6e-4)], [1.0, 1.0], "mass")


def plan_of(
    grains=1000,
    seeds=4,
    refined=1,
    grading=None,
    seconds=1e-7,
    ranks=1,
    ultimate=TWO_SIZES,
    radii=None,
    told=None,
    **loading,
):
    sample = Sample(
        grading=grading or single(1e-3),
        sampling="random",
        grains=grains,
        boundary="walls",
        initial_solid_fraction=0.16,
        law=LinearContact(1e6),
        loading=replace(LOADING, **loading),
        strain_step=1.7e-3,
        seeds=tuple(range(seeds)),
        refined_seeds=refined,
        ranks=ranks,
    )
    drawn = [1e-3] * grains if radii is None else radii
    return sample_plan(sample, drawn, seconds, ultimate, **(told or {}))


def test_evaluations_and_time_of_a_thousand_grains_are_those_of_their_steps_and_states():
    plan = plan_of()
    # 60 strain steps and 15 states.
    assert plan.force_evaluations == pytest.approx(60 * 70 + 15 * 2000)
    # Four seeds, one of them again with twice the strain steps.
    assert plan.seconds == pytest.approx(6 * plan.force_evaluations * 1000 * 1e-7)
    assert plan.packings == 5


def test_evaluations_grow_with_the_cube_root_of_the_grains_and_time_with_both():
    few, many = plan_of(1000), plan_of(8000)
    assert many.force_evaluations == pytest.approx(2 * few.force_evaluations)
    assert many.seconds == pytest.approx(16 * few.seconds)


def test_refined_seed_counts_twice():
    assert plan_of(refined=2).seconds == pytest.approx(2 * plan_of(refined=0).seconds)


def test_way_back_takes_the_steps_again():
    there, back = plan_of(), plan_of(unloading=True)
    assert back.force_evaluations - there.force_evaluations == pytest.approx(60 * 70 + 14 * 2000)


def test_edges_are_those_of_the_solid_volume():
    plan = plan_of()
    solid = 1000 * 4 / 3 * math.pi * 1e-9
    assert plan.first_edge == pytest.approx((solid / 0.16) ** (1 / 3))
    assert plan.last_edge == pytest.approx(0.6 * plan.first_edge)
    assert set(plan.asked.by_mass) == {2e-3}


def test_memory_is_a_base_and_the_contacts_of_every_state():
    less, more = plan_of(), plan_of(states=30)
    assert more.memory - less.memory == pytest.approx(15 * 3 * 1000 * 300)


def test_every_rank_has_a_base_of_memory():
    one, three = plan_of(), plan_of(ranks=3)
    assert three.memory - one.memory == pytest.approx(2 * 350e6)


def test_sound_sample_has_no_warning():
    assert plan_of().warnings == []


def test_few_grains_are_warned_of():
    (warning,) = plan_of(60, grading=uniform(2e-4, 1e-3)).warnings
    assert "too few for this grading" in warning
    assert warning.endswith(
        "-> few coarse grains carry most of the load, so seeds differ and n is less certain"
    )
    told = {"refused": True, "unit": ("mm", 1e-3), "size": "radius"}
    warning, *_ = plan_of(400, grading=fractal(5e-6, 1e-3, 2.6), told=told).warnings
    assert "with 400 grains radii 0." in warning and "to 1 mm, " in warning
    assert warning.endswith("-> the run refuses this unless allow_unrepresentative: true")


@pytest.mark.parametrize(("stress", "warned"), [(1e6, False), (1e8, True)])
def test_stress_that_presses_grains_deep_is_warned_of(stress, warned):
    # An overlap of 0.00327 of the radius at 1 MPa, in proportion to the stress.
    plan = plan_of(target="mean_stress", value=[1e3, 1e4, 1e5, stress])
    assert [("overlaps of about 33% of the radius" in text) for text in plan.warnings] == (
        [True] if warned else []
    )


@pytest.mark.parametrize(("smallest", "warned"), [(4e-4, True), (5e-6, False)])
def test_an_ultimate_grading_that_is_coarser_is_warned_of(smallest, warned):
    # Of radii from 0.4 to 1 mm the fractal has the larger mean cube of branch lengths where its
    # fines are cut off: here by hand as if all grains were of the largest size.
    ultimate = single(1e-3) if warned else single(smallest)
    plan = plan_of(grains=100000, grading=uniform(smallest, 1e-3), ultimate=ultimate)
    problems = [text for text in plan.warnings if "coarser" in text]
    assert len(problems) == warned
    if warned:
        begin = "the paper's form of the crushing model will have no curves at n = 3, since "
        assert problems[0].startswith(begin)
        assert "thermodynamics.ultimate_alpha" in problems[0]
        # <l^3> = 2<R^3> + 6<R><R^2>: 8 mm^3 of one radius; of a uniform one from 0.4 to 1 mm
        # <R> = 0.7, <R^2> = 0.52, <R^3> = 0.406, so 0.812 + 2.184.
        assert "2.67 times as large" in problems[0]


def test_the_fractal_of_a_narrow_sand_is_the_coarser_one():
    # Nearly all of its mass is finer than most of the mass of the fractal.
    narrow = from_percent_finer([0.4e-3, 0.45e-3, 1e-3], [0.0, 95.0, 100.0])
    plan = plan_of(grains=100000, grading=narrow, ultimate=ultimate_grading(narrow, 2.6))
    assert any("the ultimate grading is coarser" in text for text in plan.warnings)


def test_sizes_are_read_off_both_curves_and_the_drawn_grains():
    # By number uniform on 1 to 3 mm of diameter, by mass (D^4 - 1)/80.
    plan = plan_of(grading=uniform(0.5e-3, 1.5e-3), radii=[0.5e-3, 1e-3, 1e-3, 1.5e-3])
    assert plan.asked.by_number == pytest.approx(
        [1e-3, 1.2e-3, 1.6e-3, 2e-3, 2.2e-3, 2.8e-3, 3e-3], rel=1e-9
    )
    quantiles = [1e-3 * (1 + 80 * q) ** 0.25 for q in (0, 0.1, 0.3, 0.5, 0.6, 0.9, 1)]
    assert plan.asked.by_mass == pytest.approx(quantiles, rel=1e-9)
    d10, d30, d60 = quantiles[1], quantiles[2], quantiles[4]
    assert plan.asked.coefficients == pytest.approx((d60 / d10, d30**2 / d10 / d60), rel=1e-9)
    # Volumes of 1, 8, 8 and 27 parts: 2 %, 39 % and 100 % are finer.
    assert plan.drawn.by_mass == pytest.approx([1e-3, 2e-3, 2e-3, 3e-3, 3e-3, 3e-3, 3e-3])
    assert plan.drawn.by_number == pytest.approx([1e-3, 1e-3, 2e-3, 2e-3, 2e-3, 3e-3, 3e-3])
    assert plan.ultimate.by_mass == pytest.approx(4 * [8e-4] + 3 * [1.2e-3])
    assert plan.largest_grains == (4, 1.0)
    assert plan.coarse_grains[1] == 1
    # One grain of 2 mm lifts the drawn curve from 2 % to 39 %, where 19 % are asked for.
    assert plan.gap == pytest.approx(100 * max(17 / 44 - 15 / 80, 1 - 17 / 44), rel=1e-9)


def test_grains_in_the_coarsest_tenth_and_the_share_of_the_largest():
    # Each of 20 grains has a twentieth: two have a tenth, ten have half.
    plan = plan_of(20, radii=[1e-3] * 20)
    assert plan.coarse_grains[1] == 2
    assert plan.largest_grains == (10, pytest.approx(0.5))


@pytest.mark.parametrize(
    ("states", "seeds", "warned"),
    [
        (1, 1, "one saved state"),
        (3, 1, "3 saved states"),
        (4, 1, None),
        (1, 3, "3 saved states"),
        (1, 4, None),
        (3, 2, None),
    ],
)
def test_too_few_states_of_all_packings_for_an_elastic_law_lead_to_no_theta(states, seeds, warned):
    plan = plan_of(states=states, seeds=seeds)
    texts = [text for text in plan.warnings if "no theta" in text]
    assert len(texts) == (warned is not None)
    if warned:
        assert texts[0].startswith(f"{warned} of all packings: an elastic law needs 4")


def test_a_degenerate_form_and_untested_sizes_are_said_before_a_run():
    # theta = 1 - <l^3>_u/<l^3>_0 with <l^3> = 8 R^3: 1 - 1/125.
    degenerate = [text for text in plan_of(ultimate=single(2e-4)).warnings if "theta of" in text]
    assert degenerate[0].startswith("theta of the paper's form is 0.992 at n = 3 ->")
    assert not [text for text in plan_of(ultimate=single(3e-4)).warnings if "theta of" in text]
    for ratio, said in ((20.0, False), (21.0, True)):
        texts = plan_of(grading=uniform(1e-3 / ratio, 1e-3)).warnings
        assert any(text.startswith("the largest grains are 21 times") for text in texts) == said


def test_one_size_one_seed_and_no_refined_ones_lead_to_what_is_missing():
    one, *_ = plan_of(ultimate=None).warnings
    assert one.startswith("one size") and "no crushing model" in one
    texts = plan_of(seeds=1, refined=0).warnings
    assert texts[0] == "one seed -> no interval of n"
    assert texts[1].startswith("no refined seeds -> the certificate")
