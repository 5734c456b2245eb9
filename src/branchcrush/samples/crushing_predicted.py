"""Crushing predicted without a simulation, beside what the crushed packings of a sample measure."""

from collections.abc import Mapping

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from branchcrush.branches.crushing_gradings import CrushingGradings
from branchcrush.breakage.rules import Breakage
from branchcrush.crushing.breakage import einav_breakage
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.mixtures import from_radii
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.samples.crushed_sizes import exponent_of_larger
from branchcrush.statistics.resampling import interval_of_refits, seed_draws

# What is predicted, in the order of the tables.
QUANTITIES = (
    "grains_ratio",
    "mean_stress_Pa",
    "elastic_strain",
    "broken_mass_fraction",
    "einav_breakage",
    "number_exponent",
    "coordination_number",
    "dissipated_J_per_m3",
)
# Of the ultimate grading of Einav's breakage, which goes down to the finest fragment.
ULTIMATE_ALPHA = 2.6


def predicted_states(
    path: CrushingGradings, rules: Breakage, solid_fraction: NDArray
) -> pd.DataFrame:
    """Return what is predicted at some solid fractions.

    Parameters
    ----------
    path : CrushingGradings
    rules : Breakage
    solid_fraction : ndarray, shape (S,)
        Rising [-].

    Returns
    -------
    DataFrame
        A row for each: solid_fraction, void_ratio, jamming_solid_fraction and `QUANTITIES`; nan
        below the jamming point and beyond the end of the prediction.
    """
    before = path.grading(0)
    # Classes begin below the smallest first grain, so it is told by mass, not by the first class.
    first = path.diameter[path.mass[0] > 0.0].min()
    measures = [_measures(path.grading(n), before, rules, first) for n in range(len(path.mass))]
    columns = {
        "jamming_solid_fraction": path.jamming,
        "grains_ratio": path.grains,
        "mean_stress_Pa": path.mean_stress,
        "elastic_strain": path.elastic_strain,
        "broken_mass_fraction": path.broken_mass,
        "einav_breakage": [measure[0] for measure in measures],
        "number_exponent": [measure[1] for measure in measures],
        "coordination_number": path.coordination_number,
        "dissipated_J_per_m3": path.dissipated,
    }
    there = {
        name: np.interp(solid_fraction, path.solid_fraction, values, left=np.nan, right=np.nan)
        for name, values in columns.items()
    }
    phi = np.asarray(solid_fraction, float)
    return pd.DataFrame({"solid_fraction": phi, "void_ratio": 1.0 / phi - 1.0} | there)


def measured_states(
    path: pd.DataFrame,
    grains: pd.DataFrame,
    rules: Breakage,
    law: LinearContact | HertzContact,
) -> pd.DataFrame:
    r"""Return the same quantities of a crushed packing, of its states that carry load.

    .. math:: \epsilon_e = \frac{a \Psi}{p}

    Parameters
    ----------
    path, grains : DataFrame
        `path.csv` and `grains.parquet` of a seed.
    rules : Breakage
    law : LinearContact or HertzContact

    Returns
    -------
    DataFrame
        state, solid_fraction and `QUANTITIES`. Energy counts from the last state before load, per
        volume of that state.
    """
    way_in = path[path["leg"] == "loading"]
    loaded = way_in[way_in["carries_load"].astype(bool)]
    if not len(loaded):
        return pd.DataFrame(columns=["state", "solid_fraction", *QUANTITIES])
    loose = way_in[way_in["state"] < loaded["state"].iloc[0]].iloc[-1]
    lost = [path[f"dissipated_{kind}_J"] for kind in ("breakage", "rearrangement")]
    lost = (lost[0] + lost[1]).loc[way_in.index]
    by_state = {state: rows.to_numpy() for state, rows in grains.groupby("state")["radius_m"]}
    first = by_state[0]
    before, smallest = from_radii(first), 2.0 * first.min()
    now = [from_radii(by_state[state]) for state in loaded["state"]]
    measures = np.array([_measures(each, before, rules, smallest) for each in now]).T
    energy = (law.exponent + 1.0) * loaded["elastic_energy_J"] / loaded["volume_m3"]
    columns = {
        "state": loaded["state"],
        "solid_fraction": loaded["solid_fraction"],
        "grains_ratio": loaded["grains"] / first.size,
        "mean_stress_Pa": loaded["mean_stress_Pa"],
        "elastic_strain": energy / loaded["mean_stress_Pa"],
        "broken_mass_fraction": loaded["broken_mass_fraction"],
        "einav_breakage": measures[0],
        "number_exponent": measures[1],
        "coordination_number": loaded["coordination_number"],
        "dissipated_J_per_m3": (lost[loaded.index] - lost[loose.name]) / loose["volume_m3"],
    }
    return pd.DataFrame(columns).reset_index(drop=True)


