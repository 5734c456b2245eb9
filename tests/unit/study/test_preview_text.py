"""The preview as text: what a person asks before a run, in the unit of their own."""

import math
from dataclasses import replace

import pytest

from branchcrush.gradings.forms import uniform
from branchcrush.gradings.mixtures import mixture, single
from branchcrush.gradings.size_fits import fit_sizes
from branchcrush.loading.sample import Sample
from branchcrush.loading.targets import Loading
from branchcrush.packings.contact_laws import LinearContact
from branchcrush.study.preview import sample_plan
from branchcrush.study.preview_text import duration, fixed_seconds, preview_text

SAMPLE = Sample(
    grading=single(1e-3),
    sampling="random",
    grains=1000,
    boundary="walls",
    initial_solid_fraction=0.16,
    law=LinearContact(1e6),
    loading=Loading("edge_reduction", 0.4),
    strain_step=1.7e-3,
    seeds=(1, 2, 3, 4),
    refined_seeds=1,
)


def plan_of(unit=("mm", 1e-3), fits=None, ultimate=None, grading=None, **keys):
    sample = replace(SAMPLE, **keys, **({"grading": grading} if grading else {}))
    radii = [1e-3] * sample.grains
    return sample_plan(sample, radii, 1e-7, ultimate, unit=unit, fits=fits)


def written(*plans, cores=2, notes=None):
    named = {f"sample{k}": plan for k, plan in enumerate(plans)}
    pictures = {name: f"results/figures/{name}/preview.png" for name in named}
    return preview_text(named, cores, pictures, notes or {})


def words(text):
    return " ".join(text.split())


def test_text_holds_what_a_person_asks_before_a_run():
    plan = plan_of()._replace(seconds=1200.0, force_evaluations=69000.0, memory=2.34e9)
    text = words(written(plan))
    for part in (
        "sample0: 1000 grains, 4 packings, 1 of them again with twice the strain steps, six rigid",
        "diameters [mm] min D10 D30 D50 D60 D90 max",
        "by mass 2 2 2 2 2 2 2 drawn 2 2 2 2 2 2 2 by number 2",
        "C_u, C_c 1, 1; drawn 1, 1",
        "100 drawn; the 10 largest drawn have 1 % of the mass",
        "coincide to a hundredth of a %",
        "edge_reduction 0.4, solid fraction 0.16 to 0.741; 15 saved states from 0.55 on",
        "69 000 force evaluations a packing",
        "compression about 10 min on 2 cores",
        "about 2.3 GB a job",
        "picture results/figures/sample0/preview.png",
    ):
        assert part in text


@pytest.mark.parametrize(
    ("sample", "expected"),
    [
        # Equal spheres of 2 mm: 0.95 carry load, at 0.640.
        (
            {},
            "finest that do are 2 mm in diameter; they jam at a solid fraction of 0.640 with 5.7",
        ),
        ({}, "all this of a periodic cell: between walls they jam looser"),
        # 0.741 at the end: kappa* = 6 + 7.8 sqrt(0.101) = 8.48, and 0.97 of the grains carry load.
        ({"boundary": "periodic"}, "8.2 at the end of the loading (rods that push, "),
        ({}, "(rods that push, whatever thermodynamics.network is)"),
        (
            {"boundary": "periodic", "loading": Loading("edge_reduction", 0.3)},
            "the loading ends before that, perhaps without load",
        ),
        (
            {"boundary": "periodic", "loading": Loading("mean_stress", [1e5])},
            "rattlers counted; how many at the end depends on how far the stresses compress them",
        ),
    ],
)
def test_text_says_which_grains_will_carry_load(sample, expected):
    text = words(written(plan_of(**sample)))
    assert "of your grains 95 % will carry load (by mass 95 %)" in text
    assert expected in text


def test_a_sample_takes_no_more_than_25_lines_of_96_characters():
    lines = written(plan_of(grading=uniform(2e-4, 1e-3), ultimate=uniform(1e-4, 1e-3))).splitlines()
    assert len(lines) <= 25
    assert max(map(len, lines)) <= 96


@pytest.mark.parametrize(
    ("unit", "expected"),
    [(("um", 1e-6), "2000"), (("inch", 0.0254), "0.0787"), (("m", 1), "0.002")],
)
def test_sizes_are_in_the_unit_of_the_user(unit, expected):
    text = words(written(plan_of(unit=unit)))
    assert f"diameters [{unit[0]}]" in text
    assert f"by mass {' '.join([expected] * 7)}" in text
    # (1000 * 4/3 pi mm3 / 0.16)^(1/3) = 29.69 mm, which a strain of 0.4 makes 17.8 mm.
    edges = [float(f"{edge / unit[1]:.3g}") for edge in (29.6933e-3, 17.816e-3)]
    assert f"edge {edges[0]:g} {unit[0]}, at the end about {edges[1]:g} {unit[0]}" in text


