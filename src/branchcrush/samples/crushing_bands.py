"""Bands of the curves of the form on the front: what the intervals of phi_J and n make of them."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from branchcrush.crushing.elasticity import Elasticity
from branchcrush.crushing.evolution import evolve
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.resistance import Resistance
from branchcrush.crushing.yield_line import Control
from branchcrush.statistics.intervals import LIMITS

_BANDED = ("stress_Pa", "free_energy_J_per_m3")
# What band columns are called, before the unit.
BANDS = tuple(
    f"{name}{limit}_{unit}"
    for name, unit in (("stress", "Pa"), ("free_energy", "J_per_m3"))
    for limit in LIMITS[1:]
)
End = tuple[ModelForm, Elasticity]


def with_bands(
    rows: pd.DataFrame,
    ends: Sequence[End],
    resistance: Resistance,
    history: tuple[Control, NDArray] | None = None,
    ends_without_law: int = 0,
) -> pd.DataFrame:
    """Return curves with the least and the largest that they are at the ends of intervals.

    The curves are computed again at each end, the others at their estimates, at the same strains
    and held C, or under the same history. That is wider than resampled pairs where phi_J and n go
    together, and narrower where they act against each other.

    Parameters
    ----------
    rows : DataFrame
        Of one form, from `form_curves` and `history_curves`.
    ends : sequence of (ModelForm, Elasticity)
        None gives empty bands.
    resistance : Resistance
    history : tuple, optional
        What loads are, and the loads.
    ends_without_law : int
        Of the interval of phi_J, how many. With one, the first of `ends` is the other, and tells on
        which side of the curve nothing is known; with both there are no bands.

    Returns
    -------
    DataFrame
        With the columns `BANDS`; empty where a load is too large for the law at an end, and on the
        side of an end without a law.
    """
    low, high = {}, {}
    for path, part in rows.groupby("path", sort=False):
        values = [part[list(_BANDED)].to_numpy()]
        for end in ends:
            values.append(_at_end(str(path), part, *end, resistance, history))
        known, bands = np.array(values), ends and ends_without_law < 2
        least, most = (side if bands else side * np.nan for side in (known.min(0), known.max(0)))
        if bands and ends_without_law:
            least = np.where(known[1] < known[0], least, np.nan)
            most = np.where(known[1] > known[0], most, np.nan)
        for place, name in enumerate(_BANDED):
            low.setdefault(name, []).append(least[:, place])
            high.setdefault(name, []).append(most[:, place])
    columns = [side[name] for name in _BANDED for side in (low, high)]
    order = np.concatenate([part.index for _, part in rows.groupby("path", sort=False)])
    made = {
        name: pd.Series(np.concatenate(parts), index=order)
        for name, parts in zip(BANDS, columns, strict=True)
    }
    return rows.assign(**made)


def _at_end(
    path: str,
    part: pd.DataFrame,
    form: ModelForm,
    elasticity: Elasticity,
    resistance: Resistance,
    history: tuple[Control, NDArray] | None,
) -> NDArray:
    """Return stress and energy of the same states at an end; nan where that cannot be."""
    strain = part["volumetric_strain"].to_numpy()
    crushing = part["crushing"].to_numpy()
    if path != "fixed":
        quantity, loads = history if path == "history" and history else ("strain", strain)
        try:
            evolution = evolve(loads, form, elasticity, resistance, quantity)
        except ValueError:
            return np.full((len(part), 2), np.nan)
        strain, crushing = evolution.strain, evolution.crushing
    return np.transpose(
        [
            form.stress(strain, crushing, elasticity),
            form.free_energy(strain, crushing, elasticity),
        ]
    )
