"""The sample that plain settings describe, as a job uses it."""

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

from branchcrush.breakage.rules import Breakage
from branchcrush.breakage.strength import Strength
from branchcrush.config.build import grading_of
from branchcrush.files.grading_tables import read_radii
from branchcrush.loading.sample import Sample
from branchcrush.loading.targets import Loading
from branchcrush.packings.contact_laws import contact_law


def number_of_grains(settings: Mapping[str, Any]) -> int:
    """Return how many grains a sample has: what it says, or as many as its list.

    Parameters
    ----------
    settings : mapping
        With grading and grains of `config.schema.Sample.settings`.

    Returns
    -------
    int

    Raises
    ------
    GradingError
        When the list cannot be read.

    Examples
    --------
    >>> number_of_grains({"grading": {"form": "uniform"}, "grains": 10})
    10
    """
    grains = settings["grains"]
    return len(read_radii(settings["grading"]["file"])) if grains is None else grains


def sample_of(settings: Mapping[str, Any]) -> Sample:
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
    known = {field.name for field in fields(Sample)} - {"grading", "grains", "loading", "seeds"}
    return Sample(
        grading=grading_of(settings["grading"]),
        grains=number_of_grains(settings),
        law=contact_law(**settings["contact"]),
        loading=Loading(**settings["loading"]),
        seeds=tuple(settings.get("seeds", ())),
        **{key: value for key, value in settings.items() if key in known},
    )


def breakage_of(settings: Mapping[str, Any]) -> Breakage:
    """Return how the grains of a sample break, from plain settings.

    Parameters
    ----------
    settings : mapping
        Of `config.breakage.Breakage.plain`.

    Returns
    -------
    Breakage

    Examples
    --------
    >>> rules = breakage_of({"strength": 2e7, "weibull_modulus": 3.0, "reference_diameter": 1e-3,
    ...                      "size_exponent": 1.0, "smallest_diameter": 2.5e-4, "fragments": 20})
    >>> rules.strength.weibull_modulus, rules.fragments
    (3.0, 20)
    """
    of_strength = {field.name for field in fields(Strength)}
    rest = {key: value for key, value in settings.items() if key not in of_strength}
    strength = Strength(**{key: settings[key] for key in of_strength})
    return Breakage(strength=strength, **rest)
