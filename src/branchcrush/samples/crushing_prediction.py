"""Rule crushing_predicted: a sample's crushing without a simulation, beside the simulated one."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from branchcrush.branches.crushing_gradings import STEP, crushing_gradings
from branchcrush.breakage.rules import Breakage
from branchcrush.errors import FitError
from branchcrush.gradings.distribution import Grading
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.samples.crushed_line import YIELDED
from branchcrush.samples.crushing_predicted import (
    QUANTITIES,
    beside_predicted,
    predicted_states,
)

_POINTS = 60
# What the sentence of the errors tells, and in which words.
_TOLD = {
    "grains_ratio": "the number of grains",
    "broken_mass_fraction": "the broken mass",
    "einav_breakage": "Einav's B",
    "mean_stress_Pa": "the stress",
    "dissipated_J_per_m3": "what is lost",
    "coordination_number": "the coordination number",
}
_BETWEEN_WALLS = (
    "The prediction is of a packing without walls; between walls a packing is looser, the more so "
    "the fewer grains it has, so that errors are also those of the walls."
)


class CrushingPrediction(NamedTuple):
    """The result files of the prediction."""

    predicted: pd.DataFrame  # crushing_predicted.csv
    beside: pd.DataFrame  # crushing_beside_predicted.csv
    summary: dict  # crushing_predicted.json


def crushing_prediction(
    grading: Grading,
    law: LinearContact | HertzContact,
    rules: Breakage,
    measured: Mapping[int, pd.DataFrame],
    *,
    walls: bool,
    confidence: float = 0.95,
    step: float = STEP,
) -> CrushingPrediction:
    """Return what is predicted of a crushing from strengths and contacts, and how far it is off.

    Parameters
    ----------
    grading : Grading
        That was asked for.
    law : LinearContact or HertzContact
    rules : Breakage
    measured : mapping of int to DataFrame
        From `measured_states`, by seed.
    walls : bool
        Whether the packings are between walls, of which the prediction knows nothing.
    confidence : float
        Of the intervals over seeds [-].
    step : float
        Of ln(phi) [-].

    Returns
    -------
    CrushingPrediction
        Tables without rows, and the reason in the summary, where nothing can be predicted.
    """
    said = [_BETWEEN_WALLS] if walls else []
    common = set.intersection(*(set(rows["state"]) for rows in measured.values()))
    if not common:
        return _nothing("no state that all seeds have carries load", measured, said)
    end = max(float(rows["solid_fraction"].max()) for rows in measured.values())
    try:
        path = crushing_gradings(grading, law, rules, end, step=step)
    except (FitError, ValueError) as error:
        return _nothing(str(error), measured, said)
    # To the end itself: of a power of the step it would differ by rounding.
    phi = np.append(np.linspace(path.solid_fraction[0], end, _POINTS)[:-1], path.solid_fraction[-1])
    predicted = predicted_states(path, rules, phi)
    beside = beside_predicted(predicted, measured, confidence)
    errors = prediction_errors(beside)
    summary = _summary(len(measured), None, float(path.jamming[0]), errors)
    return CrushingPrediction(
        predicted, beside, {**summary, "sentences": [_errors_sentence(errors), *said]}
    )


def prediction_errors(beside: pd.DataFrame) -> pd.DataFrame:
    r"""Return errors of the prediction of each quantity, over the states that yield.

    .. math:: \mathrm{rms} = \sqrt{\langle \ln^2(\mathrm{predicted}/\mathrm{measured}) \rangle}

    Parameters
    ----------
    beside : DataFrame
        From `beside_predicted`.

    Returns
    -------
    DataFrame
        A row for each quantity: quantity, states that were compared, states_asked that yield,
        rms_ln, bias_ln [-]; nan where no state was compared.

    Examples
    --------
    >>> rows = [(7, name, 0.2, 0.1) for name in QUANTITIES]
    >>> table = pd.DataFrame(rows, columns=["state", "quantity", "measured", "error"])
    >>> prediction_errors(table)[["states", "states_asked", "rms_ln"]].to_numpy()[0].tolist()
    [1.0, 1.0, 0.1]
    """
    broken = beside[beside["quantity"] == "broken_mass_fraction"]
    yields = set(broken.loc[broken["measured"] >= YIELDED, "state"])
    here = beside[beside["state"].isin(yields)]
    rows = []
    for quantity in QUANTITIES:
        error = here.loc[here["quantity"] == quantity, "error"].dropna()
        rows.append(
            {
                "quantity": quantity,
                "states": len(error),
                "states_asked": len(yields),
                "rms_ln": float(np.sqrt((error**2).mean())),
                "bias_ln": float(error.mean()),
            }
        )
    return pd.DataFrame(rows)


def _nothing(
    reason: str, measured: Mapping[int, pd.DataFrame], said: list[str]
) -> CrushingPrediction:
    """Return tables without rows, and why."""
    path = ["solid_fraction", "void_ratio", "jamming_solid_fraction", *QUANTITIES]
    of_beside = ["state", "solid_fraction", "quantity", "predicted", "measured", "measured_low"]
    beside = pd.DataFrame(columns=[*of_beside, "measured_high", "seeds", "error"])
    summary = _summary(len(measured), reason, None, prediction_errors(beside))
    sentences = [f"Nothing is predicted without a simulation: {reason}.", *said]
    return CrushingPrediction(
        pd.DataFrame(columns=path), beside, {**summary, "sentences": sentences}
    )


def _summary(
    seeds: int, reason: str | None, jamming: float | None, errors: pd.DataFrame
) -> dict[str, Any]:
    """Return the keys of `crushing_predicted.json` but its sentences."""
    told = {"reason": reason, "seeds": seeds, "jamming_solid_fraction": jamming}
    told["states_that_yield"] = int(errors["states_asked"].iloc[0])
    for row in errors.to_dict("records"):
        told |= {f"{row['quantity']}_{key}": row[key] for key in ("states", "rms_ln", "bias_ln")}
    return told


def _errors_sentence(errors: pd.DataFrame) -> str:
    """Return how far the prediction is off, in words."""
    asked, rows = int(errors["states_asked"].iloc[0]), errors.set_index("quantity")
    if not asked:
        return (
            "What grading, contacts and strengths alone predict is not judged: nowhere "
            f"{YIELDED:.0%} of the mass is broken."
        )
    known = [name for name in _TOLD if rows.loc[name, "states"]]
    if not known:
        return (
            "What grading, contacts and strengths alone predict is not judged: it begins beyond "
            "the states that yield."
        )
    compared = int(rows.loc[known, "states"].max())
    off = [f"{_TOLD[name]} {100.0 * np.expm1(rows.loc[name, 'rms_ln']):.0f} %" for name in known]
    return (
        "Grading, contacts and strengths alone, without a simulation and with nothing fitted to "
        f"crushing, predict within (root mean square of the logarithm, {compared} of {asked} "
        f"states that yield): {', '.join(off)}."
    )
