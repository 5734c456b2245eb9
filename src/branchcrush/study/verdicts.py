"""What the rows of `findings.csv` say together: which samples are on which side of a question."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeGuard

import numpy as np

from branchcrush.energy.predictors import PREDICTORS
from branchcrush.energy.split import PAPER_EXPONENT
from branchcrush.statistics.intervals import Interval
from branchcrush.study.results import NOT_CERTIFIED

# How near a prediction of branch lengths is called good: Kolmogorov-Smirnov distance.
GOOD_DISTANCE = 0.06
# Where n is asked for, and on which side of the paper's its interval may be.
PLACES = ("at_end", "at_distance")
SIDES = ("holds", "below", "above", "too_wide", "no_interval")
# What shielding is claimed of, and how the data answer.
READINGS = ("contact", "grain", "volume", "branch")
CLAIMS = ("supported", "contradicted", "undecided", "no_such")
ANSWERS = (
    "not_certified",
    "known",
    "one_state",
    *(f"three_{place}_{side}" for place in PLACES for side in SIDES),
    "power_law_fails",
    *(f"best_{name}" for name in PREDICTORS),
    "reduced_radius_better",
    "grain_size_worse",
    "lengths_good",
    "lengths_bad",
    *(f"claim_{reading}_{claim}" for reading in READINGS for claim in CLAIMS),
)


def verdicts(rows: Sequence[Mapping[str, Any]]) -> dict[str, list[str]]:
    """Return which samples give each answer.

    Parameters
    ----------
    rows : list of dict
        From `study.findings.finding_row`, or of `findings.csv` with None where there is no number.

    Returns
    -------
    dict
        Lists of names, one for each of `ANSWERS`: `one_state`, samples that have no other state
        than the end; `not_certified`, which no list below counts; `known` samples;
        three_<place>_<side>, by the interval of n; `power_law_fails`, by that of the curvature at
        the end; best_<predictor> at the end; reduced_radius_better and grain_size_worse than
        branch length, by the paired interval; lengths_good and lengths_bad, by the distance of
        random parking near jamming; and claim_<reading>_<claim>.

    Examples
    --------
    >>> row = {"sample": "sand", "verdict": "certified", "exponent_at_end": 2.5}
    >>> row |= {"exponent_at_end_low": 2.4, "exponent_at_end_high": 2.6}
    >>> verdicts([row])["three_at_end_below"]
    ['sand']
    """
    names: dict[str, list[str]] = {answer: [] for answer in ANSWERS}
    for row in rows:
        for answer in _answers(row):
            names[answer].append(row["sample"])
    return names


def _answers(row: Mapping[str, Any]) -> Iterator[str]:
    if _told(row.get("coordination_number_end")) and not _told(row.get("mean_length_near_m")):
        yield "one_state"
    if row["verdict"] == NOT_CERTIFIED:
        yield "not_certified"
        return
    if _told(row.get("exponent_at_end")):
        yield "known"
    for place in PLACES:
        n = Interval.read(row, f"exponent_{place}")
        if _told(n.estimate):
            yield f"three_{place}_{_side_of_three(n)}"
    low, high = row.get("curvature_low_end"), row.get("curvature_high_end")
    if _told(low) and _told(high) and not low <= 0.0 <= high:
        yield "power_law_fails"
    if row.get("best_predictor_end"):
        yield f"best_{row['best_predictor_end']}"
    low = row.get("reduced_radius_over_length_low_end")
    if _told(low) and low > 0.0:
        yield "reduced_radius_better"
    high = row.get("grain_size_over_length_high_end")
    if _told(high) and high < 0.0:
        yield "grain_size_worse"
    distance = row.get("ks_parking_near")
    if _told(distance):
        yield "lengths_good" if distance <= GOOD_DISTANCE else "lengths_bad"
    for reading in READINGS:
        answer = row.get(f"shielding_claim_per_{reading}")
        if answer:
            claim = "no_such" if answer in ("no such grain", "no such branch") else answer
            yield f"claim_{reading}_{claim}"


def _side_of_three(n: Interval) -> str:
    if not _told(n.low) or not _told(n.high):
        return "no_interval"
    if n.is_wide:
        return "too_wide"
    if n.high < PAPER_EXPONENT:
        return "below"
    return "above" if n.low > PAPER_EXPONENT else "holds"


def _told(value: Any) -> TypeGuard[float]:
    return value is not None and bool(np.isfinite(value))
