"""All samples of a study beside each other: what their numbers say together."""

import numpy as np

from branchcrush.branches.coordination_laws import jamming_law_fit
from branchcrush.energy.split import PAPER_EXPONENT
from branchcrush.statistics.intervals import LIMITS, Interval, Resampling, interval_names
from branchcrush.study.exponents import at_distance, crossing

# How near a prediction of branch lengths is called good: Kolmogorov-Smirnov distance.
GOOD_DISTANCE = 0.06
# Where tails of the forces begin, in mean forces.
_TAIL = 2.0
# Explained deviances less apart than this are the same but for rounding.
_TIED = 1e-6


def finding_row(name, kind, fit, numbers, shared, path, states, distance, intervals):
    """Return the row of `findings.csv` of a sample.

    Parameters
    ----------
    name : str
    kind : SampleKind
    fit, numbers, shared : dict
        `energy_split.json`, `contact_numbers.json` and `sharing.json`.
    path : DataFrame
        `energy_split_path.csv`.
    states : DataFrame
        `coordination.csv` of the sample.
    distance : float
        From `study.exponents.common_distance` [-].
    intervals : dict
        confidence and resamples.

    Returns
    -------
    dict
        Only what a sample has data for; `reason` then says why.
    """
    row = {
        "sample": name,
        "boundary": kind.boundary,
        "contact_law": kind.law,
    }
    reasons = [part["reason"] for part in (fit, numbers, shared) if part.get("reason")]
    row["reason"] = reasons[0] if reasons else None
    if "reason" not in fit:
        row |= _exponents(fit, path, distance)
        row |= _split(fit, "end")
        row |= _split(fit["near_jamming"], "near")
    if "reason" not in numbers:
        row |= _lengths(numbers)
        row |= _coordination(numbers, states, intervals)
    if "reason" not in shared:
        row |= _shared(shared["end"])
    return row


def _exponents(fit, path, distance):
    row = {"seeds": fit["seeds"], "solid_fraction": fit["solid_fraction"]}
    row["distance_at_end"] = float(path["solid_fraction_above_jamming"].iloc[-1])
    row |= _renamed(fit, "exponent", "exponent_at_end")
    row["distance"] = distance
    row |= at_distance(path, distance).named("exponent_at_distance")
    row["distance_of_exponent_3"] = crossing(path)
    return row


def _renamed(result, name, new):
    """Return an estimate and its limits of a result under another name, None where it has none."""
    keys = zip(interval_names(new), interval_names(name), strict=True)
    return {to: result.get(key) for to, key in keys}


def _split(fit, where):
    row = {}
    bend = fit["curvature"]
    for name in interval_names("curvature"):
        row[f"{name}_{where}"] = bend.get(name)
    known = {p["name"]: p for p in fit["predictors"] if "reason" not in p}
    for name, predictor in known.items():
        row[f"explained_{name}_{where}"] = predictor["explained_deviance"]
        if name in ("reduced_radius", "grain_size"):
            for part in LIMITS:
                key = f"difference_to_branch_length{part}"
                row[f"{name}_over_length{part}_{where}"] = predictor.get(key)
    for name in ("branch_length", "reduced_radius"):
        if name in known:
            exponent = Interval(**known[name]["parameters"]["exponent"])
            for part, value in zip(LIMITS, exponent, strict=True):
                row[f"exponent_of_{name}{part}_{where}"] = value
    # Of those with one exponent or two: the full surface is the ceiling, no rival.
    scored = {
        name: p["explained_deviance"]
        for name, p in known.items()
        if name != "surface" and p["explained_deviance"] is not None
    }
    ranked = sorted(scored, key=scored.get, reverse=True)
    # With two lengths of branches, or none apart, all say the same.
    tied = len(ranked) < 2 or scored[ranked[0]] - scored[ranked[1]] < _TIED
    row[f"best_predictor_{where}"] = None if tied else ranked[0]
    return row


def _lengths(numbers):
    near = numbers["near_jamming"]
    row = {
        "distance_near": near["solid_fraction_above_jamming"],
        "mean_length_near_m": near["mean_length_m"],
    }
    for prediction in near["predictions"]:
        row[f"ks_{prediction['name']}_near"] = prediction["kolmogorov_smirnov"]
    for prediction in numbers["end"]["predictions"]:
        if prediction["name"] in ("random_contact", "parking", "configuration"):
            row[f"ks_{prediction['name']}_end"] = prediction["kolmogorov_smirnov"]
    for name in interval_names("assortativity_of_radii"):
        row[name] = numbers["end"].get(name)
    return row


