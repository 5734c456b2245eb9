"""Convergence: the same packings with twice the strain steps, and whether that changes anything.

What two runs of one packing share is compared in pairs. The exponent is not: most of its scatter
between packings comes back when one packing is run twice, so all packings of one run are held
against all of the other.
"""

from collections.abc import Sequence
from typing import Literal

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from branchcrush.errors import FitError
from branchcrush.samples.ensemble import certified_loading

Decision = Literal["converged", "not converged", "not decided"]

# What is compared in pairs, in the order of the table, and how much of it may change: a share of
# its value, or as much as the number says. The others are told without being judged.
_PAIRED = (
    "solid_fraction",
    "mean_stress_Pa",
    "elastic_energy_J",
    "work_J",
    "coordination_number",
    "mechanical_coordination_number",
    "jamming_solid_fraction",
    "force_evaluations",
)
SHARES = {"mean_stress_Pa": 0.05, "elastic_energy_J": 0.05}
TOLERANCES = {
    "exponent": 0.1,
    "mechanical_coordination_number": 0.1,
    "jamming_solid_fraction": 0.01,
}
# A wrong decision is at most so likely; it is what the interval leaves out on both sides together.
_WRONG = 0.05
_WORDS = {
    "exponent": "n",
    "mean_stress_Pa": "mean stress",
    "elastic_energy_J": "elastic energy",
    "mechanical_coordination_number": "κ*",
    "jamming_solid_fraction": "φ_J",
}
_COLUMNS = (
    "quantity",
    "seeds",
    "value",
    "value_at_twice_the_steps",
    "difference",
    "standard_error_of_difference",
    "seeds_at_twice_the_steps",
    "compared_by",
    "could_see",
    "tolerance",
    "verdict",
)


def compared_packings(
    certificate: pd.DataFrame, paths: Sequence[pd.DataFrame], jamming: pd.DataFrame
) -> pd.DataFrame:
    """Return what is compared of the packings of a run that are certified at their end.

    Parameters
    ----------
    certificate : DataFrame
        `certificate.csv`.
    paths : list of DataFrame
        The `path.csv` of each of its seeds.
    jamming : DataFrame
        `jamming.csv`.

    Returns
    -------
    DataFrame
        A row for each seed, which is the index, at the end of its loading; none where no packing
        is certified there.
    """
    seeds = certificate["seed"].unique()
    try:
        used, kept = certified_loading(certificate, paths)
    except FitError:
        used, kept = [], []
    ends = pd.DataFrame([path.iloc[-1] for path in kept], index=seeds[used])
    points = jamming.set_index("seed")["jamming_solid_fraction_loading"]
    ends["jamming_solid_fraction"] = points.reindex(ends.index)
    return ends.reindex(columns=_PAIRED).astype(float)


def convergence_table(
    once: pd.DataFrame,
    twice: pd.DataFrame,
    exponents: ArrayLike,
    exponents_at_twice: ArrayLike,
) -> pd.DataFrame:
    r"""Return what twice the strain steps change, and whether that is little enough.

    .. math:: \bar d \pm t_{0.975}\, s_{\bar d}: \quad
        \text{converged inside} \pm T, \quad \text{not converged outside}

    Parameters
    ----------
    once, twice : DataFrame
        From `compared_packings`, of the run asked for and of that with twice the strain steps.
    exponents, exponents_at_twice : array_like, shape (S,) and (S_2,)
        n of every packing of either run alone; nan counts as none [-].

    Returns
    -------
    DataFrame
        A row for each quantity: the means of both runs, their difference and its standard error,
        from pairs of one seed, or of n from all packings of either run as two ensembles of one
        scatter. `could_see` is half of the 95 % interval: the least difference that can be told
        from none. `verdict` is that of `decision`, and empty for what is not judged. No row when
        no seed is certified in both runs.

    References
    ----------
    Schuirmann (1987), Journal of Pharmacokinetics and Biopharmaceutics 15, 657: equivalence by
    an interval.
    """
    both = once.index.intersection(twice.index)
    if not len(both):
        return pd.DataFrame(columns=_COLUMNS)
    rows = [_of_ensembles(exponents, exponents_at_twice)]
    pairs = [run.loc[both, list(_PAIRED)].to_numpy().T for run in (once, twice)]
    rows += [_of_pairs(*pair) for pair in zip(_PAIRED, *pairs, strict=True)]
    return pd.DataFrame(rows, columns=_COLUMNS)


