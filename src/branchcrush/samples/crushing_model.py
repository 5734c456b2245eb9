"""Every form of the crushing model for one elastic law and one resistance."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from branchcrush.crushing.admissibility import admissibility, least_hardening_exponent
from branchcrush.crushing.curves import TabulatedCurve
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.paper_form import reference_energy
from branchcrush.crushing.resistance import CriticalEnergy, ElasticStrainLimit, Resistance
from branchcrush.crushing.yield_line import Control
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.samples.crushing_bands import BANDS, End, with_bands
from branchcrush.samples.crushing_curves import (
    FIXED_CRUSHING,
    complete_or,
    events_table,
    form_curves,
    form_table,
    history_curves,
)
from branchcrush.samples.elastic_law import (
    MeasuredElasticity,
)
from branchcrush.samples.forms_of_sample import (
    FormsOfSample,
    degenerate,
    untested,
)
from branchcrush.statistics.intervals import Interval

History = tuple[Control, NDArray]
# The columns of `thermodynamics.csv` but form, some of which only some rows have.
_CURVES = (
    "path",
    "volumetric_strain",
    "elastic_strain",
    "crushing",
    "elastic_energy_J_per_m3",
    "reference_energy_J_per_m3",
    "free_energy_J_per_m3",
    "stress_Pa",
    *BANDS,
    "driving_force_J_per_m3",
    "resistance_J_per_m3",
    "dissipated_J_per_m3",
    "plastic_work_J_per_m3",
    "work_J_per_m3",
    "tangent_stiffness_Pa",
)
# What is told of each form, and of that on the front again at the top.
_OF_A_FORM = (
    "admissible",
    "inadmissible_from",
    "least_hardening_exponent",
    "hardens_at_onset",
    "yield_strain",
    "yield_stress_Pa",
    "yields_on_path",
    "crushing_at_end",
)


def crushing_model(
    forms: FormsOfSample,
    measured: MeasuredElasticity,
    exponent: Interval,
    reference_length: float,
    law: LinearContact | HertzContact,
    settings: Mapping[str, Any],
    history: History | None = None,
    ends: Sequence[End] = (),
) -> tuple[pd.DataFrame, pd.DataFrame, dict, pd.DataFrame]:
    """Return the curves of every form, its table, what is to be known of them, and the events.

    Parameters
    ----------
    forms : FormsOfSample
    measured : MeasuredElasticity
    exponent : Interval
        n of the energy split.
    reference_length : float
        l_r [m]; it cancels in all but psi_r.
    law : LinearContact or HertzContact
    settings : mapping
        The keys of the section thermodynamics.
    history : tuple, optional
        What loads are, "strain" or "stress", and the loads, in turn [-] or [Pa].
    ends : sequence of (ModelForm, Elasticity)
        The form on the front at the ends of intervals, for its bands.

    Returns
    -------
    curves, table : DataFrame
    summary : dict
    events : DataFrame
    """
    resistance = resistance_of(forms, law, settings)
    curves, tables, events, told = [], [], [], {}
    for name, form in forms.made.items():
        found = _told(form, measured, resistance, forms.sentences.get(name, []))
        end = found["inadmissible_from"]
        fixed = [at for at in FIXED_CRUSHING if end is None or at < end]
        rows, evolution = form_curves(form, measured.law, resistance, measured.largest, fixed)
        of_form = [events_table(form, measured.law, evolution).assign(path="crushing")]
        if history is not None:
            own, of_own, sentence = _own_history(form, measured, resistance, history)
            rows = pd.concat([rows, own], ignore_index=True)
            of_form.append(of_own)
            found["sentences"] += sentence
        if name == settings["form"]:
            rows = with_bands(rows, ends, resistance, history, len(measured.ends_without_law))
        events += [part.assign(form=name) for part in of_form]
        if name == "paper":
            energy = rows["elastic_energy_J_per_m3"]
            rows["reference_energy_J_per_m3"] = reference_energy(
                energy, forms.initial_moment, exponent.estimate, reference_length
            )
        curves.append(rows.assign(form=name))
        tables.append(
            form_table(form, measured.law, resistance, measured.jamming, measured.largest).assign(
                form=name
            )
        )
        told[name] = {
            "reason": None,
            **found,
            "crushing_at_end": complete_or(evolution.crushing.max()).item(),
        }
    nothing = {**dict.fromkeys(told[next(iter(told))]), "snaps": [], "sentences": []}
    for name, reason in forms.missing.items():
        told[name] = {**nothing, "reason": reason}
    front = told[settings["form"]]
    theta = 1.0 - forms.ultimate_moment / forms.initial_moment
    summary = {
        "form": settings["form"],
        "form_reason": front["reason"],
        "network": settings["network"],
        "resistance": settings["resistance"],
        **exponent.named("exponent"),
        "theta": theta,
        "initial_moment": forms.initial_moment,
        "ultimate_moment": forms.ultimate_moment,
        "paper_degenerate": degenerate(theta),
        "untested": untested(forms, law),
        "reference_length_m": reference_length,
        **measured.summary(),
        "rod_map_solid_fraction": float(forms.path.solid_fraction[0]),
        "critical_energy_J_per_m3": settings["critical_energy"],
        "hardening_exponent": settings["hardening_exponent"],
        "elastic_strain": settings["elastic_strain"],
        "strength_exponent": settings["strength_exponent"],
        **{key: front[key] for key in _OF_A_FORM},
        "forms": {name: told[name] for name in forms.names},
    }
    order = ["form", "path", *events[0].columns.drop(["form", "path"])]
    happened = pd.concat(events, ignore_index=True)[order]
    return _ordered(curves), _ordered(tables), summary, happened


def _own_history(
    form: ModelForm, measured: MeasuredElasticity, resistance: Resistance, history: History
) -> tuple[pd.DataFrame, pd.DataFrame, list[str]]:
    """Return the rows and the events of the user's history, and what is to be known of it."""
    try:
        rows, evolution = history_curves(form, measured.law, resistance, *history)
    except ValueError as error:
        return pd.DataFrame(), pd.DataFrame(), [f"The history is not followed: {error}."]
    beyond = int((rows["elastic_strain"] > measured.largest * (1.0 + 1e-9)).sum())
    told = []
    if beyond:
        told.append(
            f"{beyond} of {len(rows)} loads of the history press beyond the packings' largest "
            f"elastic strain, {measured.largest:.4f}: there the elastic law rests on no packing."
        )
    events = events_table(form, measured.law, evolution).assign(path="history")
    return rows, events, told


