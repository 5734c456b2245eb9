"""Rule crushing_results: means over seeds along a crushing."""

from collections.abc import Mapping
from typing import Any

import pandas as pd

from branchcrush.samples.crushed_line import named_mean
from branchcrush.samples.crushed_path import PARTS, TOLD

# Quantities of a state of which the mean over seeds is told.
AVERAGED = (
    "mean_stress_Pa",
    "elastic_strain",
    "broken_mass_fraction",
    "crushing_by_contacts",
    "crushing_by_random_contacts",
    "einav_breakage",
    "einav_breakage_down_to_0",
    "hardin_breakage",
    "number_exponent",
    "energy_over_control",
    "stress_over_control",
    "dissipated_J_per_m3",
    "compaction_work_J_per_m3",
    *(f"{part}_share" for part in TOLD),
)


def per_volume(states: pd.DataFrame) -> pd.DataFrame:
    """Return the states with energies over the volume at jamming before crushing, as forms have it.

    Parameters
    ----------
    states : DataFrame
        `crushing_states.csv`, with volume_m3 and jamming_before.

    Returns
    -------
    DataFrame
        With dissipated_J_per_m3, of breakage and rearrangement since the first breakage, and
        compaction_work_J_per_m3.
    """
    volume = states["solid_fraction"] * states["volume_m3"] / states["jamming_before"]
    lost = states[[f"{part}_since_breakage_J" for part in PARTS[1:]]].sum(axis=1, skipna=False)
    return states.assign(
        dissipated_J_per_m3=lost / volume,
        compaction_work_J_per_m3=states["compaction_work_J"] / volume,
    )


def crushed_means(states: pd.DataFrame, intervals: Mapping[str, Any]) -> pd.DataFrame:
    """Return means over seeds of the states of the way in, with intervals.

    Parameters
    ----------
    states : DataFrame
        `crushing_states.csv`.
    intervals : mapping
        confidence and resamples.

    Returns
    -------
    DataFrame
        `crushing_means.csv`: a row for each state and step, whole or halved; column seeds says how
        many a mean is of.
    """
    way_in = states[(states["leg"] == "loading") & states["carries_load"].astype(bool)]
    rows = []
    for (halved, state), here in way_in.groupby(["halved_step", "state"]):
        row = {
            "halved_step": halved,
            "state": state,
            "seeds": len(here),
            "solid_fraction": here["solid_fraction"].mean(),
            "void_ratio": here["void_ratio"].mean(),
        }
        for name in AVERAGED:
            row |= named_mean(name, here[name].to_list(), intervals)
        rows.append(row)
    return pd.DataFrame(rows)
