"""What the notes of a certificate are likely to change: `python studies/quality/effects.py`.

Reads studies/quality/results, as `make quality` leaves it, and prints the table that is kept as
docs/results/note_effects.csv and, in words, in `branchcrush.samples.note_effects`.
"""

import sys
from pathlib import Path

import numpy as np
import pandas as pd
from scipy.stats import linregress

from branchcrush.files.tables import read_json, read_packing, read_table
from branchcrush.packings.geometry import shared_volume
from branchcrush.samples.ensemble import end_of_loading

RESULTS = Path(__file__).parent / "results"
# Overlap over the smaller radius at 95 % of the contacts, at which its effect is told [-].
LEVELS = (0.05, 0.10, 0.15)
SETTINGS = {
    "paper": "uniform 200, walls, linear",
    "fractal": "fractal 5, periodic, linear",
    "lognormal": "lognormal, periodic, Hertz",
    "walls": "uniform 200, walls, linear",
    "periodic": "uniform 200, periodic, linear",
}


def main() -> None:
    """Print the table as CSV."""
    rows = []
    for sample in ("paper-standard", "fractal-standard", "lognormal-standard"):
        rows += _of_overlaps(sample)
    for boundary in ("walls", "periodic"):
        rows += _of_few_grains(boundary)
    rows += _of_steps(["paper", "lognormal", "fractal"])
    pd.DataFrame(rows).to_csv(sys.stdout, index=False, float_format="%.3g")


def _of_overlaps(sample):
    """Return what follows from the volume that overlapping grains count twice.

    The solid fraction of the path is that of whole spheres; that of their union is lower by the
    lenses. At a solid fraction of the union the packing is so much further along its path.
    """
    seeds = _seeds_of(sample)
    paths = [_loaded_path(seed) for seed in seeds]
    exponents = read_table(RESULTS / sample / "energy_split_path.csv").set_index("state")
    common = sorted(set.intersection(*(set(path.index) for path in paths)) & set(exponents.index))
    paths = [path.loc[common] for path in paths]
    fraction = np.mean([path["solid_fraction"] for path in paths], axis=0)
    line = linregress(fraction, exponents.loc[common, "exponent"])
    for level in LEVELS:
        found = [_at_level(path, level) for path in paths]
        if not np.isfinite(found).all():
            continue
        lens, stress, energy = np.array(found).T
        yield {
            **_row_of("overlaps", level, sample, len(seeds)),
            "volume_percent": 100 * lens.mean(),
            "volume_percent_error": 100 * _standard_error(lens),
            **_percent("stress", stress),
            **_percent("energy", energy),
            # A straight line: from state to state the exponent is not sure enough for a slope.
            "exponent": lens.mean() * line.slope,
            "exponent_error": lens.mean() * line.stderr,
        }


def _loaded_path(folder):
    """Return the states that carry load, with the share of the cell that is counted twice."""
    path = read_table(folder / "path.csv")
    path = path[path["carries_load"] & (path["leg"] == "loading")].set_index("state")
    contacts = read_table(folder / "contacts.parquet")
    lenses = shared_volume(contacts["radius_i_m"], contacts["radius_j_m"], contacts["overlap_m"])
    twice = lenses.groupby(contacts["state"]).sum()
    walls = read_table(folder / "wall_contacts.parquet")
    _, radii, _ = read_packing(folder / "packing.npz")
    height = walls["overlap_m"]
    caps = np.pi * height**2 * (3 * radii[walls["i"]] - height) / 3  # outside the cell
    twice = twice.add(caps.groupby(walls["state"]).sum(), fill_value=0.0)
    path["twice"] = twice.reindex(path.index) / path["volume_m3"]
    return path


def _at_level(path, level):
    """Return shared volume over the cell's, and what it does to ln P and ln E/V, at a level."""
    depth = path["overlap_ratio_95"].to_numpy()
    if not depth.min() < level <= depth.max():
        return [np.nan] * 3
    fraction = (path["solid_fraction"] - path["twice"]).to_numpy()
    density = path["elastic_energy_J"] / path["volume_m3"]
    lens = np.interp(level, depth, path["twice"])
    slopes = [
        np.interp(level, depth, np.gradient(values, fraction))
        for values in (np.log(path["mean_stress_Pa"]), np.log(density))
    ]
    return [lens, *(lens * slope for slope in slopes)]


def _of_few_grains(boundary):
    """Return what a cell of 3.1 diameters changes beside one of 5, at the same target."""
    few, many = f"{boundary}-box-3", f"{boundary}-box-5"
    ends = [pd.DataFrame(list(map(_end_of, _seeds_of(name)))) for name in (few, many)]
    n = [_exponents_of(name) for name in (few, many)]
    yield {
        **_row_of("few grains", 3.1, few, len(ends[0])),
        **_difference("stress", *(np.log(end["stress"]) for end in ends)),
        **_difference("energy", *(np.log(end["energy"]) for end in ends)),
        "exponent": n[0].mean() - n[1].mean(),
        "exponent_error": np.hypot(*map(_standard_error, n)),
    }


def _seeds_of(sample):
    return sorted((RESULTS / sample).glob("seed_*"))


def _end_of(folder):
    end = end_of_loading(read_table(folder / "path.csv"))
    return {
        "stress": end["mean_stress_Pa"],
        "energy": end["elastic_energy_J"] / end["volume_m3"],
    }


def _exponents_of(sample):
    return np.array(read_json(RESULTS / sample / "energy_split.json")["exponent_of_each_seed"])


def _of_steps(gradings):
    """Return what the standard steps change beside those of a quarter of them, of all gradings."""
    table = read_table(RESULTS / "comparison.csv").set_index("sample")
    standard, fine = (
        table.loc[[f"{grading}-{quality}" for grading in gradings]].reset_index()
        for quality in ("standard", "fine")
    )
    change = (
        np.log(standard["mean_stress_Pa"] / fine["mean_stress_Pa"]),
        np.log(standard["elastic_energy_J_per_m3"] / fine["elastic_energy_J_per_m3"]),
        standard["exponent"] - fine["exponent"],
    )
    yield {
        **_row_of("convergence", 0.0, "standard against fine, three gradings", 12),
        **_percent("stress", change[0]),
        **_percent("energy", change[1]),
        "exponent": change[2].mean(),
        "exponent_error": _standard_error(change[2]),
    }


def _row_of(check, level, sample, packings):
    measured_on = SETTINGS.get(sample.split("-")[0], sample)
    return {"check": check, "level": level, "measured_on": measured_on, "packings": packings}


def _percent(name, logarithms):
    """Return a mean change of a logarithm as a percentage, with its standard error."""
    logarithms = np.asarray(logarithms)
    return _of_logarithm(name, logarithms.mean(), _standard_error(logarithms))


def _difference(name, one, other):
    error = np.hypot(_standard_error(one), _standard_error(other))
    return _of_logarithm(name, one.mean() - other.mean(), error)


def _of_logarithm(name, change, error):
    ratio = np.exp(change)
    return {f"{name}_percent": 100 * (ratio - 1), f"{name}_percent_error": 100 * ratio * error}


def _standard_error(values):
    values = np.asarray(values, dtype=float)
    return values.std(ddof=1) / np.sqrt(values.size)


if __name__ == "__main__":
    main()
