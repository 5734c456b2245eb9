"""The tables over all samples, and the page that a person opens."""

import base64
from pathlib import Path

import numpy as np
from jinja2 import Environment, StrictUndefined

from branchcrush import __version__


def comparison_row(name, fit, model):
    """Return the row of `comparison.csv` of a sample.

    Parameters
    ----------
    name : str
    fit, model : dict
        `energy_split.json` and `thermodynamics.json`.

    Returns
    -------
    dict
    """
    return {
        "sample": name,
        "exponent": fit["exponent"],
        "exponent_low": fit["exponent_low"],
        "exponent_high": fit["exponent_high"],
        "confidence": fit["confidence"],
        "seeds": fit["seeds"],
        "branches": fit["branches"],
        "solid_fraction": fit["solid_fraction"],
        "jamming_solid_fraction": model["jamming_solid_fraction"],
        "median_overlap_ratio": fit["median_overlap_ratio"],
        "coordination_number": fit["coordination_number"],
        "mechanical_coordination_number": fit["mechanical_coordination_number"],
        "rattler_fraction": fit["rattler_fraction"],
        "theta": model["theta"],
    }


def convergence_rows(name, steps, once, twice):
    """Return the rows of `convergence.csv` of a sample: its quantities at N and at 2 N steps.

    Parameters
    ----------
    name : str
    steps : int
        N.
    once, twice : tuple of (dict, list of DataFrame)
        `energy_split.json`, and the `path.csv` of each seed.

    Returns
    -------
    list of dict
        For each quantity its value at N and 2 N steps, their difference, its standard error over
        the seeds (pairs of the same seed), and half the interval of the value at N.
    """
    (fit, paths), (refined_fit, refined_paths) = once, twice
    seeds = np.array([fit["exponent_of_each_seed"], refined_fit["exponent_of_each_seed"]])
    half = np.nan
    if fit["exponent_low"] is not None:
        half = (fit["exponent_high"] - fit["exponent_low"]) / 2
    rows = [_row(name, steps, "exponent", fit["exponent"], refined_fit["exponent"], seeds, half)]
    for quantity in _CONVERGED:
        seeds = np.array([[path[quantity].iloc[-1] for path in p] for p in (paths, refined_paths)])
        rows.append(_row(name, steps, quantity, *seeds.mean(axis=1), seeds, np.nan))
    return rows


_CONVERGED = (
    "mean_stress_Pa",
    "elastic_energy_J",
    "work_J",
    "coordination_number",
    "mechanical_coordination_number",
    "force_evaluations",
)


def _row(name, steps, quantity, value, refined, seeds, half):
    pairs = seeds[1] - seeds[0]
    error = pairs.std(ddof=1) / np.sqrt(pairs.size) if pairs.size > 1 else np.nan
    return {
        "sample": name,
        "quantity": quantity,
        "steps": steps,
        "value": value,
        "value_at_twice_the_steps": refined,
        "difference": refined - value,
        "standard_error_of_difference": error,
        "half_interval": half,
    }


def render_report(template, samples):
    """Return the report as one HTML page with its figures inside.

    Parameters
    ----------
    template : str
        Jinja source.
    samples : list of dict
        name, settings, fit, model, statistics, paths and figures of each sample.

    Returns
    -------
    str
    """
    environment = Environment(autoescape=True, undefined=StrictUndefined)
    environment.filters |= {"image": _image, "interval": _interval}
    pages = [{**sample, "checks": _checks(sample["paths"])} for sample in samples]
    return environment.from_string(template).render(samples=pages, version=__version__)


def _checks(paths):
    """Return what the identities of the saved states come to, the worst of all seeds."""
    loaded = [path[path["carries_load"]] for path in paths]
    stress = [abs(p["mean_stress_Pa"] / p["boundary_stress_Pa"] - 1).max() for p in loaded]
    return {
        "states": sum(len(path) for path in paths),
        "loaded": sum(len(path) for path in loaded),
        "unbalanced": max(path["unbalanced_force_ratio"].max() for path in paths),
        "stress": max(stress),
        "inertial": max(path["inertial_number"].max() for path in loaded),
        "dissipated": float(
            np.mean([p["dissipated_J"].iloc[-1] / p["work_J"].iloc[-1] for p in paths])
        ),
        "least_dissipated": min(path["dissipated_J"].min() for path in paths),
        "escaped": int(sum(path["escaped"].iloc[-1] for path in paths)),
        "evaluations": int(np.mean([path["force_evaluations"].iloc[-1] for path in paths])),
        "stress_MPa": float(np.mean([path["mean_stress_Pa"].iloc[-1] for path in paths])) / 1e6,
    }


def _image(path):
    return "data:image/png;base64," + base64.b64encode(Path(path).read_bytes()).decode()


def _interval(fit):
    if fit["exponent_low"] is None:
        return f"{fit['exponent']:.2f} (one seed: no interval)"
    return (
        f"{fit['exponent']:.2f} ({fit['confidence']:.0%} interval "
        f"{fit['exponent_low']:.2f} to {fit['exponent_high']:.2f})"
    )
