"""What a job makes of its plain settings: the grading that a section describes, the sample."""

from collections.abc import Mapping
from dataclasses import fields

from branchcrush.config.units import UNITS
from branchcrush.errors import GradingError
from branchcrush.files.grading_tables import read_density_table, read_radii, read_sieve_table
from branchcrush.gradings import forms, mixtures, tables
from branchcrush.loading.sample import Sample
from branchcrush.loading.targets import Loading
from branchcrush.packings.contact_laws import contact_law


def grading_of(section):
    """Return the grading that a section of the configuration describes.

    Parameters
    ----------
    section : dict
        From `model_dump` of a `config.gradings.GradingSection`. Names of files are relative to
        the working directory.

    Returns
    -------
    Grading
        Of the radius [m].

    Raises
    ------
    GradingError
        When a file or what it holds is not usable; one line for each problem.

    Examples
    --------
    >>> section = {"form": "uniform", "size": "diameter", "unit": "mm", "basis": "number"}
    >>> grading_of({**section, "min": 1.0, "max": 2.0}).support()
    (0.0005, 0.001)
    """
    if section["form"] == "mixture":
        parts = [grading_of(component["grading"]) for component in section["components"]]
        weights = [component["weight"] for component in section["components"]]
        return mixtures.mixture(parts, weights, section["basis"])
    to_radius = UNITS[section["unit"]] * (0.5 if section["size"] == "diameter" else 1.0)
    if "file" in section:
        return _from_file(section, to_radius)

    def radius(key):
        return section[key] * to_radius

    if section["form"] == "single":
        return mixtures.single(radius("value"))
    ends, by = (radius("min"), radius("max")), section["basis"]
    match section["form"]:
        case "uniform":
            return forms.uniform(*ends, by)
        case "loguniform":
            return forms.loguniform(*ends, by)
        case "normal":
            return forms.normal(radius("mean"), radius("standard_deviation"), *ends, by)
        case "lognormal":
            width = section["geometric_standard_deviation"]
            return forms.lognormal(radius("median"), width, *ends, by)
        case "weibull":
            return forms.weibull(radius("scale"), section["shape"], *ends, by)
        case "fractal":
            return forms.fractal(*ends, section["alpha"])
        case "fuller":
            return forms.fuller(*ends, section["exponent"])
    raise GradingError(f"there is no form of grading called {section['form']!r}")


def _from_file(section, to_radius):
    path, form = section["file"], section["form"]
    if form == "radii":
        return mixtures.from_radii(read_radii(path) * to_radius)
    ends = section.get("min"), section.get("max")
    radius_ends = [None if end is None else end * to_radius for end in ends]
    try:
        if form == "sieve":
            opening, percent = read_sieve_table(path, *ends)
            return tables.from_percent_finer(opening * to_radius, percent, *radius_ends)
        if form == "density":
            size, density = read_density_table(path, *ends)
            by = section["basis"]
            return tables.from_density(size * to_radius, density, by, *radius_ends)
    except GradingError as error:
        named = str(error) if str(path) in str(error) else f"{path}: {error}"
        raise GradingError(named) from None
    raise GradingError(f"there is no form of grading called {form!r}")


def sample_of(settings: Mapping) -> Sample:
    """Return the sample that plain settings describe.

    Parameters
    ----------
    settings : mapping
        Of `config.schema.Sample.settings`, all of it or what a rule is given of it.

    Returns
    -------
    Sample

    Raises
    ------
    GradingError
        When a file of the grading is not usable.

    Examples
    --------
    >>> grading = {"form": "single", "size": "radius", "unit": "mm", "value": 1.0}
    >>> sample = sample_of({"grading": grading, "sampling": "random", "grains": 10,
    ...                     "boundary": "periodic", "initial_solid_fraction": 0.2,
    ...                     "contact": {"law": "linear", "normal_stiffness": 1e6},
    ...                     "loading": {"target": "solid_fraction", "value": 0.7},
    ...                     "strain_step": 1e-3})
    >>> sample.periodic, sample.end, sample.law.name
    (True, 0.7, 'linear')
    """
    known = {field.name for field in fields(Sample)} - {"grading", "loading", "seeds"}
    return Sample(
        grading=grading_of(settings["grading"]),
        law=contact_law(**settings["contact"]),
        loading=Loading(**settings["loading"]),
        seeds=tuple(settings.get("seeds", ())),
        **{key: value for key, value in settings.items() if key in known},
    )
