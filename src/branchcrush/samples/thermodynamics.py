"""Rule thermodynamics: every form of the crushing model on the elastic energy of a sample."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import pandas as pd

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.errors import FitError
from branchcrush.files.tables import no_data
from branchcrush.gradings.curves import ultimate_grading
from branchcrush.gradings.distribution import Grading
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.samples.crushing_model import History, crushing_model
from branchcrush.samples.elastic_law import (
    certified_jamming,
    measured_elasticity,
)
from branchcrush.samples.ensemble import certified_loading, on_the_way_in
from branchcrush.samples.forms_of_sample import (
    at_ends_of_exponent,
    forms_of,
)
from branchcrush.samples.rearrangement import elastic_law_table, rearrangement_sentence


class CrushingResults(NamedTuple):
    """The result files of the crushing model; a table is a dict where there is none, with why."""

    curves: pd.DataFrame | dict  # thermodynamics.csv
    forms: pd.DataFrame | dict  # crushing_forms.csv
    summary: dict  # thermodynamics.json
    events: pd.DataFrame | dict  # crushing_events.csv
    elastic: pd.DataFrame | dict  # elastic_law.csv


def crushing_results(
    fit: EnergySplitFit,
    certificate: pd.DataFrame,
    paths: Sequence[pd.DataFrame],
    initial: Grading,
    law: LinearContact | HertzContact,
    numbers: pd.DataFrame,
    settings: Mapping[str, Any],
    jamming: pd.DataFrame,
    history: History | None = None,
    confidence: float = 0.95,
) -> CrushingResults:
    """Return the crushing model of a sample, in all its forms.

    Parameters
    ----------
    fit : EnergySplitFit
    certificate : DataFrame
        `certificate.csv`.
    paths : list of DataFrame
        The `path.csv` of each seed.
    initial : Grading
        Target.
    law : LinearContact or HertzContact
    numbers : DataFrame
        `contact_numbers.csv`.
    settings : mapping
        The keys of the section thermodynamics.
    jamming : DataFrame
        `jamming.csv`.
    history : tuple, optional
        What loads are, "strain" or "stress", and the loads, in turn [-] or [Pa].
    confidence : float
        Of the interval of phi_J [-].

    Returns
    -------
    CrushingResults
    """
    try:
        if fit.reason is not None:
            raise FitError(fit.reason)
        used, _ = certified_loading(certificate, paths)
        ultimate = ultimate_grading(initial, settings["ultimate_alpha"])
        if ultimate is None:
            raise FitError(
                "grains of a single size have no finer grading of their range to crush to"
            )
        loading = on_the_way_in(paths, used)
        measured = measured_elasticity(
            loading,
            certified_jamming(jamming, used, confidence),
            kind=settings["elasticity"],
            pressure_exponent=settings["pressure_exponent"],
            reference_pressure=settings["reference_pressure"],
        )
        forms = forms_of(initial, ultimate, fit.exponent.estimate, law, numbers, settings)
    except FitError as error:
        nothing, summary = no_data(error)
        return CrushingResults(nothing, nothing, summary, nothing, nothing)
    front, ends = settings["form"], []
    if front in forms.made:
        of_exponent = at_ends_of_exponent(
            front, forms.path, initial, ultimate, fit.exponent, numbers
        )
        ends = [(forms.made[front], law_at_end) for law_at_end in measured.ends]
        ends += [(form, measured.law) for form in of_exponent]
    curves, table, summary, events = crushing_model(
        forms, measured, fit.exponent, fit.reference_length, law, settings, history, ends
    )
    elastic = elastic_law_table(loading, measured)
    summary["rearrangement"] = rearrangement_sentence(elastic)
    summary["bands"] = _bands_sentence(len(measured.ends), len(ends) - len(measured.ends), front)
    return CrushingResults(curves, table, summary, events, elastic)


def _bands_sentence(of_jamming: int, of_exponent: int, front: str) -> str:
    """Return what the bands of the form on the front hold."""
    names = [name for name, ends in (("φ_J", of_jamming), ("n", of_exponent)) if ends > 0]
    if not names:
        return "The curves have no bands: no interval of φ_J or n is known that they rest on."
    without = "" if of_exponent else f"; n is not in the form {front}, or its interval not known"
    return (
        "Bands are the least and the largest of the curves computed again at both ends of the "
        f"interval of {' and of '.join(names)}, one at a time{without}; "
        "they are empty where a load is too large for the law at an end."
    )
