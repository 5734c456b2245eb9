"""What is asked of the keys of a curve as a whole: enough of them for one, and ends that fit it."""

import math
from collections.abc import Callable, Mapping
from typing import Any, Literal

from branchcrush.config.fields import refusal
from branchcrush.errors import GradingError
from branchcrush.gradings.size_fits import CURVES, D_VALUES, curve_of

# What may be given of a curve.
_WAYS = {
    "lognormal": "median with geometric_standard_deviation, d50 with geometric_standard_deviation, "
    "or two or three of d10, d50, d90",
    "weibull": "scale with shape, or two or three of d10, d50, d90",
}


def check_curve(curve: Literal["lognormal", "weibull"], data: Mapping[str, Any]) -> None:
    """Refuse the keys of a section that are too few or too many for one curve, or miss it.

    Parameters
    ----------
    curve : {"lognormal", "weibull"}
    data : mapping
        All keys of the section that are valid, None where they are left out.

    Raises
    ------
    PydanticCustomError
        From `refusal`, with sizes to cut the curve at where these are missing.

    Examples
    --------
    >>> none = dict.fromkeys(["d10", "d50", "d90", "min", "max"])
    >>> curve = {**none, "unit": "mm", "scale": 2.0, "shape": 1.5}
    >>> check_curve("weibull", {**curve, "min": 1.0, "max": 3.0})
    >>> check_curve("weibull", {**curve, "min": 0.1})
    Traceback (most recent call last):
    pydantic_core._pydantic_core.PydanticCustomError: must have max, the largest grain: 1 % of ...
    """
    keys = (*CURVES[curve], *D_VALUES)
    # One that is wrong is not in the data, and was given all the same.
    given = [key for key in keys if data.get(key, "wrong") is not None]
    ways = [list(CURVES[curve])]
    if curve == "lognormal":
        ways.append(["geometric_standard_deviation", "d50"])
    sizes = [key for key in given if key in D_VALUES]
    if given not in ways and not (given == sizes and len(sizes) > 1):
        which = f"{' and '.join(given)} {'are' if len(given) > 1 else 'is'} given"
        raise refusal(
            f"must have {_WAYS[curve]}; {which if given else 'none is given'}", of_section=True
        )
    # A key that is wrong is told of by itself.
    if not {"min", "max", "unit", *given} <= set(data):
        return
    try:
        fit = curve_of(curve, data)
    except GradingError as error:
        raise refusal(str(error), of_section=True) from None
    _check_ends(data, fit)
    centre, width = CURVES[curve]
    names = {"lognormal": ("lognorm", "s"), "weibull": ("weibull_min", "c")}[curve]
    shape = math.log(fit.width) if curve == "lognormal" else fit.width
    check_share(
        names[0],
        {**data, centre: fit.centre},
        centre,
        lambda at: {names[1]: shape, "scale": at},
        of_section=data.get(width) is None,
    )


def _check_ends(data, fit):
    """Refuse a curve without its smallest or largest grain, and say where it may be cut."""
    missing = [key for key in ("min", "max") if data[key] is None]
    if not missing:
        return
    which = {"min": "the smallest grain", "max": "the largest grain"}
    unit, (low, high) = data["unit"], (float(f"{end:.3g}") for end in fit.advised_ends)
    advised = {"min": f"finer than {low:g} {unit}", "max": f"coarser than {high:g} {unit}"}
    example = {"min": f"min: {low:g}", "max": f"max: {high:g}"}
    raise refusal(
        f"must have {' and '.join(f'{key}, {which[key]}' for key in missing)}: 1 % of the curve is "
        f"{' and 1 % '.join(advised[key] for key in missing)}, so for example "
        f"{', '.join(example[key] for key in missing)}",
        of_section=True,
    )


def check_share(
    distribution: str,
    data: Mapping[str, Any],
    centre: str,
    parameters: Callable[[float], Mapping[str, float]],
    unit_of_width: str = "",
    *,
    of_section: bool = False,
) -> None:
    """Refuse a distribution that hardly reaches between min and max, if these are known.

    Parameters
    ----------
    distribution : str
        Its name in `scipy.stats`.
    data : mapping
        The keys that are valid.
    centre : str
        Key of its median, mean or scale.
    parameters : callable
        Takes the centre and returns SciPy's parameters.
    unit_of_width : str
        Of the key that is validated.
    of_section : bool
        Whether the section is at fault, and no key of it alone.

    Raises
    ------
    PydanticCustomError
        From `refusal`.

    Examples
    --------
    >>> data = {"min": 8.0, "max": 9.0, "unit": "mm", "mean": 1.0}
    >>> check_share("norm", data, "mean", lambda mean: {"loc": mean, "scale": 0.1})
    Traceback (most recent call last):
    pydantic_core._pydantic_core.PydanticCustomError: with mean 1 mm only 0 of the distribution ...
    """
    if not {"min", "max", "unit", centre} <= set(data):
        return
    # Every job reads the configuration; few of them need what SciPy takes seconds to import.
    from scipy import stats

    from branchcrush.gradings.truncation import LEAST_SHARE, share_within

    low, high, at, unit = data["min"], data["max"], data[centre], data["unit"]
    share = share_within(getattr(stats, distribution)(**parameters(at)), low, high)
    if not share >= LEAST_SHARE:
        raise refusal(
            f"with {centre} {at:.6g} {unit} only {share:.2g} of the distribution lies between min "
            f"{low:g} {unit} and max {high:g} {unit}; at least {LEAST_SHARE:g} must: move them or "
            "check the unit",
            unit=unit_of_width,
            of_section=of_section,
        )
