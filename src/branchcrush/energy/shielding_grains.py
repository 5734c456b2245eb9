"""Shielding by grain: the energy of grains against their radius over that of their neighbours."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from branchcrush.energy.shielding import LARGER, ROUNDING, claim_answer
from branchcrush.packings.geometry import sphere_volume
from branchcrush.packings.grains import grain_energy, neighbour_ratio
from branchcrush.packings.network import Network
from branchcrush.statistics.bins import bin_numbers
from branchcrush.statistics.intervals import Interval
from branchcrush.statistics.resampling import pooled_interval

# Edges of a grain's radius over that of its neighbours.
_NEIGHBOUR_RATIOS = np.array([0.0, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.25, 1.6, 2.5, 5.0, 10.0, np.inf])
_BINS = _NEIGHBOUR_RATIOS.size - 1
# So few grains tell nothing: then those of the largest ratios there are.
_FEWEST = 10
# What the energies are divided by, in the order of `_energy_ratios`.
_READINGS = ("contact", "grain", "volume")


def grain_shielding(
    networks: Sequence[Network],
    contact_exponent: float,
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> tuple[dict[str, NDArray], dict[str, float | str]]:
    r"""Return the energy of grains against their radius over that of their neighbours.

    .. math:: x = R/\langle R \rangle_{\text{neighbours}}: \quad
        \frac{\langle e \rangle_x}{\langle e \rangle}, \quad
        \frac{\sum_x e / \sum_x V}{\sum e / \sum V}, \quad
        \frac{\sum_x e / \sum_x z}{\sum e / \sum z}

    Per grain, per unit of solid volume and per contact (walls' included), over those of all
    grains. The claim is one of contacts: per volume a grain that carries the same stress as its
    finer neighbours has fewer contacts, on its surface, and 1/x of their energy without any
    shielding. Grains that touch none have no x, and count in the means of all.

    Parameters
    ----------
    networks : list of Network
        One a seed.
    contact_exponent : float
        1 for linear contacts, 3/2 for Hertz.
    confidence, resamples, rng
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    table : dict of ndarray
        grains_counted (all, or load-bearing), neighbour_ratio_low, neighbour_ratio_high,
        mean_neighbour_ratio, grains; energy_per_grain, energy_per_volume and energy_per_contact
        over the mean of all, with _low and _high.
    summary : dict
        largest_neighbour_ratio; grains_ten_times_larger, the number from 10 on; of the grains
        from `neighbour_ratio_from` on (the highest edge that ten grains reach) `grains`, and for
        each reading energy_per_<reading> with _low and _high and claim_per_<reading>, as
        `shielding.claim_answer`: no such grain when no ratio reaches 10, undecided with fewer than
        ten that do.
    """
    options: dict[str, Any] = {"confidence": confidence, "resamples": resamples, "rng": rng}
    ratios = [neighbour_ratio(network) for network in networks]
    sums = np.array(
        [
            _seed_sums(network, ratio, grain_energy(network, contact_exponent))
            for network, ratio in zip(networks, ratios, strict=True)
        ]
    )
    energies = pooled_interval(sums, _energy_ratios, **options)
    counts, ratio_sums = (sums[:, :, row].sum(axis=0)[:, :-1] for row in (0, 1))
    with np.errstate(invalid="ignore"):
        mean_ratio = ratio_sums / counts
    table = {
        "grains_counted": np.repeat(["all", "load-bearing"], _BINS),
        "neighbour_ratio_low": np.tile(_NEIGHBOUR_RATIOS[:-1], 2),
        "neighbour_ratio_high": np.tile(_NEIGHBOUR_RATIOS[1:], 2),
        "mean_neighbour_ratio": mean_ratio.ravel(),
        "grains": counts.astype(int).ravel(),
    }
    for number, reading in enumerate(_READINGS):
        interval = energies.part(number)
        table |= Interval(*map(np.ravel, interval)).named(f"energy_per_{reading}")
    largest = max((ratio[np.isfinite(ratio)].max(initial=0.0) for ratio in ratios), default=0.0)
    return table, {"largest_neighbour_ratio": float(largest), **_claim(sums[:, 0], options)}


def _seed_sums(network: Network, ratio: NDArray, energy: NDArray) -> NDArray:
    """Return what one seed has in each bin of the ratio, shape (2, 5, bins + 1).

    Of all grains and of those that carry load: grains, and the sums of their ratios, energies,
    volumes and contacts. In the last column are the sums over all grains, which touch or not.
    """
    touching = np.isfinite(ratio)
    group = bin_numbers(ratio[touching], _NEIGHBOUR_RATIOS * (1.0 - ROUNDING))
    parts = (
        np.ones(energy.size),
        np.where(touching, ratio, 0.0),
        energy,
        sphere_volume(network.radius),
        (network.contacts + network.wall_contacts).astype(float),
    )
    sums = np.empty((2, len(parts), _BINS + 1))
    for row, kept in enumerate((np.ones(energy.size, dtype=bool), network.bearing)):
        weight = kept[touching].astype(float)
        for number, part in enumerate(parts):
            sums[row, number, :-1] = np.bincount(group, weight * part[touching], _BINS)
            sums[row, number, -1] = part.sum()
    return sums


def _energy_ratios(totals: NDArray) -> NDArray:
    """Return energies per contact, grain and volume over those of all grains, for each draw.

    Totals are as `_seed_sums`, shape (draws, ..., 5, n + 1); returned are (draws, 3, ..., n).
    """
    number, _, energy, volume, contacts = np.moveaxis(totals, -2, 0)
    with np.errstate(invalid="ignore", divide="ignore"):
        readings = np.stack([energy / contacts, energy / number, energy / volume], axis=1)
        return readings[..., :-1] / readings[..., -1:]


def _claim(sums: NDArray, options: dict[str, Any]) -> dict[str, float | str]:
    """Answer the claim from the sums of all grains, shape (S, 5, bins + 1)."""
    counts = sums[:, 0, :-1].sum(axis=0)
    held = np.cumsum(counts[::-1])[::-1]
    enough = np.flatnonzero(held >= _FEWEST)
    first = int(enough[-1]) if enough.size else 0
    reaching = int(held[np.searchsorted(_NEIGHBOUR_RATIOS, LARGER)])
    both = np.stack([sums[:, :, first:-1].sum(axis=2), sums[:, :, -1]], axis=2)
    limits = pooled_interval(both, _energy_ratios, **options)
    summary: dict[str, float | str] = {
        "grains_ten_times_larger": reaching,
        "neighbour_ratio_from": float(_NEIGHBOUR_RATIOS[first]),
        "grains": int(held[first]),
    }
    for number, reading in enumerate(_READINGS):
        interval = limits.part((number, 0))
        summary |= interval.named(f"energy_per_{reading}")
        summary[f"claim_per_{reading}"] = claim_answer(interval, reaching, _FEWEST, "grain")
    return summary
