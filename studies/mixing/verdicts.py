"""What the packings say of each assumption and form, in sentences that count and do not argue."""

from collections.abc import Iterator, Sequence

import numpy as np
import pandas as pd
from assumptions import LEVEL
from page import FORMS
from pairs import Pair

from branchcrush.energy.split import PAPER_EXPONENT

# A Kolmogorov-Smirnov distance, and an error of C, from which Eq. 7 and 15 are said not to hold.
_FAR = 0.05


def verdict_block(
    pairs: Sequence[Pair],
    compared: pd.DataFrame,
    summary: pd.DataFrame,
    assumptions: pd.DataFrame,
    predictions: pd.DataFrame,
) -> list[str]:
    """Return a line for each assumption of the paper, and one for each pair held out."""
    if not len(compared):
        return ["Nothing of this was packed yet."]
    return [
        f"- {line}"
        for line in (
            *_energy(compared),
            *_proportions(assumptions),
            *_exponents(assumptions),
            *_densities(assumptions),
            *_jamming(assumptions, predictions),
            *_held_out(pairs, summary),
        )
    ]


def _energy(compared: pd.DataFrame) -> Iterator[str]:
    """Crushing sets elastic energy free at a given strain."""
    at = compared[(compared["basis"] == "elastic_strain") & (compared["level"] == LEVEL)]
    rows = at[at["form"] == "paper"]
    if not len(rows):
        return
    above, below = rows["energy_ratio_low"] > 1.0, rows["energy_ratio_high"] < 1.0
    yield (
        f"**Energy falls with C at equal elastic strain** (Eq. 16, θ > 0): of {len(rows)} "
        f"mixtures it rises in {above.sum()} (interval above 1) and falls in {below.sum()}; in "
        f"the others neither is decided. It is {_range(rows['energy_ratio'])} times that at "
        f"C = 0; the paper says {_range(rows['predicted_energy_ratio'])} times."
    )


def _proportions(assumptions: pd.DataFrame) -> Iterator[str]:
    """Eq. 7 and 15."""
    if "mixed_by_crushing" not in assumptions:
        return
    between = assumptions["crushing"].between(0.0, 1.0, inclusive="neither")
    rows = assumptions[between & assumptions["mixed_by_crushing"].notna()]
    if not len(rows):
        return
    far, best = rows["mixed_by_crushing"] > _FAR, rows["mixed_at_best"] > _FAR
    yield (
        f"**Branch lengths mix in proportion to C** (Eq. 7): the measured B(l) is "
        f"{_range(rows['mixed_by_crushing'])} (Kolmogorov-Smirnov) from the mixture, further than "
        f"{_FAR:g} in {far.sum()} of {len(rows)}; with the share that fits best it still is in "
        f"{best.sum()}, up to {rows['mixed_at_best'].max():.2f}."
    )
    error = rows["crushing_by_moments"] - rows["crushing"]
    worst = rows.loc[error.abs().idxmax()]
    yield (
        f"**C from the mean of l³ is the share of the mass** (Eq. 15): it differs by "
        f"{_range(error, '+.2f')}, by more than {_FAR:g} in {(error.abs() > _FAR).sum()} of "
        f"{len(rows)}; at C = {worst['crushing']:g} ({worst['pair']}, {worst['law']}) it is "
        f"{worst['crushing_by_moments']:.2f}."
    )


def _exponents(assumptions: pd.DataFrame) -> Iterator[str]:
    """One exponent for all states."""
    rows = assumptions[assumptions["exponent"].notna()]
    holds = (rows["exponent_low"] <= PAPER_EXPONENT) & (rows["exponent_high"] >= PAPER_EXPONENT)
    spans = [
        f"{pair}, {law}: {_range(group['exponent'])}"
        for (pair, law), group in rows.groupby(["pair", "law"], sort=False)
        if len(group) > 1
    ]
    if spans:
        yield (
            f"**One exponent n = {PAPER_EXPONENT:g}**: {holds.sum()} of {len(rows)} intervals hold "
            f"it. Over C it takes values of {'; '.join(spans)}."
        )


def _densities(assumptions: pd.DataFrame) -> Iterator[str]:
    """No branch density in the energy."""
    rows = assumptions[(assumptions["crushing"] > 0.0) & assumptions["density_ratio"].notna()]
    if len(rows):
        yield (
            f"**No branch density**: the number of branches per volume is "
            f"{_range(rows['density_ratio'], '.1f')} times that at C = 0."
        )


def _jamming(assumptions: pd.DataFrame, predictions: pd.DataFrame) -> Iterator[str]:
    """No jamming point that moves."""
    rows = assumptions[assumptions["jamming_solid_fraction"].notna()]
    said = predictions[predictions["form"] == "moving_jamming"].set_index("sample")
    predicted = said.loc[rows["sample"], "jamming_solid_fraction"].to_numpy()
    error = predicted - rows["jamming_solid_fraction"].to_numpy()
    spans = [
        f"{pair}, {law}: from {group['jamming_solid_fraction'].iloc[0]:.3f} at C = 0 up to "
        f"{group['jamming_solid_fraction'].max():.3f}"
        for (pair, law), group in rows.groupby(["pair", "law"], sort=False)
        if len(group) > 1 and group["crushing"].iloc[0] == 0.0
    ]
    if spans:
        yield (
            f"**A jamming point that stays**: φ_J moves ({'; '.join(spans)}). Rods say it from the "
            f"grading alone with an error of {_range(error, '+.4f')}, {error.mean():+.4f} on "
            f"average and {np.sqrt(np.mean(error**2)):.4f} rms, over {len(rows)} mixtures."
        )


def _held_out(pairs: Sequence[Pair], summary: pd.DataFrame) -> Iterator[str]:
    """The pairs that no rule was chosen on."""
    for pair in pairs:
        if not pair.held_out:
            continue
        rows = pd.DataFrame()
        if len(summary):
            at = (summary["pair"] == pair.name) & (summary["law"] == pair.law)
            rows = summary[at & (summary["basis"] == "elastic_strain")]
        if not len(rows):
            yield f"**Held out, {pair.name}**: not enough packings yet."
            continue
        said = rows.set_index("form")["rms_ln_energy"].dropna()
        parts = [f"{FORMS[form]} {error:.2f}" for form, error in said.sort_values().items()]
        yield (
            f"**Held out, {pair.name}**: root mean square error of ln Ψ at equal elastic strain, "
            f"from the best form on: {', '.join(parts)}."
        )


def _range(values, form: str = ".2f") -> str:
    return f"{np.min(values):{form}} to {np.max(values):{form}}"
