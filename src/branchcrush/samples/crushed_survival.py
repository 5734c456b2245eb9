"""Which grains survive: breakages by contacts and radius, and the first grains that are left."""

import itertools
import warnings
from collections.abc import Sequence

import numpy as np
import pandas as pd
from scipy.stats import CensoredData, ecdf

from branchcrush.statistics.resampling import Resampling, share_interval

# Classes of contacts begin at these numbers; fewer than four are a rattler's.
CONTACT_CLASSES = np.array([0, 4, 6, 8, 12, 20])
GROUPS = ("all", "first", "fragments")
# A grain is large where its radius is above half of the largest of the seed's first grains.
_LARGE = 0.5


def hazards(
    seeds: Sequence[pd.DataFrame], limit: float, *, confidence: float, resamples: int
) -> pd.DataFrame:
    r"""Return breakages per grain and state, by contacts and by radius of the state before.

    .. math:: h = \sum_s \mathrm{breakages}_s / \sum_s \mathrm{grains\ at\ risk}_s

    States before the first breakage of a seed are left out: nothing has broken there.

    Parameters
    ----------
    seeds : list of DataFrame
        From `crushed_roc.grains_at_risk`, of each seed.
    limit : float
        Comminution limit [m].
    confidence : float
    resamples : int

    Returns
    -------
    DataFrame
        group (of `GROUPS`, or "large": radius above half of the largest), by ("contacts",
        "contacts_of_bearing_large", "radius"), low and high of the class (contacts, or diameters
        over the limit), at_risk, breakages, hazard, hazard_low, hazard_high; empty classes are not
        there.
    """
    seeds = [from_first_breakage(seed) for seed in seeds]
    largest = max((seed["radius"].max() for seed in seeds if len(seed)), default=np.nan)
    if not np.isfinite(largest):
        return pd.DataFrame(columns=["group", "by", "low", "high", "at_risk", "breakages"])
    doublings = 2.0 ** np.arange(int(np.floor(np.log2(2.0 * largest / limit))) + 2)
    members = {
        "all": lambda seed: seed,
        "first": lambda seed: seed[seed["generation"] == 0],
        "fragments": lambda seed: seed[seed["generation"] > 0],
        "large": lambda seed: seed[seed["radius"] > _LARGE * largest],
    }
    rows = []
    for group, of in members.items():
        kept = [of(seed) for seed in seeds]
        for by, edges in (("contacts", np.append(CONTACT_CLASSES, np.inf)), ("radius", doublings)):
            sums = np.stack([_counted(seed, by, edges, limit) for seed in kept])
            hazard = share_interval(
                sums,
                confidence=confidence,
                resamples=resamples,
                rng=Resampling.CRUSHED_GRAINS.rng(),
            )
            broken, at_risk = sums.sum(axis=0).astype(int)
            rows += [
                {
                    "group": group,
                    "by": by,
                    "low": edges[k],
                    "high": edges[k + 1],
                    "at_risk": at_risk[k],
                    "breakages": broken[k],
                    **hazard.part(k).named("hazard"),
                }
                for k in np.flatnonzero(at_risk)
            ]
    return pd.DataFrame(rows)


def from_first_breakage(seed: pd.DataFrame) -> pd.DataFrame:
    """Return the grains at risk from the first state on after which a grain breaks.

    Parameters
    ----------
    seed : DataFrame
        From `crushed_roc.grains_at_risk`.

    Returns
    -------
    DataFrame
        Empty where none breaks.
    """
    broke = seed.loc[seed["broke"].astype(bool), "state"]
    return seed[seed["state"] >= broke.min()] if len(broke) else seed.iloc[:0]


def _counted(seed, by, edges, limit):
    value = seed["contacts"] if by == "contacts" else 2.0 * seed["radius"] / limit
    place = np.digitize(value, edges) - 1
    number = len(edges) - 1
    broken = seed["broke"].to_numpy(dtype=float)
    return np.array(
        [np.bincount(place, broken, number)[:number], np.bincount(place, minlength=number)[:number]]
    )