def resistance_of(
    forms: FormsOfSample, law: LinearContact | HertzContact, settings: Mapping[str, Any]
) -> Resistance:
    r"""Return what holds crushing back, as configured.

    .. math:: \epsilon_e = \epsilon_0 \left(\frac{d_Q}{d_{Q0}}\right)^x, \qquad
        x = 1 - b \text{ or } -2b/3

    Parameters
    ----------
    forms : FormsOfSample
        With d_Q of the network along its path.
    law : LinearContact or HertzContact
        With a constant stiffness x is 1 - b, with Hertz's contacts -2b/3.
    settings : mapping
        The keys of the section thermodynamics.

    Returns
    -------
    Resistance
    """
    if settings["resistance"] == "critical_energy":
        return CriticalEnergy(settings["critical_energy"], settings["hardening_exponent"])
    strength = settings["strength_exponent"]
    power = -2.0 * strength / 3.0 if isinstance(law, HertzContact) else 1.0 - strength
    change = forms.path.contact_diameter**power
    known = tuple(forms.path.crushing.tolist())
    return ElasticStrainLimit(
        settings["elastic_strain"], TabulatedCurve(known, tuple(change.tolist()))
    )


def _told(
    form: ModelForm,
    measured: MeasuredElasticity,
    resistance: Resistance,
    sentences: Sequence[str],
) -> dict[str, Any]:
    """Return what is told of a form."""
    found = admissibility(form, measured.law, resistance, measured.largest)
    strain = float(resistance.yield_strain(0.0, form, measured.law))
    end = found.costs[0][0] if found.costs else None
    # What costs energy from the beginning on never begins, at whatever strain it would yield.
    yields = np.isfinite(strain) and end != 0.0
    least = None
    if yields and isinstance(resistance, CriticalEnergy):
        least = least_hardening_exponent(form, measured.law, strain)
    stays = form.jamming.value(form.knots[-1]) == 1.0
    return {
        "theta": 1.0 - float(form.factor.value(1.0)) if stays else None,
        "admissible": found.admissible,
        "inadmissible_from": end,
        "snaps": [snap.crushing for snap in found.snaps],
        "least_hardening_exponent": least,
        "hardens_at_onset": found.hardens_at_onset if yields else None,
        "yield_strain": strain if yields else None,
        "yield_stress_Pa": float(measured.law.pressure(strain)) if yields else None,
        "yields_on_path": bool(yields and strain < measured.largest),
        "sentences": [*found.sentences, *sentences],
    }


def _ordered(parts: Sequence[pd.DataFrame]) -> pd.DataFrame:
    """Return tables of all forms as one, the name of the form first."""
    together = pd.concat(parts, ignore_index=True)
    order = [column for column in _CURVES if column in together]
    others = [column for column in together if column not in ("form", *order)]
    return together[["form", *order, *others]]
