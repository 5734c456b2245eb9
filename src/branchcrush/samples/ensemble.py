"""The seeds of a sample together: their loading paths, and which states a fit may use."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from branchcrush.errors import FitError


def stacked(paths: Sequence[pd.DataFrame]) -> pd.DataFrame:
    """Return the loading paths of all seeds as one table.

    Parameters
    ----------
    paths : list of DataFrame
        A `path.csv` for each seed; all save the same states.

    Returns
    -------
    DataFrame
        With a column `seed_number`, from 0.

    Examples
    --------
    >>> stacked([pd.DataFrame({"state": [0, 1]})] * 2)["seed_number"].tolist()
    [0, 0, 1, 1]
    """
    return pd.concat(
        [path.assign(seed_number=number) for number, path in enumerate(paths)], ignore_index=True
    )


def end_of_loading(path: pd.DataFrame) -> pd.Series:
    """Return the row of the last state before any unloading.

    Parameters
    ----------
    path : DataFrame
        `path.csv`.

    Returns
    -------
    Series

    Examples
    --------
    >>> path = pd.DataFrame({"state": [0, 1, 2], "leg": ["loading", "loading", "unloading"]})
    >>> int(end_of_loading(path)["state"])
    1
    """
    return path[path["leg"] == "loading"].iloc[-1]


def certified_loading(
    certificate: pd.DataFrame, paths: Sequence[pd.DataFrame]
) -> tuple[list[int], list[pd.DataFrame]]:
    """Return the certified states on the way in, of the seeds that are certified to its end.

    Parameters
    ----------
    certificate : DataFrame
        `certificate.csv`; its first seeds are those of the paths.
    paths : list of DataFrame
        The `path.csv` of each seed.

    Returns
    -------
    used : list of int
        Which of the seeds, counted from 0.
    paths : list of DataFrame
        Of these seeds, with the states that are certified in every one of them. The last is the
        end of the loading of each.

    Raises
    ------
    FitError
        When there is no such seed: the sample gives no data for a fit.

    Examples
    --------
    >>> path = pd.DataFrame({"state": [0, 1], "leg": ["loading", "loading"]})
    >>> used, paths = certified_loading(path.assign(seed=7, certified=[False, True]), [path])
    >>> used, paths[0]["state"].tolist()
    ([0], [1])
    """
    usable = certificate["certified"] & (certificate["leg"] == "loading")
    certified = [
        set(states.loc[usable[states.index], "state"])
        for _, states in certificate.groupby("seed", sort=False)
    ][: len(paths)]
    last = max(int(end_of_loading(path)["state"]) for path in paths)
    used = [number for number, states in enumerate(certified) if last in states]
    if not used:
        reached = [end_of_loading(path)["solid_fraction"] for path in paths]
        loaded = sum(bool(end_of_loading(path)["carries_load"]) for path in paths)
        raise FitError(
            f"no packing is certified at the end of its loading: {loaded} of {len(paths)} carry "
            f"load there, at a solid fraction of {np.mean(reached):.4f}"
        )
    common = set.intersection(*(certified[number] for number in used))
    chosen = (paths[number] for number in used)
    return used, [path[path["state"].isin(common)].reset_index(drop=True) for path in chosen]


def on_the_way_in(paths: Sequence[pd.DataFrame], used: Sequence[int]) -> list[pd.DataFrame]:
    """Return the loading states of some seeds, with those before any load.

    Parameters
    ----------
    paths : list of DataFrame
    used : list of int
        Which seeds, counted from 0.

    Returns
    -------
    list of DataFrame

    Examples
    --------
    >>> path = pd.DataFrame({"state": [0, 1], "leg": ["loading", "unloading"]})
    >>> [table["state"].tolist() for table in on_the_way_in([path, path], [1])]
    [[0]]
    """
    loading = (paths[number] for number in used)
    return [path[path["leg"] == "loading"].reset_index(drop=True) for path in loading]


def named_states(path: pd.DataFrame) -> dict[str, int]:
    """Return which states the summaries tell of by a name: the first that all carry, and the last.

    Where the seeds share one state it is the end, and nothing is called near jamming.

    Parameters
    ----------
    path : DataFrame
        From `certified_loading`, of any seed, or from `mean_path`.

    Returns
    -------
    dict of int
        Rows of the path, under near_jamming and end, or under end alone.

    Examples
    --------
    >>> named_states(pd.DataFrame({"state": [3, 4, 5]}))
    {'near_jamming': 0, 'end': 2}
    >>> named_states(pd.DataFrame({"state": [5]}))
    {'end': 0}
    """
    end = {"end": len(path) - 1}
    return end if len(path) == 1 else {"near_jamming": 0, **end}


def mean_path(paths: Sequence[pd.DataFrame], jamming: float) -> pd.DataFrame:
    """Return the states that the seeds share, with their means over the seeds.

    Parameters
    ----------
    paths : list of DataFrame
        From `certified_loading`.
    jamming : float
        Mean phi_J of the packings [-].

    Returns
    -------
    DataFrame
        state, solid_fraction, solid_fraction_above_jamming and mean_stress_Pa, a row a state.

    Examples
    --------
    >>> path = pd.DataFrame({"state": [3], "solid_fraction": [0.7], "mean_stress_Pa": [1e6]})
    >>> mean_path([path, path], 0.5)["solid_fraction_above_jamming"].round(9).tolist()
    [0.2]
    """
    mean = stacked(paths).groupby("state")[["solid_fraction", "mean_stress_Pa"]].mean()
    mean.insert(1, "solid_fraction_above_jamming", mean["solid_fraction"] - jamming)
    return mean.reset_index()
