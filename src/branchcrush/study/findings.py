"""All samples of a study beside each other: the rows of `findings.csv`."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from branchcrush.branches.coordination_laws import jamming_law_fit
from branchcrush.energy.state_fit import FittedPredictor, StateFit
from branchcrush.statistics.intervals import LIMITS, Interval, interval_names
from branchcrush.statistics.resampling import Resampling
from branchcrush.study.exponents import at_distance, common_distance, crossing
from branchcrush.study.results import SampleResults

# Where tails of the forces begin, in mean forces.
_TAIL = 2.0
# Explained deviances less apart than this are the same but for rounding.
_TIED = 1e-6
_UNKNOWN = Interval(*3 * [float("nan")])


def finding_rows(
    samples: Sequence[SampleResults], *, confidence: float, resamples: int
) -> list[dict[str, Any]]:
    """Return the rows of `findings.csv`, a row a sample.

    Parameters
    ----------
    samples : list of SampleResults
    confidence : float
        Of the intervals of the jamming law [-].
    resamples : int
        Draws of the seeds for them.

    Returns
    -------
    list of dict
        From `finding_row`, all at one distance from jamming, which every certified sample reaches.
    """
    known = [sample for sample in samples if sample.fit.reason is None]
    certified = [sample for sample in known if sample.is_certified]
    distance = common_distance([sample.path for sample in certified or known])
    options = {"confidence": confidence, "resamples": resamples}
    return [finding_row(sample, distance, options) for sample in samples]


def finding_row(
    sample: SampleResults, distance: float, intervals: Mapping[str, Any]
) -> dict[str, Any]:
    """Return the row of `findings.csv` of a sample.

    Parameters
    ----------
    sample : SampleResults
    distance : float
        From `study.exponents.common_distance` [-].
    intervals : dict
        confidence and resamples.

    Returns
    -------
    dict
        Only what a sample has data for; `reason` then says why. A sample of one state has nothing
        near jamming: no column ends in _near.
    """
    row = {
        "sample": sample.name,
        "boundary": sample.kind.boundary,
        "contact_law": sample.kind.law,
        "verdict": sample.certificate["verdict"],
        "verdict_reasons": "; ".join(sample.certificate["reasons"]) or None,
        "reason": sample.reason,
    }
    if sample.fit.reason is None:
        row |= _exponents(sample, distance)
        row |= _split(sample.fit.end, "end")
        if sample.fit.near_jamming is not None:
            row |= _split(sample.fit.near_jamming, "near")
    if "reason" not in sample.numbers:
        row |= _lengths(sample.numbers)
        row |= _coordination(sample.numbers)
        row |= _jamming_law(sample.states, intervals)
    if "reason" not in sample.shared:
        row |= _shielding(sample.shared["end"]["shielding"])
        row |= _forces(sample.shared["end"])
    return row


def _exponents(sample: SampleResults, distance: float) -> dict[str, Any]:
    packings, path = sample.fit.packings, sample.path
    assert packings is not None  # a fit without a reason has them
    return {
        "seeds": packings.seeds,
        "solid_fraction": packings.solid_fraction,
        "distance_at_end": float(path["solid_fraction_above_jamming"].iloc[-1]),
        **sample.fit.exponent.named("exponent_at_end"),
        "distance": distance,
        **at_distance(path, distance).named("exponent_at_distance"),
        "distance_of_exponent_3": crossing(path),
    }


def _at(where: str, interval: Interval, name: str) -> dict[str, Any]:
    """Return an interval by the names of its columns in a state, as name_low_end."""
    return {f"{name}{limit}_{where}": value for limit, value in zip(LIMITS, interval, strict=True)}


def _split(state: StateFit, where: str) -> dict[str, Any]:
    row = _at(where, state.curvature.curvature, "curvature")
    known = {one.name: one for one in state.predictors if one.reason is None}
    for name, predictor in known.items():
        row[f"explained_{name}_{where}"] = predictor.explained.estimate
        if name in ("reduced_radius", "grain_size"):
            row |= _at(where, predictor.difference or _UNKNOWN, f"{name}_over_length")
    for name in ("branch_length", "reduced_radius"):
        if name in known:
            row |= _at(where, known[name].parameters["exponent"], f"exponent_of_{name}")
    if "length_and_ratio" in known:
        for name, value in known["length_and_ratio"].parameters.items():
            row |= _at(where, value, name)
    return {**row, f"best_predictor_{where}": _best(known.values())}


def _best(predictors: Iterable[FittedPredictor]) -> str | None:
    """Return which predictor explains most, None where two explain the same or none is known."""
    # Of those with one exponent or two: the full surface is the ceiling, no rival.
    explained = {one.name: one.explained.estimate for one in predictors if one.name != "surface"}
    known = [(value, name) for name, value in explained.items() if value == value]
    ranked = sorted(known, reverse=True)
    # With two lengths of branches, or none apart, all say the same.
    if len(ranked) < 2 or ranked[0][0] - ranked[1][0] < _TIED:
        return None
    return ranked[0][1]


def _lengths(numbers: Mapping) -> dict[str, Any]:
    row = {}
    if "near_jamming" in numbers:
        near = numbers["near_jamming"]
        row["distance_near"] = near["solid_fraction_above_jamming"]
        row["mean_length_near_m"] = near["mean_length_m"]
        for prediction in near["predictions"]:
            row[f"ks_{prediction['name']}_near"] = prediction["kolmogorov_smirnov"]
    for prediction in numbers["end"]["predictions"]:
        if prediction["name"] in ("random_contact", "parking", "rods", "configuration"):
            row[f"ks_{prediction['name']}_end"] = prediction["kolmogorov_smirnov"]
    return row | Interval.read(numbers["end"], "assortativity_of_radii").named(
        "assortativity_of_radii"
    )


def _coordination(numbers: Mapping) -> dict[str, Any]:
    row = {}
    if "near_jamming" in numbers:
        near = numbers["near_jamming"]
        row["coordination_number_near"] = near["coordination_number"]
        row["rattler_fraction_near"] = near["rattler_fraction"]
    row["coordination_number_end"] = numbers["end"]["coordination_number"]
    for name in ("coordination_number", "rattler_fraction"):
        for where, place in (("near_jamming", "near"), ("end", "end")):
            if f"rods_{name}" in numbers.get(where, {}):
                row[f"rods_{name}_{place}"] = numbers[where][f"rods_{name}"]
    for model in numbers["models"]:
        if model["name"] == "parking":
            row |= {f"parking_{name}": value for name, value in model.items() if name != "name"}
    return row


def _jamming_law(states: Any, intervals: Mapping[str, Any]) -> dict[str, Any]:
    seeds = [seed for _, seed in states.groupby("seed_number")]
    law = jamming_law_fit(
        [seed["solid_fraction_above_jamming"] for seed in seeds],
        [seed["mechanical_coordination_number"] for seed in seeds],
        isostatic=[seed["isostatic_number"] for seed in seeds],
        **intervals,
        rng=Resampling.FINDINGS.rng(),
    )
    return {
        f"jamming_law_{name}": law[name]
        for kind in ("prefactor", "exponent")
        for name in interval_names(kind)
    }


def _shielding(shielding: Mapping) -> dict[str, Any]:
    branches, grains = shielding["branches"], shielding["grains"]
    row = Interval.read(branches, "shielding_exponent").named("shielding_exponent")
    row |= Interval.read(branches, "unequal_over_equal").named("shielding_unequal_over_equal")
    row["shielding_radius_ratio_to"] = branches.get("radius_ratio_to")
    row["shielding_unequal_branches"] = branches.get("unequal_branches")
    row["shielding_claim_per_branch"] = branches.get("claim")
    for name in ("largest_neighbour_ratio", "neighbour_ratio_from", "grains"):
        row[f"shielding_{name}"] = grains[name]
    for reading in ("contact", "grain", "volume"):
        name = f"energy_per_{reading}"
        row |= Interval.read(grains, name).named(f"shielding_{name}")
        row[f"shielding_claim_per_{reading}"] = grains[f"claim_per_{reading}"]
    # Of all grains it is no power of the radius, as rattlers hold nothing.
    bearing = Interval.read(shielding["grain_energy"], "exponent_load_bearing")
    return row | bearing.named("grain_energy_exponent_load_bearing")


def _forces(end: Mapping) -> dict[str, Any]:
    forces, stress = end["forces"], end["stress"]
    tail = next(one for one in forces["tails"] if one["threshold"] == _TAIL)
    row = Interval.read(forces["by_length"], "exponent").named("force_exponent")
    for name in ("decay_rate", "squared_variation"):
        row |= Interval.read(tail, name).named(f"force_tail_{name}")
    for kind in ("branches", "forces"):
        for name in ("deviator_over_expected", "by_chance_low", "by_chance_high"):
            row[f"fabric_{kind}_{name}"] = end["fabric"][kind][name]
    for name in ("coarse_half_stress_share", "sharing_index"):
        row |= Interval.read(stress, name).named(name)
    return row
