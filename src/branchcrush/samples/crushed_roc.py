"""Which grains break next: how well what a state shows of a grain foretells it."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from branchcrush.energy.grain_loads import PREDICTED, grain_loads, predicted_loads
from branchcrush.energy.predictors import PREDICTORS
from branchcrush.packings.network import state_network
from branchcrush.statistics.resampling import Resampling, share_interval
from branchcrush.statistics.roc import Places, places, roc_curve

# What needs the strength of each grain, which an experiment does not know.
KNOWN_STRENGTH = ("stress_over_strength", "weakness")
FORETELLERS = (
    *KNOWN_STRENGTH,
    "stress",
    "largest_force",
    "contacts",
    "radius",
    "mean_branch",
    "longest_branch",
    "energy",
    "split_energy",
    *(PREDICTED + name for name in PREDICTORS),
    "share_smaller",
)
# Who is compared: all grains above the limit, or those alone that carry load.
AMONG = ("all", "bearing")
_ALARMS = np.linspace(0.0, 1.0, 101)


def grains_at_risk(
    grains: pd.DataFrame, contacts: pd.DataFrame, walls: pd.DataFrame, limit: float
) -> pd.DataFrame:
    """Return every grain that could break in each state, what it bears, and whether it breaks.

    Parameters
    ----------
    grains, contacts, walls : DataFrame
        `grains.parquet`, `contacts.parquet` and `wall_contacts.parquet` of a seed's crushing.
    limit : float
        The comminution limit, a diameter [m]: what is not above it never breaks.

    Returns
    -------
    DataFrame
        A row for each grain above the limit in each state but the last: state, grain, generation,
        broke (before the next saved state), bearing, and `FORETELLERS`; nan where a predictor could
        not be fitted.
    """
    by_state = dict(tuple(grains.groupby("state", sort=True)))
    parts = []
    for state, following in zip(list(by_state)[:-1], list(by_state)[1:], strict=True):
        of = by_state[state]
        network = state_network(of["radius_m"].to_numpy(), contacts, walls, state)
        stress, strength = of["stress_Pa"].to_numpy(), of["strength_Pa"].to_numpy()
        table = pd.DataFrame(
            {
                "state": state,
                "grain": of["grain"].to_numpy(),
                "generation": of["generation"].to_numpy(),
                "broke": ~np.isin(of["grain"], by_state[following]["grain"]),
                "bearing": network.bearing,
                "stress_over_strength": stress / strength,
                "weakness": 1.0 / strength,
                "stress": stress,
                **grain_loads(network),
                **(predicted_loads(network) if network.i.size else {}),
            }
        )
        parts.append(table[2.0 * table["radius"] > limit])
    if not parts:
        return pd.DataFrame(columns=["state", "grain", "generation", "broke", "bearing"])
    return pd.concat(parts, ignore_index=True).reindex(
        columns=["state", "grain", "generation", "broke", "bearing", *FORETELLERS]
    )


def foretellers(
    seeds: Sequence[pd.DataFrame], *, confidence: float, resamples: int
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Return ROC curves of everything that could foretell breaking, and the areas under them.

    A grain that breaks is compared with the grains of its own state that do not, so the load of
    the packing as a whole foretells nothing; every grain that breaks counts alike.

    Parameters
    ----------
    seeds : list of DataFrame
        From `grains_at_risk`, of each seed.
    confidence : float
    resamples : int
        Draws of the seeds.

    Returns
    -------
    areas : DataFrame
        among, foreteller, needs_strength, breakages, area, area_low, area_high, direction: "more"
        where grains with more of it break, "less", or "undecided" where the interval holds 1/2 or
        there is none.
    curves : DataFrame
        among, foreteller, false_alarms, found.
    """
    rows, curves = [], []
    for among in AMONG:
        of_whom = [seed if among == "all" else seed[seed["bearing"]] for seed in seeds]
        for name in FORETELLERS:
            found = [_places(seed, name) for seed in of_whom]
            number = sum(one.above.size for one in found)
            sums = np.array([[one.below.sum(), one.above.size] for one in found])
            area = share_interval(
                sums,
                confidence=confidence,
                resamples=resamples,
                rng=Resampling.CRUSHED_GRAINS.rng(),
            )
            kind = {"among": among, "foreteller": name}
            rows.append(
                {
                    **kind,
                    "needs_strength": name in KNOWN_STRENGTH,
                    "breakages": number,
                    **area.named("area"),
                    "direction": _direction(area.low, area.high),
                }
            )
            together = Places(*(np.concatenate(part) for part in zip(*found, strict=True)))
            curves.append(
                pd.DataFrame(
                    {**kind, "false_alarms": _ALARMS, "found": roc_curve(together, _ALARMS)}
                )
            )
    return pd.DataFrame(rows), pd.concat(curves, ignore_index=True)


def _places(seed: pd.DataFrame, name: str) -> Places:
    """Return the places of a seed's broken grains, each in its own state."""
    known = seed[seed[name].notna()]
    parts = [
        places(state[name], state["broke"])
        for _, state in known.groupby("state")
        if state["broke"].any()
    ]
    if not parts:
        return Places(np.empty(0), np.empty(0))
    return Places(*(np.concatenate(part) for part in zip(*parts, strict=True)))


def _direction(low: float, high: float) -> str:
    if low > 0.5:
        return "more"
    return "less" if high < 0.5 else "undecided"
