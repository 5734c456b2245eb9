"""The notes of a certificate: what is worth knowing of a number that is not withheld for it.

A note says which check, what it found and what it asks for, what that does to n, stress and energy
where it was measured (`samples.note_effects`), and what to do.
"""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import pandas as pd

from branchcrush.gradings.representativity import ENOUGH_DIAMETERS
from branchcrush.packings.contact_laws import OVERLAP_FLAG
from branchcrush.samples.convergence import convergence_words
from branchcrush.samples.note_effects import effect_of


@dataclass(frozen=True)
class Note:
    """One check that is not met, and what follows.

    Parameters
    ----------
    check : str
        Its name: "overlaps", "few grains", "convergence", "load at the first step",
        "stopped on the way back", "made by another code" or "reading".
    value, limit : float or None
        What was found, and what would carry no note; None where there is no number.
    finding : str
        The two in words.
    effect : str
        On n, mean stress and energy, with where it was measured.
    advice : str
        What to do.

    Examples
    --------
    >>> Note("overlaps", 0.08, 0.05, "deep overlaps", "n +0.01", "load less").text
    'deep overlaps. Likely effect: n +0.01. What to do: load less.'
    """

    check: str
    value: float | None
    limit: float | None
    finding: str
    effect: str
    advice: str

    @property
    def text(self) -> str:
        """The note as a person reads it."""
        return f"{self.finding}. Likely effect: {self.effect}. What to do: {self.advice}."

    def result(self) -> dict[str, Any]:
        """Return what `certificate.json` holds of it."""
        return {**asdict(self), "text": self.text}


def overlap_notes(last: pd.DataFrame) -> list[Note]:
    """Return the note of packings whose overlaps are no longer small at the end of their loading.

    The median of those that are certified is judged.

    Parameters
    ----------
    last : DataFrame
        The rows of `certificate.csv` at the end of the loading.

    Returns
    -------
    list of Note
    """
    certified = last[last["certified"]]
    value = float(certified["overlap_ratio_95"].median())
    if not value > OVERLAP_FLAG:
        return []
    return [
        Note(
            check="overlaps",
            value=value,
            limit=OVERLAP_FLAG,
            finding=f"overlaps at the end: {certified['median_overlap_ratio'].median():.1%} of "
            f"the smaller radius in the median, {value:.1%} at 95 % of the contacts, noted from "
            f"{OVERLAP_FLAG:.0%}",
            effect=effect_of("overlaps", value),
            advice="load less far, or read the numbers against φ − φ_J as those of the contact "
            "law; a stiffer contact leads to the same overlaps at the same φ − φ_J",
        )
    ]


def grains_notes(representativity: Mapping[str, Any]) -> list[Note]:
    """Return the note of a cell of few grains.

    The coarsest tenth of the mass and the edge of the cell are one matter: whoever has 5 diameters
    has 17 grains in that tenth at a solid fraction of 0.7.

    Parameters
    ----------
    representativity : mapping
        Of `grading.json`.

    Returns
    -------
    list of Note
    """
    if not representativity["warnings"]:
        return []
    diameters = float(representativity["edge_over_diameter"])
    return [
        Note(
            check="few grains",
            value=diameters,
            limit=ENOUGH_DIAMETERS,
            finding="; ".join(representativity["warnings"]),
            effect=effect_of("few grains", diameters),
            advice=f"raise grains to {representativity['grains_needed']}, or narrow the grading",
        )
    ]


def convergence_notes(table: pd.DataFrame) -> list[Note]:
    """Return the notes of what twice the strain steps change, where that is not decided.

    Of n none is made: a few packings more or less cannot decide it.

    Parameters
    ----------
    table : DataFrame
        From `samples.convergence.convergence_table`.

    Returns
    -------
    list of Note
    """
    if not len(table):
        return [
            Note(
                check="convergence",
                value=None,
                limit=None,
                finding="convergence not checked: no seed was run again with twice the strain "
                "steps and certified in both runs",
                effect=effect_of("convergence", 0.0),
                advice="set refined_seeds to 4 or more",
            )
        ]
    open_rows = table[(table["verdict"] == "not decided") & (table["quantity"] != "exponent")]
    return [
        Note(
            check="convergence",
            value=abs(float(row["difference"])) + float(row["could_see"]),
            limit=float(row["tolerance"]),
            finding="convergence not decided: " + words.replace(": not decided,", "", 1),
            effect="as said, on this sample; n is not judged by it",
            advice="raise refined_seeds, or loading.quality",
        )
        for (_, row), words in zip(open_rows.iterrows(), convergence_words(open_rows), strict=True)
    ]


def loaded_early_notes(jamming: pd.DataFrame) -> list[Note]:
    """Return the note of packings that carry load before their first strain step.

    Parameters
    ----------
    jamming : DataFrame
        `jamming.csv`.

    Returns
    -------
    list of Note
    """
    early = int(jamming["loaded_from_the_start"].sum())
    if not early:
        return []
    return [
        Note(
            check="load at the first step",
            value=early,
            limit=0,
            finding=f"{early} of {len(jamming)} packings already carry load at the first strain "
            "step, the largest of the path",
            effect="not measured; φ_J and the work until then are less sure than their errors say",
            advice="lower loading.approach_solid_fraction",
        )
    ]


def late_stop_notes(stops: Sequence[str]) -> list[Note]:
    """Return a note for each packing that stopped on its way back.

    Parameters
    ----------
    stops : list of str
        The seed and what its path says.

    Returns
    -------
    list of Note
    """
    return [
        Note(
            check="stopped on the way back",
            value=None,
            limit=None,
            finding=stop,
            effect="none on n, stress and energy, which are of the end of the loading; means of "
            "the way back are of the states reached",
            advice="nothing, or end the unloading earlier",
        )
        for stop in stops
    ]


def reading_notes(readings: Sequence[Mapping]) -> list[Note]:
    """Return the notes of packings that another code made: what was read, and what is not known.

    Parameters
    ----------
    readings : list of mapping
        `reading.json` of each.

    Returns
    -------
    list of Note
        None of packings that were compressed here.

    Examples
    --------
    >>> reading_notes([{"notes": ["2 virtual contacts were left out"]}])[1].finding
    'packing 1: 2 virtual contacts were left out'
    """
    if not readings:
        return []
    unknown = Note(
        "made by another code",
        None,
        None,
        "the packings were made by another code, whose files tell no work, no kinetic energy and "
        "no stress of the boundary",
        "none on n; that the packings are at rest is judged by the balance of their forces alone, "
        "and no account of energy is closed",
        "look at the unbalanced force ratio in the certificate, and at how they were loaded",
    )
    found: dict[str, list[str]] = {}
    for number, reading in enumerate(readings, start=1):
        for words in reading["notes"]:
            found.setdefault(words, []).append(str(number))
    return [unknown] + [
        Note(
            "reading",
            None,
            None,
            f"packing{'s' if len(packings) > 1 else ''} {', '.join(packings)}: {words}",
            "as it says; not measured",
            "write the files anew where it matters",
        )
        for words, packings in found.items()
    ]
