"""What was measured of each mixture, over its seeds, beside what each form says of it."""

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from along import LEVELS, SeedPath
from numpy.typing import NDArray
from pairs import Pair
from scipy import stats

from branchcrush.statistics.intervals import Interval
from branchcrush.statistics.resampling import interval_of_refits

CONFIDENCE = 0.95
RESAMPLES = 2000
# The form that says that crushing changes nothing, to measure the others by.
UNCHANGED = "unchanged"
# Paths of the seeds of each mixture of a pair, by C.
Paths = Mapping[float, Sequence[SeedPath]]


def mean_interval(values: NDArray) -> Interval:
    """Return the mean over seeds with its interval by Student's t; nan of what is not known.

    Examples
    --------
    >>> [round(value, 3) for value in mean_interval(np.array([1.0, 2.0, 3.0]))]
    [2.0, -0.484, 4.484]
    """
    known = values[np.isfinite(values)]
    mean = float(known.mean()) if known.size else float("nan")
    if known.size < 2 or np.ptp(known) == 0.0:
        return Interval(mean, float("nan"), float("nan"))
    return Interval(
        mean, *map(float, stats.ttest_1samp(known, 0.0).confidence_interval(CONFIDENCE))
    )


def difference(values: NDArray, others: NDArray) -> Interval:
    """Return the difference of two means over seeds, with its interval by Welch's t.

    Examples
    --------
    >>> [round(value, 2) for value in difference(np.array([2.0, 3.0]), np.array([0.0, 1.0]))]
    [2.0, -1.04, 5.04]
    """
    one, other = (part[np.isfinite(part)] for part in (values, others))
    if not one.size or not other.size:
        return Interval(*3 * (float("nan"),))
    estimate = float(one.mean() - other.mean())
    if min(one.size, other.size) < 2 or np.ptp(one) + np.ptp(other) == 0.0:
        return Interval(estimate, float("nan"), float("nan"))
    found = stats.ttest_ind(one, other, equal_var=False).confidence_interval(CONFIDENCE)
    return Interval(estimate, float(found.low), float(found.high))


def levels_of(pair: Pair, paths: Paths) -> list[tuple[str, float, float]]:
    """Return what mixtures are compared at: of what, as which level it is told, and its value.

    A stress is that of the initial grading at an elastic strain; without packings of it there is
    none.
    """
    found = []
    for basis, levels in LEVELS.items():
        for level in levels:
            value = level
            if basis == "stress":
                stress = [path.at("elastic_strain", level)["stress_Pa"] for path in paths[0.0]]
                value = float(np.exp(np.log(stress).mean())) if stress else float("nan")
            if np.isfinite(value):
                found.append((basis, level, value))
    return found


def measured_rows(pair: Pair, paths: Paths) -> list[dict]:
    """Return a row for each mixture and level: every quantity with its interval over seeds."""
    rows = []
    for basis, level, value in levels_of(pair, paths):
        for sample in pair.samples:
            at = [path.at(basis, value) for path in paths[sample.crushing]]
            if not at:
                continue
            row = {
                "sample": sample.name,
                "pair": pair.name,
                "law": pair.law,
                "crushing": sample.crushing,
                "basis": basis,
                "level": level,
                "stress_level_Pa": value if basis == "stress" else np.nan,
                "seeds": sum(np.isfinite(seed["energy_J_per_m3"]) for seed in at),
            }
            for name in at[0]:
                row |= mean_interval(np.array([seed[name] for seed in at])).named(name)
            rows.append(row)
    return rows


def compared_rows(pair: Pair, paths: Paths, predictions: pd.DataFrame) -> list[dict]:
    """Return a row for each mixture beyond C = 0, level and form: measured, predicted, error."""
    rows = []
    for basis, _, level, crushing, logarithms in _logarithms(pair, paths):
        energy, stress = (
            difference(logarithms[crushing][part], logarithms[0.0][part]) for part in (0, 1)
        )
        if not np.isfinite(energy.estimate):
            continue
        sample = next(sample for sample in pair.samples if sample.crushing == crushing)
        for form, predicted in _predicted(pair, sample.name, basis, predictions).items():
            row = {
                "sample": sample.name,
                "pair": pair.name,
                "law": pair.law,
                "crushing": crushing,
                "basis": basis,
                "level": level,
                "form": form,
                "seeds": int(np.isfinite(logarithms[crushing][0]).sum()),
                **_exponential(energy).named("energy_ratio"),
                "predicted_energy_ratio": np.exp(predicted[0]),
                **_error(predicted[0], energy).named("error_ln_energy"),
            }
            if basis != "stress":
                row |= _exponential(stress).named("stress_ratio")
                row["predicted_stress_ratio"] = np.exp(predicted[1])
                row |= _error(predicted[1], stress).named("error_ln_stress")
            rows.append(row)
    return rows


