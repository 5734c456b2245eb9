"""How the stress of a packing is shared among grains of different radius."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.packings.geometry import sphere_volume
from branchcrush.packings.grains import grain_stress_volume
from branchcrush.packings.network import Network
from branchcrush.statistics.bins import bin_numbers
from branchcrush.statistics.resampling import pooled_interval

_POINTS = 100


def stress_by_radius(
    networks: Sequence[Network],
    edges: ArrayLike,
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> dict[str, NDArray]:
    r"""Return the mean stress of the grains of each class of radius over that of all.

    .. math:: \frac{\sum_{g \in k} p_g V_g / \sum_{g \in k} V_g}{\sum_g p_g V_g / \sum_g V_g}

    Parameters
    ----------
    networks : list of Network
        One a seed.
    edges : array_like, shape (K+1,)
        Classes of radius [m].
    confidence, resamples, rng
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    dict of ndarray, shape (K,)
        radius_low_m, radius_high_m, mean_radius_m, grains; stress_ratio with _low and _high, and
        load_bearing_stress_ratio, of the grains that are no rattlers.
    """
    ends = np.asarray(edges, dtype=float)
    sums = [_class_sums(network, ends) for network in networks]
    grains, radii = np.sum([seed[:2] for seed in sums], axis=0)

    def ratios(totals: NDArray) -> NDArray:
        stress, volume, held_stress, held_volume = np.moveaxis(totals, 1, 0)
        mean = stress.sum(axis=1) / volume.sum(axis=1)
        with np.errstate(invalid="ignore", divide="ignore"):
            of_classes = np.stack([stress / volume, held_stress / held_volume], axis=1)
        return of_classes / mean[:, None, None]

    limits = pooled_interval(
        [seed[2:] for seed in sums], ratios, confidence=confidence, resamples=resamples, rng=rng
    )
    with np.errstate(invalid="ignore"):
        mean_radius = radii / grains
    table = {
        "radius_low_m": ends[:-1],
        "radius_high_m": ends[1:],
        "mean_radius_m": mean_radius,
        "grains": grains.astype(int),
    }
    for row, name in enumerate(("stress_ratio", "load_bearing_stress_ratio")):
        table |= limits.part(row).named(name)
    return table


def _class_sums(network: Network, edges: NDArray) -> NDArray:
    """Return what one seed has in each class of radius, shape (6, K).

    Grains, and the sums of their radii, of stress times volume and of volume; the last two again of
    the grains that are no rattlers.
    """
    group = bin_numbers(network.radius, edges)
    stress, volume = grain_stress_volume(network), sphere_volume(network.radius)
    bearing = network.bearing
    parts = (None, network.radius, stress, volume, bearing * stress, bearing * volume)
    return np.array([np.bincount(group, part, edges.size - 1) for part in parts], dtype=float)


def cumulative_sharing(
    radius: ArrayLike, stress_volume: ArrayLike, volume_share: ArrayLike
) -> NDArray:
    r"""Return the share of the stress that the finest grains with a share of the volume carry.

    .. math:: S(x) = \frac{\sum_{g:\, \text{finest}} p_g V_g}{\sum_g p_g V_g}, \qquad
        x = \frac{\sum_{g:\, \text{finest}} V_g}{\sum_g V_g}

    Parameters
    ----------
    radius, stress_volume : array_like, shape (N,)
        [m], and mean stress times volume of each grain [J].
    volume_share : array_like, shape (n,)
        x, from 0 to 1 [-].

    Returns
    -------
    ndarray, shape (n,)
        [-]; x itself when all grains have the same mean stress.

    Examples
    --------
    >>> cumulative_sharing([2.0, 1.0, 1.0], [8.0, 0.0, 2.0], [0.0, 0.2, 1.0]).tolist()
    [0.0, 0.2, 1.0]
    """
    radii, group = np.unique(radius, return_inverse=True)
    # Grains of one radius come together, in whatever order they are.
    volume = np.bincount(group) * radii**3
    stress = np.bincount(group, stress_volume)
    at = np.append(0.0, np.cumsum(volume)) / volume.sum()
    carried = np.append(0.0, np.cumsum(stress)) / stress.sum()
    return np.interp(np.asarray(volume_share), at, carried)


def stress_sharing(
    networks: Sequence[Network],
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> tuple[dict[str, NDArray], dict[str, float]]:
    r"""Return the cumulative stress against the cumulative volume, from the finest grains on.

    .. math:: I = 2 \int_0^1 (x - S(x))\, dx

    I is 0 when all grains have the same mean stress, more when the coarse ones have more, and less
    than 0 when the fine ones do.

    Parameters
    ----------
    networks : list of Network
        One a seed.
    confidence, resamples, rng
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    table : dict of ndarray
        volume_share and stress_share, the mean of the seeds, with _low and _high.
    summary : dict
        coarse_half_stress_share, carried by the coarser half of the solid volume, and
        sharing_index I, each with _low and _high.
    """
    shares = np.linspace(0.0, 1.0, _POINTS + 1)
    curves = np.array(
        [cumulative_sharing(seed.radius, grain_stress_volume(seed), shares) for seed in networks]
    )
    index = 2.0 * np.trapezoid(shares - curves, shares, axis=1)
    numbers = np.column_stack([curves, 1.0 - curves[:, _POINTS // 2], index])
    # With a count of one in front, the mean of the seeds drawn is a ratio of sums.
    sums = np.column_stack([np.ones(len(networks)), numbers])
    limits = pooled_interval(
        sums,
        lambda totals: totals[:, 1:] / totals[:, :1],
        confidence=confidence,
        resamples=resamples,
        rng=rng,
    )
    table = {"volume_share": shares, **limits.part(slice(-2)).named("stress_share")}
    return table, {
        **limits.part(-2).named("coarse_half_stress_share"),
        **limits.part(-1).named("sharing_index"),
    }


def stress_sharing_result(
    networks: Sequence[Network],
    classes: ArrayLike,
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> tuple[dict[str, dict[str, NDArray]], dict[str, float]]:
    r"""Return all that this module tells of the stress of a sample in one state.

    Parameters
    ----------
    networks : list of Network
        One a seed.
    classes : array_like, shape (K+1,)
        Classes of radius [m].
    confidence, resamples, rng
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    tables : dict of dict of ndarray
        stress_by_radius and stress_sharing.
    summary : dict
        As of `stress_sharing`.
    """
    options: dict[str, Any] = {"confidence": confidence, "resamples": resamples, "rng": rng}
    by_radius = stress_by_radius(networks, classes, **options)
    table, summary = stress_sharing(networks, **options)
    return {"stress_by_radius": by_radius, "stress_sharing": table}, summary
