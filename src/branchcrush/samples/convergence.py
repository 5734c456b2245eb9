"""Convergence: the same packings with twice the strain steps, and what that changes."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from branchcrush.errors import FitError
from branchcrush.samples.ensemble import certified_loading
from branchcrush.statistics.power_law import binned_exponent

_QUANTITIES = (
    "solid_fraction",
    "mean_stress_Pa",
    "elastic_energy_J",
    "work_J",
    "coordination_number",
    "mechanical_coordination_number",
    "force_evaluations",
)
_COLUMNS = (
    "quantity",
    "seeds",
    "value",
    "value_at_twice_the_steps",
    "difference",
    "standard_error_of_difference",
)


def convergence_table(
    certificates: Sequence[pd.DataFrame],
    once: tuple[Sequence[pd.DataFrame], Sequence[NDArray]],
    twice: tuple[Sequence[pd.DataFrame], Sequence[NDArray]],
) -> pd.DataFrame:
    """Return the quantities at the end of the loading with the steps asked for and with twice.

    Parameters
    ----------
    certificates : list of DataFrame
        `certificate.csv` of both runs, or none when no seed was run twice.
    once, twice : tuple of (list of DataFrame, list of ndarray)
        The path of each seed run twice, and its binned energies at the end of its loading, as
        `samples.seed_branches.state_sums`.

    Returns
    -------
    DataFrame
        For each quantity both values, means over the seeds, their difference and its standard
        error from the pairs of one seed; the exponent is that of all these seeds together. Empty
        when no seed is certified in both runs.
    """
    try:
        runs = [
            certified_loading(certificate, paths)
            for certificate, (paths, _) in zip(certificates, (once, twice), strict=False)
        ]
    except FitError:
        runs = []
    both = sorted(set(runs[0][0]) & set(runs[1][0])) if runs else []
    if not both:
        return pd.DataFrame(columns=_COLUMNS)
    ends, exponents, together = [], [], []
    for (used, paths), (_, sums) in zip(runs, (once, twice), strict=True):
        ends.append([paths[used.index(number)].iloc[-1] for number in both])
        sums = np.stack([sums[number] for number in both])
        together.append(_exponent(sums))
        exponents.append([_exponent(seed[None]) for seed in sums])
    rows = [_row("exponent", together, np.array(exponents))]
    for quantity in _QUANTITIES:
        values = np.array([[float(end[quantity]) for end in run] for run in ends])
        rows.append(_row(quantity, values.mean(axis=1), values))
    return pd.DataFrame(rows)


def _exponent(sums):
    try:
        return float(binned_exponent(sums, rng=np.random.default_rng(0))[0].exponent)
    except FitError:
        return np.nan


def _row(quantity, values, seeds):
    pairs = seeds[1] - seeds[0]
    error = pairs.std(ddof=1) / np.sqrt(pairs.size) if pairs.size > 1 else np.nan
    value, refined = (float(value) for value in values)
    return dict(
        zip(_COLUMNS, (quantity, pairs.size, value, refined, refined - value, error), strict=True)
    )
