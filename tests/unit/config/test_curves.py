"""Lognormal and Weibull sections laid through D10, D50 and D90."""

import pytest

from branchcrush.config.build import grading_of, size_fits
from tests.unit.config.sections import VALID, checked, message_of, section_with

# --- curves through sizes ------------------------------------------------------------------------

NOTHING = dict.fromkeys(["median", "geometric_standard_deviation", "scale", "shape"])


def through(form, **keys):
    return section_with(form, **{**NOTHING, "min": 0.1, "max": 9.0, "unit": "mm", **keys})


def test_three_sizes_make_the_lognormal_of_their_regression():
    # Even in the logarithm: the median is 2, and sigma_g^1.28155 = 2.
    section = checked(through("lognormal", d10=1.0, d50=2.0, d90=4.0)).model_dump(exclude_none=True)
    direct = section_with(
        "lognormal",
        min=0.1,
        max=9.0,
        median=2.0,
        geometric_standard_deviation=2 ** (1 / 1.2815515655),
    )
    made, expected = (grading_of(part) for part in (section, checked(direct).model_dump()))
    shares = [0.01, 0.1, 0.5, 0.9, 0.99]
    assert made.mass_ppf(shares) == pytest.approx(expected.mass_ppf(shares), rel=1e-8)


@pytest.mark.parametrize("size", ["radius", "diameter"])
@pytest.mark.parametrize("basis", ["number", "mass"])
def test_sizes_are_radii_or_diameters_by_number_or_by_mass_as_declared(size, basis):
    # 10 % and 90 % of a Weibull of scale 1 and shape 2, hardly cut.
    sizes = {"d10": 0.324592846, "d90": 1.517427129}
    keys = through("weibull", size=size, basis=basis, min=1e-4, max=6.0, **sizes)
    grading = grading_of(checked(keys).model_dump(exclude_none=True))
    shares = (grading.number_cdf if basis == "number" else grading.mass_cdf)(
        [factor * (1.0 if size == "radius" else 0.5) * 1e-3 for factor in (0.324592846, 1.0)]
    )
    assert shares == pytest.approx([0.1, 0.632120559], abs=1e-6)


def test_d50_is_the_median_of_a_lognormal():
    keys = {"d50": 2.0, "geometric_standard_deviation": 1.5}
    section = checked(through("lognormal", **keys)).model_dump(exclude_none=True)
    direct = section_with("lognormal", min=0.1, max=9.0)
    assert grading_of(section).mass_ppf(0.3) == grading_of(checked(direct).model_dump()).mass_ppf(
        0.3
    )


@pytest.mark.parametrize(
    ("form", "keys", "given"),
    [
        ("lognormal", {}, "none is given"),
        ("lognormal", {"d50": 1.0}, "d50 is given"),
        ("lognormal", {"d10": 1.0, "d50": 2.0, "geometric_standard_deviation": 2.0}, "are given"),
        ("lognormal", {"d10": 1.0, "d50": 2.0, "median": 2.0}, "median and d10 and d50 are given"),
        ("weibull", {"d50": 1.0, "shape": 2.0}, "shape and d50 are given"),
        ("weibull", {"scale": 1.0, "d10": 0.5, "d90": 2.0}, "scale and d10 and d90 are given"),
    ],
)
def test_too_few_or_too_many_keys_for_a_curve_are_refused_with_all_ways(form, keys, given):
    message = message_of(through(form, **keys))
    assert message.startswith("grading: must have ")
    assert "two or three of d10, d50, d90" in message and message.endswith(given)


def test_sizes_that_do_not_grow_are_named():
    message = message_of(through("weibull", d50=2.0, d90=2.0))
    assert message == "grading.d90 = 2 mm: must be above d50 2 mm"


def test_missing_ends_are_asked_for_with_advice():
    # D50 = 2 and D90 = 4, so 1 % and 99 % are at 2 * 2^(2.32635/1.28155) and its like: 7.04, 0.568.
    message = message_of(through("lognormal", d50=2.0, d90=4.0, min=None, max=None))
    assert message.startswith("grading: must have min, the smallest grain and max, the largest")
    assert message.endswith("so for example min: 0.568, max: 7.04")
    message = message_of(through("lognormal", d50=200.0, d90=400.0, unit="um", min=50.0, max=None))
    assert message.endswith("coarser than 704 um, so for example max: 704")


def test_ends_that_miss_a_curve_through_sizes_are_refused():
    message = message_of(through("lognormal", d10=1.0, d90=1.1, min=5.0, max=9.0))
    assert message.startswith("grading: with median 1.04881 mm only 0 of the distribution")


def test_a_curve_that_misses_its_sizes_is_refused():
    message = message_of(through("lognormal", d10=0.1, d50=2.0, d90=2.2))
    assert message.startswith(
        "grading: no lognormal curve passes near these sizes: given D10 = 0.1"
    )


def test_the_fit_is_told_in_diameters_of_metres_also_of_a_part():
    section = checked(through("lognormal", size="radius", d10=1.0, d50=2.0, d90=4.4)).model_dump(
        exclude_none=True
    )
    (fit,) = size_fits(section).values()
    assert fit.given == pytest.approx((2e-3, 4e-3, 8.8e-3))
    # A third and two thirds of ln(sqrt(4.4)/2).
    assert fit.misfits == pytest.approx([1.1 ** (k / 6) - 1 for k in (-1, 2, -1)], rel=1e-6)
    parts = [{"weight": 1.0, "grading": VALID["single"]}, {"weight": 1.0, "grading": section}]
    assert list(size_fits({"form": "mixture", "basis": "mass", "components": parts})) == [
        "grading.components.1.grading"
    ]
    assert size_fits(VALID["lognormal"]) == {}
