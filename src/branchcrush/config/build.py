"""The grading that a section of the configuration describes, made of its plain values."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from branchcrush.config.units import UNITS
from branchcrush.errors import GradingError
from branchcrush.files.compression_tables import CompressionTable, read_compression
from branchcrush.files.declared import Declared
from branchcrush.files.grading_tables import (
    read_density_table,
    read_histogram,
    read_radii,
    read_sieve_table,
)
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.forms import (
    fractal,
    fuller,
    lognormal,
    loguniform,
    normal,
    uniform,
    weibull,
)
from branchcrush.gradings.mixtures import from_radii, mixture, single
from branchcrush.gradings.size_fits import D_VALUES, SizeFit, curve_of
from branchcrush.gradings.tables import from_density, from_histogram, from_percent_finer
from branchcrush.packings.sizes import size_problem

# Two sizes of a file that are nearer than this share of them are one.
_SAME = 1e-9


@dataclass(frozen=True)
class GradingValues:
    """The values of a section, its sizes as radii in metres.

    Examples
    --------
    >>> values = GradingValues({"size": "diameter", "unit": "mm", "min": 1.0, "alpha": 2.6})
    >>> values.radius("min"), values["alpha"]
    (0.0005, 2.6)
    """

    section: Mapping[str, Any]

    def __getitem__(self, key: str) -> Any:
        return self.section[key]

    @property
    def to_radius(self) -> float:
        """What a size of the section is multiplied by [m]."""
        return UNITS[self["unit"]] * (0.5 if self["size"] == "diameter" else 1.0)

    @property
    def ends(self) -> tuple[float, float]:
        """The smallest and the largest radius [m]."""
        return self.radius("min"), self.radius("max")

    @property
    def curve(self) -> tuple[float, float]:
        """Median [m] and geometric standard deviation of a lognormal, scale [m] and shape [-]."""
        fit = curve_of(self["form"], self.section)
        return fit.centre * self.to_radius, fit.width

    def radius(self, key: str) -> float:
        """Return the size at a key as a radius [m]."""
        return self[key] * self.to_radius

    @property
    def basis(self) -> str:
        """What values count: grains of one density have the volume of their mass."""
        return "mass" if self["basis"] == "volume" else self["basis"]

    def table(self, read: Callable) -> tuple[np.ndarray, np.ndarray, list[float | None]]:
        """Return the radii of the file [m], its other column, and where it is cut [m], if it is."""
        table = read(self["file"], Declared.of(self.section))
        same = np.flatnonzero(np.diff(table.sizes) <= _SAME * table.sizes[1:])
        if same.size:
            raise GradingError(
                f"{table.sizes[same[0]]:.17g} and {table.sizes[same[0] + 1]:.17g} are one size but "
                "for rounding: remove one of the lines"
            )
        # Before anything is computed of them.
        _refuse_sizes(
            table.sizes[0] * self.to_radius, table.sizes[-1] * self.to_radius, self["unit"]
        )
        ends = [self.section.get(key) for key in ("min", "max")]
        cut = [None if end is None else end * self.to_radius for end in ends]
        return table.sizes * self.to_radius, table.values, cut


def _listed(values: GradingValues) -> Grading:
    radii = read_radii(values["file"]) * values.to_radius
    # Of another code, or of another unit: one size but for rounding, which has no range of sizes.
    alike = radii[-1] - radii[0] <= _SAME * radii[-1]
    return from_radii(np.full(radii.shape, radii[0]) if alike else radii)


def _sieve(values: GradingValues) -> Grading:
    radius, percent, cut = values.table(read_sieve_table)
    return from_percent_finer(radius, percent, *cut)


def _density(values: GradingValues) -> Grading:
    radius, density, cut = values.table(read_density_table)
    # It has any scale, and a sum of the largest numbers is none.
    density = density / max(density.max(), np.finfo(float).tiny)
    per = Declared.of(values.section).taken("per")
    return from_density(radius, density, values.basis, *cut, per=per)


def _histogram(values: GradingValues) -> Grading:
    edges, shares, cut = values.table(read_histogram)
    scale = Declared.of(values.section).taken("scale")
    return from_histogram(edges, shares, values.basis, *cut, scale=scale)


def _mixture(values: GradingValues) -> Grading:
    parts = [grading_of(component["grading"]) for component in values["components"]]
    weights = [component["weight"] for component in values["components"]]
    return mixture(parts, weights, values["basis"])


# How the values of a section make a grading, by its form. A form is added here, with its keys in
# `config.gradings`, and in `gradings.forms`.
FORMS: dict[str, Callable[[GradingValues], Grading]] = {
    "uniform": lambda values: uniform(*values.ends, values["basis"]),
    "loguniform": lambda values: loguniform(*values.ends, values["basis"]),
    "normal": lambda values: normal(
        values.radius("mean"), values.radius("standard_deviation"), *values.ends, values["basis"]
    ),
    "lognormal": lambda values: lognormal(*values.curve, *values.ends, values["basis"]),
    "weibull": lambda values: weibull(*values.curve, *values.ends, values["basis"]),
    "fractal": lambda values: fractal(*values.ends, values["alpha"]),
    "fuller": lambda values: fuller(*values.ends, values["exponent"]),
    "single": lambda values: single(values.radius("value")),
    "sieve": _sieve,
    "density": _density,
    "histogram": _histogram,
    "radii": _listed,
    "mixture": _mixture,
}


def grading_of(section: Mapping[str, Any]) -> Grading:
    """Return the grading that a section of the configuration describes.

    Parameters
    ----------
    section : mapping
        From `model_dump` of a `config.gradings.GradingSection`. Names of files are relative to
        the working directory.

    Returns
    -------
    Grading
        Of the radius [m].

    Raises
    ------
    GradingError
        When a file or what it holds is not usable; one line for each problem. When there is no
        such form.

    Examples
    --------
    >>> section = {"form": "uniform", "size": "diameter", "unit": "mm", "basis": "number"}
    >>> grading_of({**section, "min": 1.0, "max": 2.0}).support()
    (0.0005, 0.001)
    """
    form, file = section["form"], section.get("file")
    if form not in FORMS:
        raise GradingError(f"there is no form of grading called {form!r}")
    try:
        grading = FORMS[form](GradingValues(section))
        if file is not None:
            _refuse_sizes(*grading.support(), section["unit"])
        return grading
    except GradingError as error:
        if file is None or str(file) in str(error):
            raise
        raise GradingError(f"{file}: {error}") from None


def _refuse_sizes(smallest: float, largest: float, unit: str) -> None:
    """Refuse radii of a file that no grain has: keys of sizes are checked one by one."""
    if problem := size_problem(2.0 * smallest, 2.0 * largest):
        raise GradingError(f"{problem}: check the file and the unit, {unit}")


def compression_of(section: Mapping[str, Any]) -> CompressionTable:
    """Return the compression curve that a section of the configuration describes.

    Parameters
    ----------
    section : mapping
        From `model_dump` of a `config.measured.CompressionTest`.

    Returns
    -------
    CompressionTable

    Raises
    ------
    GradingError
        When the file or what it holds is not usable; one line for each problem.

    Examples
    --------
    >>> compression_of({"file": "no.csv", "values": "strain", "stress_unit": "kPa"})
    Traceback (most recent call last):
    branchcrush.errors.GradingError: ...no.csv...
    """
    keys = ("columns", "sheet", "initial_void_ratio")
    return read_compression(
        section["file"],
        section["values"],
        section["stress_unit"],
        **{key: section.get(key) for key in keys},
    )


def unit_of(section: Mapping[str, Any]) -> tuple[str, float, str]:
    """Return the unit that a section gives sizes in, what it is in metres, and what sizes are.

    Parameters
    ----------
    section : mapping
        As for `grading_of`.

    Returns
    -------
    unit : str
        Of a mixture, that of its first part.
    metres : float
        [m]
    size : {"diameter", "radius"}

    Examples
    --------
    >>> unit_of({"form": "single", "size": "radius", "unit": "um", "value": 1.0})
    ('um', 1e-06, 'radius')
    """
    while "components" in section:
        section = section["components"][0]["grading"]
    return section["unit"], UNITS[section["unit"]], section["size"]


def size_fits(section: Mapping[str, Any]) -> dict[str, SizeFit]:
    """Return the curves of a section that are laid through a few sizes.

    Parameters
    ----------
    section : mapping
        As for `grading_of`.

    Returns
    -------
    dict of SizeFit
        Through diameters [m]; by key of the configuration, of which a mixture has several.

    Examples
    --------
    >>> section = {"form": "weibull", "size": "radius", "unit": "mm", "basis": "mass",
    ...            "d10": 1.0, "d90": 3.0, "min": 0.5, "max": 4.0}
    >>> [(key, fit.given) for key, fit in size_fits(section).items()]
    [('grading', (0.002, 0.006))]
    """
    parts = {"grading": section} | {
        f"grading.components.{place}.grading": component["grading"]
        for place, component in enumerate(section.get("components", []))
    }
    fits = {}
    for key, part in parts.items():
        given = [name for name in D_VALUES if part.get(name) is not None]
        if len(given) > 1:
            diameter = 2.0 * GradingValues(part).to_radius
            fits[key] = curve_of(part["form"], {name: part[name] * diameter for name in given})
    return fits
