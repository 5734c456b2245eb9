"""What the grains of a crushing show, in sentences."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from branchcrush.statistics.intervals import Interval, interval_text

_NAMES = {
    "stress_over_strength": "stress over strength",
    "stress": "stress without the strength",
    "largest_force": "largest force",
    "contacts": "number of contacts",
    "radius": "radius",
    "energy": "elastic energy of its contacts",
    "split_energy": "energy by the paper's split of its branches",
}


def grains_sentences(summary: Mapping[str, Any], results: Mapping[str, pd.DataFrame]) -> list[str]:
    """Return one sentence for each finding on the grains of a crushing.

    Parameters
    ----------
    summary : mapping
        seeds, comminution_limit_m, breakages, breakages_seen_in_a_state.
    results : mapping of str to DataFrame
        The tables of `crushed_grains.CrushedGrains`, by name.

    Returns
    -------
    list of str
    """
    seen, number = summary["breakages_seen_in_a_state"], summary["breakages"]
    if not seen:
        return ["No grain broke between saved states: nothing is told of who breaks."]
    limit, seeds = summary["comminution_limit_m"] * 1e3, len(summary["seeds"])
    sentences = [
        f"{number} grains broke ({seeds} {'seed' if seeds == 1 else 'seeds'}, comminution limit "
        f"{limit:.3g} mm); {number - seen} of them were made and broke between two saved states "
        "and are not among what follows on who breaks and who survives."
    ]
    sentences += _foretold(results["areas"])
    sentences += _hazard(results["hazards"])
    sentences += _left(results["survivors"])
    sentences += _split(results["exponents"])
    sentences += _strengths(results["overshoots"])
    return sentences


def _foretold(areas: pd.DataFrame) -> list[str]:
    of_all = areas[areas["among"] == "bearing"].set_index("foreteller")
    if not of_all["breakages"].max():
        return []
    words = []
    for name, title in _NAMES.items():
        row = of_all.loc[name]
        area = Interval.read(row, "area")
        told = {
            "more": "the more of it, the sooner a grain breaks",
            "less": "the less of it, the sooner a grain breaks",
            "undecided": "its direction is not decided",
        }[row["direction"]]
        words.append(f"{title}: {interval_text(*area)}, {told}")
    return [
        "Area under the ROC curve (1/2: by chance) among grains of one state that carry load: "
        + "; ".join(words)
        + "."
    ]


def _hazard(table: pd.DataFrame) -> list[str]:
    of = table[(table["group"] == "large") & (table["by"] == "contacts")]
    few, many = (of[of["low"] == low] for low in (4, 12))
    if not (len(few) and len(many)):
        return ["Too few large grains have 4 to 5 or 12 to 19 contacts to tell of shielding."]
    few, many = few.iloc[0], many.iloc[0]
    a, b = (Interval.read(one, "hazard") for one in (few, many))
    if b.high < a.low:
        verdict = "large grains with many contacts break less: they are shielded"
    elif b.low > a.high:
        verdict = "large grains with many contacts break more: they are not shielded"
    else:
        verdict = "whether many contacts shield a large grain is not decided"
    return [
        "Of the large grains (radius above half of the largest) break from one state to the next "
        f"{_percent(a)} with 4 to 5 contacts, {_percent(b)} with 12 to 19: {verdict}."
    ]


def _left(table: pd.DataFrame) -> list[str]:
    of = table[table["by"] == "radius"]
    if len(of) < 2:
        return ["First grains are of one radius: whether large ones survive is not told."]
    small, large = (Interval.read(of.iloc[place], "share") for place in (0, -1))
    apart = small.high < large.low or large.high < small.low
    return [
        f"Of the first grains are left {_percent(small)} of the smallest third and "
        f"{_percent(large)} of the largest: "
        + ("they differ." if apart else "whether they differ is not decided.")
    ]


def _percent(value: Interval) -> str:
    """Return a share in whole percent; without an interval where the seeds tell none."""
    share, *limits = (100.0 * part for part in value)
    if np.isnan(limits).any():
        return f"{share:.0f} % (no interval)"
    return f"{share:.0f} % ({limits[0]:.0f} to {limits[1]:.0f} %)"


def _split(table: pd.DataFrame) -> list[str]:
    known = table[np.isfinite(table["exponent"])] if "exponent" in table else table
    if not len(known):
        return ["No state of the crushing bears an exponent of the energy split."]
    last = known.iloc[-1]
    own, control = (Interval.read(last, name) for name in ("exponent", "control_exponent"))
    words = (
        f"At φ = {last['solid_fraction']:.3f}, with {100.0 * last['broken_mass_fraction']:.0f} % "
        f"of the mass in fragments, the exponent n is {interval_text(*own)}"
    )
    if not np.isfinite(control.estimate):
        return [words + "; the packing that does not break has no state of this solid fraction."]
    apart = own.low > control.high or own.high < control.low
    return [
        f"{words}, that of the packing that does not break {interval_text(*control)}: "
        + ("they differ." if apart else "whether they differ is not decided.")
    ]


def _strengths(table: pd.DataFrame) -> list[str]:
    if not len(table):
        return []
    row = table.iloc[0]
    return [
        f"Grains broke at stresses {100.0 * row['median_overshoot']:.0f} % above their strength "
        f"(median; 90 % of them within {100.0 * row['overshoot_90']:.0f} %), "
        f"{int(row['below']) or 'none'} below it: strain steps and avalanches overshoot."
    ]
