"""Rule certificate: which saved states are at rest, with a closed account, for fits to use."""

import contextlib
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from branchcrush.errors import FitError
from branchcrush.loading.jamming import jamming_point
from branchcrush.loading.states import stress_floor
from branchcrush.loading.targets import INERTIAL_TOLERANCE, STEP_UNBALANCED_FORCE_RATIO
from branchcrush.packings.contact_laws import OVERLAP_FLAG, HertzContact, LinearContact
from branchcrush.samples.ensemble import end_of_loading

# Largest value of each measure in a certified state.
LIMITS = {
    "unbalanced_force_ratio": 1e-6,
    "inertial_number": INERTIAL_TOLERANCE,
    "stress_identity_error": 1e-6,
    "contact_law_error": 1e-9,
    "energy_excess": 1e-4,
    "escaped": 0,
    "lost": 0,
}
# Of packings that another code made, whose files tell no work, no motion and no boundary's stress:
# the balance of forces has a limit of the user's own, and the law is told of in the notes.
_OF_READ = ("escaped", "lost")


def limits_of(packing: Mapping[str, Any] | None) -> Mapping[str, float]:
    """Return the limits that the states of a sample are held to.

    Parameters
    ----------
    packing : mapping or None
        Settings of packings that another code made, with `largest_unbalanced_force_ratio`; None of
        those that were compressed here.

    Returns
    -------
    dict

    Examples
    --------
    >>> limits_of({"largest_unbalanced_force_ratio": 0.01})
    {'unbalanced_force_ratio': 0.01, 'escaped': 0, 'lost': 0}
    """
    if packing is None:
        return LIMITS
    known = {name: LIMITS[name] for name in _OF_READ}
    return {"unbalanced_force_ratio": packing["largest_unbalanced_force_ratio"], **known}


# What a state or a sample is called whose numbers stand, with something to be read beside them.
NOTED = "certified with notes"
_MEANING = {
    "unbalanced_force_ratio": "not at rest: unbalanced force ratio",
    "inertial_number": "moving: inertial number",
    "stress_identity_error": "stress of the branches differs from that of the boundary by",
    "contact_law_error": "forces differ from the contact law by",
    "energy_excess": "more energy stored than work done, by",
    "escaped": "grains outside the cell:",
    "lost": "grains lost:",
}