def test_box_and_warning_have_one_measure_of_the_largest_diameter():
    # 0.05 % of the mass are twice as large: D99.9 is 2 mm, the maximum 4 mm, and <R^3>
    # 1/(0.9995 + 0.0005/8) mm3. So the cube of 100 grains has 8.2707 mm at phi = 0.7407.
    tail = mixture([single(1e-3), single(2e-3)], [0.9995, 0.0005], "mass")
    text = words(written(plan_of(grading=tail, grains=100)))
    assert "at the end about 8.27 mm, 4.14 largest diameters (D99.9)" in text
    assert "make a box of 4.14 largest diameters" in text


def test_stresses_are_told_with_the_overlaps_they_lead_to():
    # An overlap of 0.00327 of the radius at 1 MPa, in proportion to the stress.
    loading = Loading("mean_stress", [1e5, 3e5, 1e6], unloading=True)
    text = words(written(plan_of(loading=loading)))
    assert "3 saved states at mean stress 0.1, 0.3, 1 MPa, and back through the same" in text
    assert "overlaps at the last about 0.33 % of the radius" in text
    many = Loading("mean_stress", [1e2, 2e2, 3e2, 4e2, 5e3])
    assert "5 saved states at mean stress 0.1 to 5 kPa;" in words(written(plan_of(loading=many)))


def test_a_curve_through_sizes_is_told_with_what_it_misses():
    # Of D10 = 1, D50 = 2 and D90 = 4 * 1.2^3 the ends are missed by 1.2^-0.5, the middle by 1.2.
    fit = fit_sizes("lognormal", {10.0: 1e-3, 50.0: 2e-3, 90.0: 4e-3 * 1.2**3})
    text = words(written(plan_of(fits={"grading": fit})))
    assert "curve lognormal, median 2.4 mm" in text
    assert "D10 0.9129 for 1 (-8.7 %), D50 2.4 for 2 (+20.0 %), D90 6.31 for 6.912 (-8.7 %)" in text


def test_warnings_say_what_they_lead_to():
    plans = [
        plan_of()._replace(warnings=["too coarse -> no curves", "too deep"]),
        plan_of()._replace(warnings=["too few"]),
    ]
    lines = written(*plans).splitlines()
    found = [line.split("warning")[1].strip() for line in lines if line.startswith("  warning")]
    assert found == ["too coarse -> no curves", "too deep", "too few"]


# --- time ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("seconds", "expected"),
    [
        (0.2, "less than 1 s"),
        (31.4, "31 s"),
        (99.0, "99 s"),
        (100.0, "2 min"),
        (5940.0, "99 min"),
        (5990.0, "1.7 h"),
        (36000.0, "10.0 h"),
    ],
)
def test_short_times_are_in_seconds(seconds, expected):
    assert duration(seconds) == expected


def test_fixed_costs_are_those_of_all_jobs_and_the_figures():
    # Five packings and ten other jobs, one of them for the refined packing, of 1.2 s each; 7 s.
    assert fixed_seconds(plan_of()) == pytest.approx(15 * 1.2 + 7)
    assert fixed_seconds(plan_of(refined_seeds=0)) == pytest.approx(13 * 1.2 + 7)


def test_all_samples_take_their_packings_their_jobs_and_the_start():
    # 3 s to start, 4 jobs of all samples; 50 s and 25 s of each sample on two cores.
    plan = plan_of()._replace(seconds=50.0)
    assert "about 45 s, half" in written(plan)
    assert "about 83 s, half" in written(plan, plan)
    assert written(plan, plan).splitlines()[-1].endswith("on 2 cores")


def test_one_packing_runs_on_one_core():
    plan = plan_of(seeds=(1,))._replace(seconds=600.0)
    assert "compression about 10 min on 8 cores" in written(plan, cores=8)
    assert "all samples together: about 10 min" in written(plan, cores=8)


def test_the_ranks_of_one_packing_share_the_cores():
    plan = plan_of(seeds=(1,), ranks=4)._replace(seconds=600.0)
    assert "compression about 2 min on 8 cores" in written(plan, cores=8)


def test_more_ranks_than_cores_are_warned_of():
    plan = plan_of(seeds=(1,), ranks=8)._replace(seconds=600.0)
    text = written(plan, cores=2)
    assert "warning        ranks 8, and 2 core(s) -> 2 are started" in text
    assert "compression about 5 min on 2 cores" in text


def test_cores_that_no_packing_fits_on_stay_idle():
    plan = plan_of(seeds=tuple(range(8)), ranks=3)._replace(seconds=1800.0)
    assert "compression about 10 min on 4 cores" in written(plan, cores=4)


def test_a_time_that_is_not_known_says_why():
    plan = plan_of()._replace(seconds=math.nan)
    text = words(written(plan, notes={"sample0": "the cell is too small"}))
    assert "time not known, since no trial could be made: the cell is too small" in text
    assert text.endswith("all samples together: not known, on 2 cores")


def test_text_says_that_no_grain_will_carry_load():
    plan = plan_of()._replace(carrying=None)
    assert "load not known: rods that push find no grain of this grading" in words(written(plan))