def _logarithms(pair, paths):
    """Yield for each level and mixture beyond C = 0 the ln E and ln p of the seeds of all C."""
    for basis, level, value in levels_of(pair, paths):
        logarithms = {}
        for crushing, seeds in paths.items():
            at = [path.at(basis, value) for path in seeds]
            logarithms[crushing] = np.log(
                [[seed[name] for seed in at] for name in ("energy_J_per_m3", "stress_Pa")]
            ).reshape(2, -1)
        for crushing in paths:
            if crushing > 0.0:
                yield basis, value, level, crushing, logarithms


def _predicted(pair, sample, basis, predictions):
    """Return ln of the energy ratio and of the stress ratio that each form says of a mixture."""
    rows = predictions[predictions["sample"] == sample].set_index("form")
    name = "energy_ratio_at_equal_stress" if basis == "stress" else "stiffness_ratio"
    found = {}
    for form, ratio in rows[name].items():
        with np.errstate(invalid="ignore", divide="ignore"):
            found[form] = (float(np.log(ratio)), float(np.log(rows.loc[form, "stiffness_ratio"])))
    return found | {UNCHANGED: (0.0, 0.0)}


def _exponential(interval):
    return Interval(*map(float, np.exp(interval)))


def _error(predicted, measured):
    """Return the error of a logarithm, with the interval that the measured one gives it."""
    return Interval(
        *(predicted - value for value in (measured.estimate, measured.high, measured.low))
    )


def summary_rows(pair: Pair, paths: Paths, predictions: pd.DataFrame) -> list[dict]:
    """Return a row for each basis and form: root mean square and mean of the errors of a pair.

    Over all mixtures and levels that were reached; the intervals are from resampling the seeds of
    every mixture.
    """
    rng = np.random.default_rng(25)
    parts: dict[str, list] = {}
    for basis, _, _, crushing, logarithms in _logarithms(pair, paths):
        parts.setdefault(basis, []).append((crushing, logarithms))
    rows = []
    for basis, entries in parts.items():
        entries = [entry for entry in entries if np.isfinite(_means(entry)).all()]
        if not entries:
            continue
        seeds = min(len(paths[crushing]) for crushing in paths if paths[crushing])
        drawn = _drawn(paths, rng)
        measured = np.array([_means(entry) for entry in entries])  # (entries, 2)
        refits = np.array([_means(entry, drawn) for entry in entries])  # (entries, 2, draws)
        said = [
            _predicted(pair, _name(pair, crushing), basis, predictions) for crushing, _ in entries
        ]
        for form in said[0]:
            predicted = np.array([forms[form] for forms in said])
            known = np.isfinite(predicted[:, 0])
            row = {
                "pair": pair.name,
                "law": pair.law,
                "basis": basis,
                "form": form,
                "comparisons": int(known.sum()),
                "not_predicted": int((~known).sum()),
            }
            for part, name in enumerate(("ln_energy", "ln_stress")[: 1 + (basis != "stress")]):
                if not known.any():
                    continue
                errors = predicted[known, part] - measured[known, part]
                errors_drawn = predicted[known, part, None] - refits[known, part]
                for statistic, function in _STATISTICS.items():
                    value = interval_of_refits(
                        function(errors), function(errors_drawn), seeds, CONFIDENCE
                    )
                    if statistic == "rms":
                        value = value._replace(low=max(value.low, 0.0))
                    row |= value.named(f"{statistic}_{name}")
            rows.append(row)
    return rows


def _mean(values):
    """Return the mean of the first axis over what is known."""
    known = np.isfinite(values)
    with np.errstate(invalid="ignore"):
        return np.where(known, values, 0.0).sum(axis=0) / known.sum(axis=0)


_STATISTICS = {"rms": lambda errors: np.sqrt(_mean(errors**2)), "bias": _mean}


def _name(pair, crushing):
    return next(sample.name for sample in pair.samples if sample.crushing == crushing)


def _drawn(paths, rng):
    """Return draws of the seeds of each mixture, as places in its list, shape (draws, seeds)."""
    return {
        crushing: rng.integers(len(seeds), size=(RESAMPLES, len(seeds)))
        for crushing, seeds in paths.items()
        if seeds
    }


def _means(entry, drawn=None):
    """Return ln of the energy and the stress ratio: of all seeds, or of each draw, shape (2, n)."""
    crushing, logarithms = entry
    parts = []
    for which in (crushing, 0.0):
        values = logarithms[which]
        if not values.shape[1]:
            return np.full(2, np.nan)
        values = values if drawn is None else values[:, drawn[which]]
        known = np.isfinite(values)
        with np.errstate(invalid="ignore"):
            parts.append(np.where(known, values, 0.0).sum(axis=-1) / known.sum(axis=-1))
    return parts[0] - parts[1]