def certificate_tables(
    law: LinearContact | HertzContact,
    seeds: Sequence[int],
    paths: Sequence[pd.DataFrame],
    steps: Sequence[pd.DataFrame],
    radii: Sequence[ArrayLike],
    limits: Mapping[str, float] = LIMITS,
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Return the certificates of all states and the jamming points of all packings.

    Parameters
    ----------
    law : LinearContact or HertzContact
    seeds : list of int
    paths, steps : list of DataFrame
        `path.csv` and `steps.csv` of each seed.
    radii : list of array_like
        Of the grains of each seed [m].
    limits : mapping
        The largest value of each measure that is judged.

    Returns
    -------
    states : DataFrame
        From `state_certificates`.
    points : DataFrame
        From `jamming_points`.
    """
    floors = [stress_floor(seed, law) for seed in radii]
    points = jamming_points(seeds, steps, paths, law.exponent, floors)
    return state_certificates(seeds, paths, limits), points


def state_certificates(
    seeds: Sequence[int],
    paths: Sequence[pd.DataFrame],
    limits: Mapping[str, float] = LIMITS,
) -> pd.DataFrame:
    """Return the measures and the verdict of every saved state of every seed.

    A state is certified when all its measures are within their limits and it carries load. Notes do
    not take a certificate away.

    Parameters
    ----------
    seeds : list of int
    paths : list of DataFrame
        The `path.csv` of each seed.
    limits : mapping
        The largest value of each measure that is judged.

    Returns
    -------
    DataFrame
        A row for each seed and state: its measures, `certified`, `verdict` and `reasons`.
    """
    tables = []
    for seed, path in zip(seeds, paths, strict=True):
        work = path["work_J"].where(path["work_J"] > 0)
        measures = _measures(path, work)
        verdicts = [
            _verdict(row, carries, overlap, limits)
            for (_, row), carries, overlap in zip(
                measures.iterrows(), path["carries_load"], path["overlap_ratio_95"], strict=True
            )
        ]
        described = path[
            ["state", "leg", "solid_fraction", "mean_stress_Pa", "carries_load", "rattler_fraction"]
        ]
        overlaps = path[["median_overlap_ratio", "overlap_ratio_95", "max_overlap_ratio"]]
        share = pd.DataFrame({"dissipated_share": path["dissipated_J"] / work})
        table = pd.concat([described, measures, share, overlaps], axis=1)
        table.insert(0, "seed", seed)
        table[["certified", "verdict", "reasons"]] = verdicts
        tables.append(table)
    return pd.concat(tables, ignore_index=True)


def _measures(path, work):
    """Return the measures of `LIMITS` of each state of a path."""
    loaded = path["carries_load"].to_numpy(dtype=bool)
    boundary = path["boundary_stress_Pa"].where(loaded)
    return pd.DataFrame(
        {
            "unbalanced_force_ratio": path["unbalanced_force_ratio"].where(loaded),
            "inertial_number": path["inertial_number"],
            "stress_identity_error": (path["mean_stress_Pa"] / boundary - 1.0).abs(),
            "contact_law_error": path["contact_law_error"],
            "energy_excess": (-path["dissipated_J"] / work).where(loaded).clip(lower=0.0),
            "escaped": path["escaped"],
            "lost": path["lost"],
        }
    )


def _verdict(measures, carries_load, overlap, limits):
    reasons = [
        f"{_MEANING[name]} {measures[name]:.3g}, at most {limit:g}"
        for name, limit in limits.items()
        # Without load some measures have no meaning and are not a number; with it all have.
        if measures[name] > limit or (carries_load and np.isnan(measures[name]))
    ]
    if reasons:
        return False, "not certified", "; ".join(reasons)
    if not carries_load:
        return False, "no load", ""
    if overlap > OVERLAP_FLAG:
        return True, NOTED, f"overlap at 95 % of the contacts is {overlap:.0%} of the radius"
    return True, "certified", ""


def jamming_points(
    seeds: Sequence[int],
    steps: Sequence[pd.DataFrame],
    paths: Sequence[pd.DataFrame],
    contact_exponent: float,
    floors: Sequence[float],
) -> pd.DataFrame:
    """Return the jamming point of every packing, on the way in and on the way back.

    Steps that went on before they came to rest are left out: their stress is that of motion.

    Parameters
    ----------
    seeds : list of int
    steps, paths : list of DataFrame
        `steps.csv` and `path.csv` of each seed.
    contact_exponent : float
        Of the contact law [-].
    floors : list of float
        The mean stress of each packing that stands for no load [Pa].

    Returns
    -------
    DataFrame
        A row for each seed; nan where too few steps carry load.
    """
    rows = []
    for seed, table, path, floor in zip(seeds, steps, paths, floors, strict=True):
        beyond = (table["solid_fraction"] - end_of_loading(path)["solid_fraction"]).abs()
        # A run that stopped on the approach has no strain step.
        turn = int(np.argmin(beyond)) + 1 if len(table) else 0
        row = {"seed": seed}
        for leg, part in (("loading", table[:turn]), ("unloading", table[turn:])):
            phi, error, states = np.nan, np.nan, 0
            part = part[part["unbalanced_force_ratio"] <= max(STEP_UNBALANCED_FORCE_RATIO.values())]
            loaded = part["mean_stress_Pa"] > floor
            with contextlib.suppress(FitError):
                phi, error, states = jamming_point(
                    part["solid_fraction"], part["mean_stress_Pa"], contact_exponent, loaded
                )
            row |= {
                f"jamming_solid_fraction_{leg}": phi,
                f"uncertainty_{leg}": error,
                f"steps_{leg}": states,
            }
        first = (table["mean_stress_Pa"].iloc[:1] > floor).any()
        rows.append({**row, "loaded_from_the_start": bool(first)})
    return pd.DataFrame(rows)