def first_grains(
    grains: pd.DataFrame, contacts: pd.Series, solid_fraction: pd.Series
) -> pd.DataFrame:
    """Return every first grain of a seed, its contacts when breaking begins, and how long it lasts.

    Parameters
    ----------
    grains : DataFrame
        `grains.parquet` of a seed.
    contacts : Series
        Number of contacts by the grain's number, of those that are left when breaking begins.
    solid_fraction : Series
        phi by the number of the state.

    Returns
    -------
    DataFrame
        grain, radius_m, contacts (nan where the grain was gone), solid_fraction (of the state it
        broke on the way to, or of the last), survived.
    """
    last = grains["state"].max()
    first = grains[grains["generation"] == 0]
    of = first.groupby("grain").agg(radius_m=("radius_m", "first"), until=("state", "max"))
    of["survived"] = of["until"] == last
    of["contacts"] = contacts.reindex(of.index)
    gone = np.minimum(of["until"] + 1, last)
    of["solid_fraction"] = solid_fraction.loc[gone].to_numpy(dtype=float)
    return of.drop(columns="until").reset_index()


def survivals(seeds: Sequence[pd.DataFrame], *, confidence: float, resamples: int) -> pd.DataFrame:
    """Return the share of the first grains that is left after the path, by radius and contacts.

    Parameters
    ----------
    seeds : list of DataFrame
        From `first_grains`, of each seed.
    confidence : float
    resamples : int

    Returns
    -------
    DataFrame
        by ("radius", thirds of the first grains; "contacts", `CONTACT_CLASSES`), low, high (of the
        radius [m], or of contacts), first_grains, survivors, share, share_low, share_high.
    """
    thirds = _thirds(pd.concat([seed["radius_m"] for seed in seeds]))
    rows = []
    for by, column, edges in (
        ("radius", "radius_m", thirds),
        ("contacts", "contacts", np.append(CONTACT_CLASSES, np.inf)),
    ):
        for low, high in itertools.pairwise(edges):
            of = [seed.loc[seed[column].between(low, high, "left"), "survived"] for seed in seeds]
            sums = np.array([[one.sum(), one.size] for one in of], dtype=float)
            if not sums[:, 1].any():
                continue
            share = share_interval(
                sums,
                confidence=confidence,
                resamples=resamples,
                rng=Resampling.CRUSHED_GRAINS.rng(),
            )
            left, number = sums.sum(axis=0).astype(int)
            rows.append(
                {
                    "by": by,
                    "low": low,
                    "high": high,
                    "first_grains": number,
                    "survivors": left,
                    **share.named("share"),
                }
            )
    return pd.DataFrame(rows)


def survival_curves(seeds: Sequence[pd.DataFrame]) -> pd.DataFrame:
    """Return the share of the first grains left at each solid fraction, by thirds of their radius.

    Kaplan and Meier's estimate of all seeds together; grains that are left are censored. Its limits
    take grains for independent, which those of one packing are not: they are the least.

    Parameters
    ----------
    seeds : list of DataFrame
        From `first_grains`, of each seed.

    Returns
    -------
    DataFrame
        radius_low_m, radius_high_m, solid_fraction, left, left_low, left_high (95 %).

    References
    ----------
    Kaplan and Meier (1958), J. Am. Stat. Assoc. 53, 457; Greenwood (1926).
    """
    every = pd.concat(seeds, ignore_index=True)
    parts = []
    edges = _thirds(every["radius_m"])
    for low, high in itertools.pairwise(edges):
        of = every[every["radius_m"].between(low, high, "left")]
        if not len(of):
            continue
        gone = of["survived"].to_numpy(dtype=bool)
        # Seeds reach equal solid fractions up to rounding.
        phi = of["solid_fraction"].round(9).to_numpy()
        curve = ecdf(CensoredData(uncensored=phi[~gone], right=phi[gone])).sf
        with np.errstate(invalid="ignore", divide="ignore"), warnings.catch_warnings():
            # Where all or none are left, scipy warns that there are no limits; they are nan.
            warnings.simplefilter("ignore", RuntimeWarning)
            limits = curve.confidence_interval(method="log-log")
        parts.append(
            pd.DataFrame(
                {
                    "radius_low_m": low,
                    "radius_high_m": high,
                    "solid_fraction": curve.quantiles,
                    "left": curve.probabilities,
                    "left_low": limits.low.probabilities,
                    "left_high": limits.high.probabilities,
                }
            )
        )
    return pd.concat(parts, ignore_index=True)


def _thirds(radii: pd.Series) -> np.ndarray:
    edges = np.quantile(radii, np.linspace(0.0, 1.0, 4))
    edges[-1] = np.nextafter(edges[-1], np.inf)
    return np.unique(edges)