def _coordination(numbers, states, intervals):
    seeds = [seed for _, seed in states.groupby("seed_number")]
    found = jamming_law_fit(
        [seed["solid_fraction_above_jamming"] for seed in seeds],
        [seed["mechanical_coordination_number"] for seed in seeds],
        isostatic=[seed["isostatic_number"] for seed in seeds],
        **intervals,
        rng=Resampling.FINDINGS.rng(),
    )
    laws = {
        f"jamming_law_{name}": found[name]
        for kind in ("prefactor", "exponent")
        for name in interval_names(kind)
    }
    return {
        "coordination_number_near": numbers["near_jamming"]["coordination_number"],
        "rattler_fraction_near": numbers["near_jamming"]["rattler_fraction"],
        "coordination_number_end": numbers["end"]["coordination_number"],
        **laws,
    }


def _shared(end):
    shielding, forces = end["shielding"], end["forces"]
    tails = {tail["threshold"]: tail for tail in forces["tails"]}
    branches = shielding["branches"]
    row = {name: branches.get(name) for name in interval_names("shielding_exponent")}
    for name in (*interval_names("unequal_over_equal"), "radius_ratio_to", "unequal_branches"):
        row[f"shielding_{name}"] = branches.get(name)
    row["shielding_claim_per_branch"] = branches.get("claim")
    for name in ("largest_neighbour_ratio", "neighbour_ratio_from", "grains"):
        row[f"shielding_{name}"] = shielding["grains"][name]
    for reading in ("contact", "grain", "volume"):
        for name in interval_names(f"energy_per_{reading}"):
            row[f"shielding_{name}"] = shielding["grains"][name]
        row[f"shielding_claim_per_{reading}"] = shielding["grains"][f"claim_per_{reading}"]
    # Of all grains it is no power of the radius, as rattlers hold nothing.
    for name in interval_names("exponent_load_bearing"):
        row[f"grain_energy_{name}"] = shielding["grain_energy"].get(name)
    for name in interval_names("exponent"):
        row[f"force_{name}"] = forces["by_length"].get(name)
    for name in (*interval_names("decay_rate"), *interval_names("squared_variation")):
        row[f"force_tail_{name}"] = tails[_TAIL][name]
    for kind in ("branches", "forces"):
        for name in ("deviator_over_expected", "by_chance_low", "by_chance_high"):
            row[f"fabric_{kind}_{name}"] = end["fabric"][kind][name]
    for name in (*interval_names("coarse_half_stress_share"), *interval_names("sharing_index")):
        row[name] = end["stress"][name]
    return row


def verdicts(rows):
    """Return what the rows say together: which samples are on which side of each question.

    Parameters
    ----------
    rows : list of dict
        From `finding_row`.

    Returns
    -------
    dict
        Lists of names: `known` samples; three_<at_end, at_distance>_<holds, below, above>, by the
        interval of n; `power_law_fails`, by that of the curvature; best_<predictor> at the end;
        reduced_radius_better and grain_size_worse than branch length, by the paired interval;
        lengths_good and lengths_bad, by the distance of random parking near jamming; and
        claim_<contact, grain, volume, branch>_<supported, contradicted, undecided, no_such>.
    """
    found = {"known": [row["sample"] for row in rows if row.get("exponent_at_end") is not None]}

    def sort(key, row, condition):
        found.setdefault(key, [])
        if condition:
            found[key].append(row["sample"])

    for row in rows:
        for place in ("at_end", "at_distance"):
            low, high = (row.get(f"exponent_{place}{part}") for part in ("_low", "_high"))
            told = _told(low, high)
            sort(f"three_{place}_holds", row, told and low <= PAPER_EXPONENT <= high)
            sort(f"three_{place}_below", row, told and high < PAPER_EXPONENT)
            sort(f"three_{place}_above", row, told and low > PAPER_EXPONENT)
        low, high = row.get("curvature_low_end"), row.get("curvature_high_end")
        sort("power_law_fails", row, _told(low, high) and not low <= 0.0 <= high)
        for name in ("branch_length", "reduced_radius", "both_radii", "grain_size"):
            sort(f"best_{name}", row, row.get("best_predictor_end") == name)
        low = row.get("reduced_radius_over_length_low_end")
        sort("reduced_radius_better", row, _told(low) and low > 0.0)
        high = row.get("grain_size_over_length_high_end")
        sort("grain_size_worse", row, _told(high) and high < 0.0)
        distance = row.get("ks_parking_near")
        sort("lengths_good", row, _told(distance) and distance <= GOOD_DISTANCE)
        sort("lengths_bad", row, _told(distance) and distance > GOOD_DISTANCE)
        for reading in ("contact", "grain", "volume", "branch"):
            answer = row.get(f"shielding_claim_per_{reading}")
            for claim in ("supported", "contradicted", "undecided"):
                sort(f"claim_{reading}_{claim}", row, answer == claim)
            nothing = answer in ("no such grain", "no such branch")
            sort(f"claim_{reading}_no_such", row, nothing)
    return found


def _told(*values):
    return all(value is not None and np.isfinite(value) for value in values)