def beside_predicted(
    predicted: pd.DataFrame, measured: Mapping[int, pd.DataFrame], confidence: float = 0.95
) -> pd.DataFrame:
    r"""Return the prediction beside the mean of the seeds, at each of their states.

    .. math:: \mathrm{error} = \ln \frac{\mathrm{predicted}}{\mathrm{measured}}

    Parameters
    ----------
    predicted : DataFrame
        From `predicted_states`.
    measured : mapping of int to DataFrame
        From `measured_states`, by seed.
    confidence : float
        Between 0 and 1 [-].

    Returns
    -------
    DataFrame
        A row for each state that all seeds have and each quantity: state, solid_fraction,
        quantity, predicted, measured, measured_low, measured_high, seeds, error; nan where
        either is not above 0 or not known.

    Examples
    --------
    >>> seed = pd.DataFrame({"state": [4], "solid_fraction": [0.7]})
    >>> seed = seed.assign(**dict.fromkeys(QUANTITIES, 2.0))
    >>> said = seed.assign(**dict.fromkeys(QUANTITIES, 4.0))
    >>> table = beside_predicted(said, {1: seed, 2: seed})
    >>> table[["predicted", "measured", "error"]].round(3).to_numpy()[0].tolist()
    [4.0, 2.0, 0.693]
    """
    every = pd.concat(measured.values())
    counts = every.groupby("state").size()
    common = counts.index[counts == len(measured)]
    rows = []
    rng = np.random.default_rng(len(measured))
    draws = seed_draws(len(measured), 2000, rng) / len(measured)
    for state in common:
        here = every[every["state"] == state]
        phi = float(here["solid_fraction"].mean())
        for quantity in QUANTITIES:
            values = here[quantity].to_numpy(float)
            mean = float(values.mean())
            told = interval_of_refits(mean, draws @ values, len(measured), confidence)
            says = np.interp(
                phi,
                predicted["solid_fraction"],
                predicted[quantity],
                left=np.nan,
                right=np.nan,
            )
            both = says > 0.0 and mean > 0.0
            rows.append(
                {"state": state, "solid_fraction": phi, "quantity": quantity}
                | {"predicted": float(says)}
                | told.named("measured")
                | {"seeds": len(measured), "error": np.log(says / mean) if both else np.nan}
            )
    return pd.DataFrame(rows)


def _measures(
    now: Grading, before: Grading, rules: Breakage, smallest: float
) -> tuple[float, float]:
    """Return Einav's breakage down to the finest fragment, and the exponent of N(>d)."""
    largest = float(before.support()[1])
    finest = rules.finest_diameter / 2.0
    breakage = np.nan
    if finest < largest:
        breakage = einav_breakage(before, now, ULTIMATE_ALPHA, largest, finest)
    alpha = exponent_of_larger(
        lambda size: 1.0 - now.number_cdf(size / 2.0), rules.smallest_diameter, smallest
    )
    return breakage, alpha
