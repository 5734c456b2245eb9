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
    MeasuredElasticity,
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
    front, of_exponent, ends = settings["form"], [], []
    if front in forms.made:
        of_exponent = at_ends_of_exponent(
            front, forms.path, initial, ultimate, fit.exponent, numbers
        )
        ends = [(forms.made[front], law_at_end) for law_at_end in measured.ends.values()]
        ends += [(form, measured.law) for form in of_exponent]
    curves, table, summary, events = crushing_model(
        forms, measured, fit.exponent, fit.reference_length, law, settings, history, ends
    )
    elastic = elastic_law_table(loading, measured)
    summary["rearrangement"] = rearrangement_sentence(elastic)
    summary["bands"] = bands_sentence(measured, len(of_exponent) > 0, front)
    return CrushingResults(curves, table, summary, events, elastic)


def bands_sentence(measured: MeasuredElasticity, of_exponent: bool, front: str) -> str:
    """Return what the bands of the form on the front hold.

    Parameters
    ----------
    measured : MeasuredElasticity
    of_exponent : bool
        Whether the form was made at both ends of the interval of n.
    front : str
        Name of the form.

    Returns
    -------
    str
    """
    without = measured.ends_without_law
    if len(without) == 2:
        low, high = without.values()
        return (
            f"The curves have no bands: φ_J is known to lie between {low:.4f} and {high:.4f}, but "
            "from neither end is there an elastic law."
        )
    names = [name for name, there in (("φ_J", measured.ends), ("n", of_exponent)) if there]
    if not names:
        return "The curves have no bands: no interval of φ_J or n is known that they rest on."
    of_which = f"at both ends of the interval of {' and of '.join(names)}, one at a time"
    if without:
        ((side, limit),) = without.items()
        lower, upper = ("lower", "upper") if side == "low" else ("upper", "lower")
        of_which = (
            f"at the {upper} end of the interval of φ_J"
            f"{' and both of that of n, one at a time' if of_exponent else ''}"
            f"; from the {lower} end, {limit:.4f}, there is no elastic law, and the side of the "
            "bands that it would give is empty"
        )
    no_exponent = (
        "" if of_exponent else f"; n is not in the form {front}, or its interval not known"
    )
    return (
        f"Bands are the least and the largest of the curves computed again {of_which}"
        f"{no_exponent}; they are empty where a load is too large for the law at an end."
    )