def decision(difference: float, could_see: float, tolerance: float) -> Decision:
    """Return whether a difference is within a tolerance, beyond it, or may be either.

    Parameters
    ----------
    difference : float
    could_see : float
        Half of its 95 % interval; nan where there is none.
    tolerance : float

    Returns
    -------
    {"converged", "not converged", "not decided"}
        Each of the first two is wrong in at most 5 of 100 such comparisons.

    Examples
    --------
    >>> decision(0.02, 0.05, 0.1), decision(0.3, 0.05, 0.1), decision(0.02, 0.2, 0.1)
    ('converged', 'not converged', 'not decided')
    """
    if abs(difference) + could_see <= tolerance:
        return "converged"
    return "not converged" if abs(difference) - could_see > tolerance else "not decided"


def convergence_words(table: pd.DataFrame) -> list[str]:
    """Return a sentence for each quantity that is judged: what changes, and what could be seen.

    Parameters
    ----------
    table : DataFrame
        From `convergence_table`.

    Returns
    -------
    list of str
        Those of stress and energy in per cent.
    """
    judged = table[table["verdict"] != ""]
    return [
        f"{_WORDS[row.quantity]}: {row.verdict}, {_change(row)} with twice the strain steps "
        f"({_number_of(row)}): {_at_most(row)}{_amount(row, row.tolerance)} is allowed, "
        f"{_least_seen(row)} could be seen"
        for row in judged.itertuples()
    ]


def _of_pairs(quantity, once, twice):
    pairs = np.isfinite(twice - once)
    once, twice = once[pairs], twice[pairs]
    count, difference = once.size, twice - once
    error = difference.std(ddof=1) / np.sqrt(count) if count > 1 else np.nan
    means = [run.mean() if count else np.nan for run in (once, twice, difference)]
    tolerance = TOLERANCES.get(quantity, SHARES.get(quantity, np.nan) * abs(means[0]))
    runs = (count, means[0], count, means[1])
    return _row(quantity, runs, means[2], error, count - 1, tolerance, "pairs")


def _of_ensembles(exponents, exponents_at_twice):
    runs = [np.asarray(run, dtype=float) for run in (exponents, exponents_at_twice)]
    once, twice = (run[np.isfinite(run)] for run in runs)
    freedom = once.size + twice.size - 2
    values, error = [run.mean() if run.size else np.nan for run in (once, twice)], np.nan
    if once.size and twice.size and freedom > 0:
        # One scatter for both: it is that of packings, hardly that of the size of steps.
        square = sum(((run - run.mean()) ** 2).sum() for run in (once, twice)) / freedom
        error = np.sqrt(square * (1 / once.size + 1 / twice.size))
    runs = (once.size, values[0], twice.size, values[1])
    difference = values[1] - values[0]
    return _row("exponent", runs, difference, error, freedom, TOLERANCES["exponent"], "ensembles")


def _row(quantity, runs, difference, error, freedom, tolerance, compared_by):
    from scipy.special import stdtrit  # slow to import, and few jobs need it

    seeds, value, refined_seeds, refined = runs
    could_see = stdtrit(freedom, 1.0 - _WRONG / 2) * error if freedom > 0 else np.nan
    judged = np.isfinite(difference) and np.isfinite(tolerance)
    verdict = decision(difference, could_see, tolerance) if judged else ""
    numbers = (quantity, seeds, value, refined, difference, error, refined_seeds)
    return dict(zip(_COLUMNS, (*numbers, compared_by, could_see, tolerance, verdict), strict=True))


def _change(row):
    if np.isnan(row.could_see):
        return _amount(row, row.difference, sign="+")
    return f"{_amount(row, row.difference, sign='+')} ± {_amount(row, row.could_see)}"


def _amount(row, amount, sign=""):
    if row.quantity in SHARES:
        return f"{amount / abs(row.value):{sign}.1%}".replace("%", " %")
    places = 4 if row.quantity == "jamming_solid_fraction" else 2
    return f"{amount:{sign}.{places}f}"


def _number_of(row):
    if row.compared_by == "pairs":
        return f"{row.seeds} {'seed' if row.seeds == 1 else 'seeds'}, each run twice, 95 % interval"
    return f"{row.seeds} packings against {row.seeds_at_twice_the_steps}, unpaired, 95 % interval"


def _at_most(row):
    if np.isnan(row.could_see):
        return ""
    return f"as much as {_amount(row, abs(row.difference) + row.could_see)}, "


def _least_seen(row):
    return "nothing" if np.isnan(row.could_see) else _amount(row, row.could_see)
