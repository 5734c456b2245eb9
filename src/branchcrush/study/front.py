"""What came out of a sample, in plain words with its numbers: the first lines of the page."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.energy.split import PAPER_EXPONENT
from branchcrush.study.crushing_words import form_rows
from branchcrush.study.results import NOT_CERTIFIED
from branchcrush.words import few

# n is told to change along the loading from this difference on.
_SEEN = 0.1
# So many samples are named in a sentence.
_FEW = 6


def front_sentences(
    fit: EnergySplitFit,
    certificate: Mapping[str, Any],
    model: Mapping[str, Any],
    shared: Mapping[str, Any] | None = None,
) -> list[str]:
    """Return three to six sentences on a sample: n, how sure, where, certificate, crushing.

    Parameters
    ----------
    fit : EnergySplitFit
        Read from `energy_split.json`.
    certificate, model : mapping
        `certificate.json` and `thermodynamics.json`.
    shared : mapping, optional
        The row of `findings.csv`, with None where there is no number.

    Returns
    -------
    list of str
        What is missing is said, and why.
    """
    told = [_verdict(certificate), *_exponent(fit), *_place(fit, certificate)]
    told += [*_shielding(shared or {}), *_crushing(model)]
    return told


def study_sentences(
    samples: Sequence[tuple[str, EnergySplitFit, Mapping[str, Any]]],
) -> list[str]:
    """Return what a study of many samples came to: verdicts, the range of n, and what to look at.

    Parameters
    ----------
    samples : list of (str, EnergySplitFit, mapping)
        Name, `energy_split.json` and `certificate.json` of each.

    Returns
    -------
    list of str
    """
    named: dict[str, list[str]] = {}
    for name, _, certificate in samples:
        named.setdefault(certificate["verdict"], []).append(name)
    told = [
        f"{len(samples)} samples: "
        + "; ".join(
            f"{len(names)} {verdict} ({few(names, _FEW)})" for verdict, names in named.items()
        )
        + "."
    ]
    known = sorted(
        (fit.exponent.estimate, name)
        for name, fit, certificate in samples
        if fit.reason is None and certificate["verdict"] != NOT_CERTIFIED
    )
    if len(known) > 1:
        (least, first), (most, last) = known[0], known[-1]
        told.append(
            "Among the certified ones n, the exponent of the energy of a branch in its length, "
            f"runs from {least:.2f} ({first}) to {most:.2f} ({last}); the paper has 3 in its case."
        )
    elif not known:
        told.append("Of no certified sample n is known.")
    alone = [name for name, _, certificate in samples if certificate["seeds_certified"] == 1]
    if alone:
        told.append(
            f"No interval is known of one packing alone: {few(alone, _FEW)}. More seeds give one."
        )
    told += [
        f"{name} has no n: {fit.reason}."
        for name, fit, _ in samples[:_FEW]
        if fit.reason is not None
    ]
    return told


def _verdict(certificate: Mapping[str, Any]) -> str:
    reasons, notes = certificate["reasons"], certificate["notes"]
    if reasons:
        return (
            f"Not certified: {'; '.join(reasons)}. Do not use its numbers; they are shown to find "
            "out why."
        )
    seeds = certificate["seeds_certified"]
    whole = "the packing is" if seeds == 1 else f"all {seeds} packings are"
    if not notes:
        return f"Certified: {whole} at rest at the end, with the account of energy closed."
    first = notes[0]
    more = f" {len(notes) - 1} more below." if len(notes) > 1 else ""
    # What is in brackets stands in the section of quality.
    finding = _lower(first["finding"].partition(" (")[0])
    return (
        f"Certified with {'a note' if len(notes) == 1 else f'{len(notes)} notes'}: {whole} at "
        f"rest, but {finding}. What to do: {first['advice']}.{more}"
    )


def _exponent(fit: EnergySplitFit) -> Iterator[str]:
    if fit.reason is not None:
        yield f"There is no exponent n: {fit.reason}."
        return
    n, packings = fit.exponent, fit.packings
    meaning = f"a branch twice as long holds {2.0**n.estimate:.3g} times the energy"
    if n.low != n.low:
        yield (
            f"n = {n.estimate:.2f}: {meaning}. One packing gives no interval; more seeds do, and "
            "another packing may differ by some tenths."
        )
        return
    seeds = packings.seeds if packings else 0
    yield (
        f"n = {n.estimate:.2f}: {meaning}. From {seeds} packings n is between {n.low:.2f} and "
        f"{n.high:.2f} with {100 * fit.confidence:.4g} % confidence, {_beside_three(n)}."
    )


def _beside_three(n: Any) -> str:
    if n.is_wide:
        return "too wide to tell anything; more seeds narrow it"
    if n.high < PAPER_EXPONENT:
        return "below the 3 of the paper"
    return "above the 3 of the paper" if n.low > PAPER_EXPONENT else "and so may be the paper's 3"


def _place(fit: EnergySplitFit, certificate: Mapping[str, Any]) -> Iterator[str]:
    packings = fit.packings
    if packings is None or fit.reason is not None:
        return
    jamming, phi = packings.jamming_solid_fraction, packings.solid_fraction
    above = (
        f", {phi - jamming:.3f} above the solid fraction φ_J = {jamming:.3f} from which on this "
        "grading carries load"
        if jamming == jamming
        else ""
    )
    place = (
        f"This is at a solid fraction of {phi:.3f}{above}, "
        f"under {packings.mean_stress / 1e6:.3g} MPa"
    )
    near = fit.near_jamming and fit.near_jamming.predictors
    first = near[0].exponent if near else None
    last = fit.end.predictors[0].exponent if fit.end.predictors else None
    if first is not None and last is not None:
        change = last - first
        yield f"{place}; n " + (
            f"{'rises' if change > 0 else 'falls'} from {first:.2f} near jamming to {last:.2f}."
            if abs(change) >= _SEEN
            else f"is about the same near jamming ({first:.2f})."
        )
    else:
        yield f"{place}."
    share = certificate["rattler_fraction_at_end"]
    yield (
        f"A grain touches {packings.coordination_number:.1f} others on average, and "
        f"{'all carry' if not share else f'{100 * share:.0f} % carry no'} load."
    )


def _shielding(row: Mapping[str, Any]) -> Iterator[str]:
    share = row.get("shielding_unequal_over_equal")
    if share is not None and share == share:
        yield (
            f"Between grains whose radii differ {1 / row['shielding_radius_ratio_to']:.3g}-fold or "
            f"more, a branch holds {100 * share:.2g} % of the energy of one of its length between "
            "equal grains."
        )


def _crushing(model: Mapping[str, Any]) -> Iterator[str]:
    if reason := model.get("reason") or model.get("form_reason"):
        yield f"What crushing would do is not known: {reason}."
        return
    label = next((row["label"] for row in form_rows(model) if row["name"] == model["form"]), "")
    front = model["forms"][model["form"]]
    if model["yield_strain"] is None:
        yield (
            f"Nothing breaks in these packings; by the crushing model ({label.lower()}) crushing "
            "never begins."
        )
        return
    beyond = "" if model["yields_on_path"] else ", beyond what was measured"
    then = "more stress is needed to go on" if model["hardens_at_onset"] else "it goes on by itself"
    if front["snaps"] and model["hardens_at_onset"]:
        then += f" until C = {front['snaps'][0]:.2f}, where it goes on by itself"
    strength = (
        "a strain" if model["resistance"] == "elastic_strain" else "a strength"
    ) + " that the configuration sets"
    yield (
        f"By the crushing model ({label.lower()}), with {strength}, crushing begins at "
        f"{model['yield_stress_Pa'] / 1e6:.3g} MPa{beyond}; {then}."
    )


def _lower(text: str) -> str:
    """Begin a sentence within another, but for a symbol or a name."""
    return text[:1].lower() + text[1:] if text[1:2].islower() else text
