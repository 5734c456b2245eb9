"""What a study will cost, by hand."""

import math
from dataclasses import replace

import pytest

from branchcrush.gradings.curves import ultimate_grading
from branchcrush.gradings.forms import uniform
from branchcrush.gradings.mixtures import single
from branchcrush.gradings.tables import from_percent_finer
from branchcrush.loading.sample import Sample
from branchcrush.loading.targets import Loading
from branchcrush.packings.contact_laws import LinearContact
from branchcrush.study.preview import Plan, preview_text, sample_plan

LOADING = Loading("edge_reduction", 0.4)


def plan_of(
    grains=1000, seeds=4, refined=0, grading=None, seconds=1e-7, ranks=1, ultimate=None, **loading
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
    return sample_plan(sample, seconds, ultimate)


def test_evaluations_and_time_of_a_thousand_grains_are_those_of_their_steps_and_states():
    plan = plan_of()
    # 60 strain steps and 15 states.
    assert plan.force_evaluations == pytest.approx(60 * 70 + 15 * 2000)
    assert plan.seconds == pytest.approx(4 * plan.force_evaluations * 1000 * 1e-7)


def test_evaluations_grow_with_the_cube_root_of_the_grains_and_time_with_both():
    few, many = plan_of(1000), plan_of(8000)
    assert many.force_evaluations == pytest.approx(2 * few.force_evaluations)
    assert many.seconds == pytest.approx(16 * few.seconds)


def test_refined_seed_counts_twice():
    assert plan_of(refined=2).seconds == pytest.approx(2 * plan_of().seconds)


def test_way_back_takes_the_steps_again():
    there, back = plan_of(), plan_of(unloading=True)
    assert back.force_evaluations - there.force_evaluations == pytest.approx(60 * 70 + 14 * 2000)


def test_edges_are_those_of_the_solid_volume():
    plan = plan_of()
    solid = 1000 * 4 / 3 * math.pi * 1e-9
    assert plan.first_edge == pytest.approx((solid / 0.16) ** (1 / 3))
    assert plan.last_edge == pytest.approx(0.6 * plan.first_edge)
    assert (plan.grains, plan.seeds) == (1000, 4)
    assert (plan.smallest_diameter, plan.largest_diameter) == pytest.approx((2e-3, 2e-3))


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


@pytest.mark.parametrize(("stress", "warned"), [(1e6, False), (1e8, True)])
def test_stress_that_presses_grains_deep_is_warned_of(stress, warned):
    # An overlap of 0.00327 of the radius at 1 MPa, in proportion to the stress.
    plan = plan_of(target="mean_stress", value=[1e5, stress])
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
        assert "at the paper's n = 3" in problems[0]
        assert "thermodynamics.ultimate_alpha" in problems[0]
        # <l^3> = 2<R^3> + 6<R><R^2>: 8 mm^3 of one radius; of a uniform one from 0.4 to 1 mm
        # <R> = 0.7, <R^2> = 0.52, <R^3> = 0.406, so 0.812 + 2.184.
        assert "2.67 times as large" in problems[0]


def test_the_fractal_of_a_narrow_sand_is_the_coarser_one():
    # Nearly all of its mass is finer than most of the mass of the fractal.
    narrow = from_percent_finer([0.4e-3, 0.45e-3, 1e-3], [0.0, 95.0, 100.0])
    plan = plan_of(grains=100000, grading=narrow, ultimate=ultimate_grading(narrow, 2.6))
    assert any("the ultimate grading is coarser" in text for text in plan.warnings)


# --- text ----------------------------------------------------------------------------------------


def written(*plans, cores=2):
    return preview_text({f"sample{k}": plan for k, plan in enumerate(plans)}, cores, "0.1")


def test_text_holds_what_a_person_asks_before_a_run():
    text = written(plan_of()._replace(seconds=1200.0, force_evaluations=69000.0, memory=2.34e9))
    for part in (
        "sample0\n",
        "1000, seeds 4",
        "0.002 to 0.002 m",
        "0.1 sqrt(m/k)",
        "about 69 000 a packing",
        "about 10.0 minutes on 2 core(s)",
        "about 2.3 GB a job",
    ):
        assert part in text
    assert "warning" not in text


def test_text_holds_every_warning_of_every_sample():
    plans = [
        plan_of()._replace(warnings=["too coarse", "too deep"]),
        plan_of()._replace(warnings=["too few"]),
    ]
    lines = written(*plans).splitlines()
    found = [line.split("warning")[1].strip() for line in lines if "warning" in line]
    assert found == ["too coarse", "too deep", "too few"]


def test_all_samples_share_the_cores():
    plan = plan_of()._replace(seconds=600.0)
    assert written(plan, plan).endswith("all samples: about 10.0 minutes on 2 core(s)\n")


def test_all_samples_take_as_long_as_all_their_packings():
    short, long = plan_of()._replace(seconds=600.0), plan_of()._replace(seconds=3000.0)
    # 300 and 1500 s on two cores, one after the other.
    assert written(short, long).endswith("all samples: about 30.0 minutes on 2 core(s)\n")


def test_one_packing_runs_on_one_core():
    plan = plan_of(seeds=1)._replace(seconds=600.0)
    text = written(plan, cores=8)
    assert text.count("about 10.0 minutes on 8 core(s)") == 2


def test_the_ranks_of_one_packing_share_the_cores():
    plan = plan_of(seeds=1)._replace(seconds=600.0, ranks=4)
    assert written(plan, cores=8).count("about 2.5 minutes on 8 core(s)") == 2


def test_more_ranks_than_cores_are_warned_of():
    plan = plan_of(seeds=1)._replace(seconds=600.0, ranks=8)
    text = written(plan, cores=2)
    assert "warning             ranks 8, and 2 core(s): 2 are started" in text
    assert "about 5.0 minutes on 2 core(s)" in text


def test_cores_that_no_packing_fits_on_stay_idle():
    plan = plan_of(seeds=8)._replace(seconds=600.0, ranks=3)
    assert "about 3.3 minutes on 4 core(s)" in written(plan, cores=4)


def test_plan_is_a_row_of_plain_values():
    assert all(isinstance(value, int | float | list) for value in plan_of())
    assert isinstance(plan_of(), Plan)
