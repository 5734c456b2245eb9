"""What the rows of `findings.csv` say together: which samples are on which side of a question."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from branchcrush.energy.predictors import PREDICTORS
from branchcrush.energy.split import PAPER_EXPONENT
from branchcrush.statistics.intervals import Interval

# How near a prediction of branch lengths is called good: Kolmogorov-Smirnov distance.
GOOD_DISTANCE = 0.06
READINGS = ("contact", "grain", "volume", "branch")
CLAIMS = ("supported", "contradicted", "undecided", "no_such")
SIDES = ("holds", "below", "above", "too_wide", "no_interval")


def verdicts(rows: Sequence[Mapping[str, Any]]) -> dict[str, list[str]]:
    """Return which samples are on which side of each question.

    Parameters
    ----------
    rows : list of dict
        From `study.findings.finding_row`, or of `findings.csv` with None where there is no number.

    Returns
    -------
    dict
        Lists of names: `known` samples; `one_state`, those that have no other state than the end;
        three_<at_end, at_distance>_<side>, the `SIDES` by the interval of n; `power_law_fails`, by
        that of the curvature; best_<predictor> at the end; reduced_radius_better and
        grain_size_worse than branch length, by the paired interval; lengths_good and lengths_bad,
        by the distance of random parking near jamming; and claim_<reading>_<claim>, of `READINGS`
        and `CLAIMS`.

    Examples
    --------
    >>> row = {"sample": "sand", "exponent_at_end": 2.5}
    >>> row |= {"exponent_at_end_low": 2.4, "exponent_at_end_high": 2.6}
    >>> verdicts([row])["three_at_end_below"]
    ['sand']
    """

    def names(condition):
        return [row["sample"] for row in rows if condition(row)]

    answers = {
        "known": names(lambda row: _told(row.get("exponent_at_end"))),
        "one_state": names(_has_one_state),
    }
    for place in ("at_end", "at_distance"):
        for side in SIDES:
            answers[f"three_{place}_{side}"] = names(
                lambda row, place=place, side=side: _side_of_three(row, place) == side
            )
    answers["power_law_fails"] = names(
        lambda row: _told(_low(row, "curvature")) and not _holds(row, "curvature", 0.0)
    )
    for name in PREDICTORS:
        if name != "surface":
            answers[f"best_{name}"] = names(
                lambda row, name=name: row.get("best_predictor_end") == name
            )
    better = "reduced_radius_over_length_low_end"
    worse = "grain_size_over_length_high_end"
    answers["reduced_radius_better"] = names(lambda row: _above(row.get(better), 0.0))
    answers["grain_size_worse"] = names(lambda row: _below(row.get(worse), 0.0))
    parking = "ks_parking_near"
    answers["lengths_bad"] = names(lambda row: _above(row.get(parking), GOOD_DISTANCE))
    answers["lengths_good"] = names(
        lambda row: _told(row.get(parking)) and not _above(row.get(parking), GOOD_DISTANCE)
    )
    for reading in READINGS:
        for claim in CLAIMS:
            answers[f"claim_{reading}_{claim}"] = names(
                lambda row, reading=reading, claim=claim: _claim(row, reading) == claim
            )
    return answers


def _has_one_state(row: Mapping) -> bool:
    return _told(row.get("coordination_number_end")) and not _told(row.get("mean_length_near_m"))


def _side_of_three(row: Mapping, place: str) -> str | None:
    """Return one of `SIDES`, None where there is no exponent."""
    n = Interval.read(row, f"exponent_{place}")
    if not _told(n.estimate):
        return None
    if not _told(n.low) or not _told(n.high):
        return "no_interval"
    if n.is_wide:
        return "too_wide"
    if n.high < PAPER_EXPONENT:
        return "below"
    return "above" if n.low > PAPER_EXPONENT else "holds"


def _claim(row: Mapping, reading: str) -> str | None:
    answer = row.get(f"shielding_claim_per_{reading}")
    return "no_such" if answer in ("no such grain", "no such branch") else answer


def _low(row: Mapping, name: str) -> float | None:
    return row.get(f"{name}_low_end")


def _holds(row: Mapping, name: str, value: float) -> bool:
    return row[f"{name}_low_end"] <= value <= row[f"{name}_high_end"]


def _above(value: float | None, limit: float) -> bool:
    return _told(value) and value > limit


def _below(value: float | None, limit: float) -> bool:
    return _told(value) and value < limit


def _told(value: float | None) -> bool:
    return value is not None and bool(np.isfinite(value))
