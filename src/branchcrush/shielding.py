"""Shielding, measured: whether the energy vanishes where a grain is far larger than its neighbours.

The paper says so of a grain more than ten times as large; energy split functions of branch length
cannot say it. Here it is counted, by branch and by grain.
"""

import numpy as np

from branchcrush.energy_predictors import PREDICTORS, branch_columns, log_length
from branchcrush.gamma_regression import gamma_fit, parameter_intervals
from branchcrush.grains import grain_energy, neighbour_ratio, solid_volume
from branchcrush.intervals import pooled_interval

# Edges of r_min/r_max, and of a grain's radius over that of its neighbours.
_RADIUS_RATIOS = np.array([0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0])
_NEIGHBOUR_RATIOS = np.array([0.0, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.25, 1.6, 2.5, 5.0, 10.0, np.inf])
# The claim: an order of magnitude larger, and the energy vanishes: an order of magnitude less.
LARGER = 10.0
VANISHED = 0.1
# So few grains tell nothing: then those of the largest ratios there are.
_FEWEST = 10
_READINGS = ("contact", "grain", "volume")


def branch_shielding(seeds, *, confidence=0.95, resamples=2000, rng):
    r"""Return the mean energy of branches of equal length against the ratio of their radii.

    .. math:: \frac{\langle E \rangle_q}{\langle A\, l^n \rangle_q}, \qquad
        \langle E \rangle \sim l^n \left(\frac{r_{min}}{r_{max}}\right)^s

    The ratio is that to what branches of the same lengths hold on average, with A and n fitted to
    all branches. s is 0 without shielding; energies vanish for unequal grains when it is large.

    Parameters
    ----------
    seeds : list of tuple
        From `energy_predictors.branch_columns`, of each seed.
    confidence, resamples, rng
        As for `intervals.pooled_interval`.

    Returns
    -------
    table : dict of ndarray
        radius_ratio_low, radius_ratio_high, mean_radius_ratio, branches, energy_ratio with _low
        and _high.
    summary : dict
        shielding_exponent s and length_exponent n of the fit of both, with _low and _high.

    Raises
    ------
    FitError
        As `gamma_regression.gamma_fit`.
    """
    options = {"confidence": confidence, "resamples": resamples, "rng": rng}
    law = PREDICTORS["branch_length"].design
    fitted = gamma_fit(seeds, law).parameters
    bins, sums = _RADIUS_RATIOS.size - 1, []
    for small, large, energy in seeds:
        ratio = np.exp(small - large)
        group = np.clip(np.searchsorted(_RADIUS_RATIOS, ratio, side="right") - 1, 0, bins - 1)
        mean = np.exp(law(fitted, small, large)[0])
        parts = (None, ratio, energy, mean)
        sums.append([np.bincount(group, part, bins) for part in parts])
    sums = np.array(sums, dtype=float)

    def ratios(totals):
        with np.errstate(invalid="ignore", divide="ignore"):
            # The draw's own scale: what is said is how branches of one draw compare.
            scale = totals[:, 2].sum(axis=1) / totals[:, 3].sum(axis=1)
            return totals[:, 2] / totals[:, 3] / scale[:, None]

    found = pooled_interval(sums, ratios, **options)
    both = gamma_fit(seeds, _length_and_ratio)
    limits = parameter_intervals(both, **options)
    count, ratio = sums[:, :2].sum(axis=0)
    with np.errstate(invalid="ignore"):
        mean_ratio = ratio / count
    table = {
        "radius_ratio_low": _RADIUS_RATIOS[:-1],
        "radius_ratio_high": _RADIUS_RATIOS[1:],
        "mean_radius_ratio": mean_ratio,
        "branches": count.astype(int),
        **dict(zip(("energy_ratio", "energy_ratio_low", "energy_ratio_high"), found, strict=True)),
    }
    summary = {
        name + part: float(values[k])
        for part, values in zip(("", "_low", "_high"), limits, strict=True)
        for k, name in ((1, "length_exponent"), (2, "shielding_exponent"))
    }
    return table, summary


def _length_and_ratio(theta, small=None, large=None):
    if theta is None:
        return [0.0, 3.0, 0.0]
    slope = np.stack([np.ones_like(small), log_length(small, large), small - large], axis=1)
    return slope @ theta, slope


def grain_shielding(networks, contact_exponent, *, confidence=0.95, resamples=2000, rng):
    r"""Return the energy of grains against their radius over that of their neighbours.

    .. math:: x = R/\langle R \rangle_{\text{neighbours}}: \quad
        \frac{\langle e \rangle_x}{\langle e \rangle}, \quad
        \frac{\sum_x e / \sum_x V}{\sum e / \sum V}, \quad
        \frac{\sum_x e / \sum_x z}{\sum e / \sum z}

    Per grain, per unit of solid volume and per contact (walls' included), over those of all
    grains. Grains that touch none have no x, and count in the means of all.

    Parameters
    ----------
    networks : list of networks.Network
        One a seed.
    contact_exponent : float
        1 for linear contacts, 3/2 for Hertz.
    confidence, resamples, rng
        As for `intervals.pooled_interval`.

    Returns
    -------
    table : dict of ndarray
        grains_counted (all, or load-bearing), neighbour_ratio_low, neighbour_ratio_high,
        mean_neighbour_ratio, grains; energy_per_grain, energy_per_volume and energy_per_contact
        over the mean of all, with _low and _high.
    summary : dict
        largest_neighbour_ratio; of the grains from `neighbour_ratio_from` on, `grains`, and for
        each reading energy_per_<reading> with _low and _high and claim_per_<reading>: supported
        when all of the interval is below 0.1, contradicted when all of it is above, undecided
        between, and no such grain when no ratio reaches 10.
    """
    options = {"confidence": confidence, "resamples": resamples}
    bins, sums, largest = _NEIGHBOUR_RATIOS.size - 1, [], 0.0
    for network in networks:
        energy, ratio = grain_energy(network, contact_exponent), neighbour_ratio(network)
        parts = (
            np.ones(energy.size),
            ratio,
            energy,
            solid_volume(network.radius),
            (network.contacts + network.wall_contacts).astype(float),
        )
        touching = np.isfinite(ratio)
        group = np.searchsorted(_NEIGHBOUR_RATIOS, ratio[touching], side="right") - 1
        largest = max(largest, ratio[touching].max(initial=0.0))
        seed = []
        for kept in (np.ones(energy.size, dtype=bool), ~network.rattlers):
            weight = kept[touching].astype(float)
            seed.append([np.bincount(group, weight * p[touching], bins) for p in parts])
        whole = np.array([0.0 if p is ratio else p.sum() for p in parts])
        # The last column holds the sums of all grains.
        sums.append(np.concatenate([seed, np.stack([whole, whole])[:, :, None]], axis=2))
    sums = np.array(sums)

    def ratios(totals):
        number, _, energy, volume, contacts = np.moveaxis(totals, 2, 0)
        with np.errstate(invalid="ignore", divide="ignore"):
            found = np.stack([energy / contacts, energy / number, energy / volume], axis=1)
            return found[..., :-1] / found[:, :, :1, -1:]

    found = pooled_interval(sums, ratios, **options, rng=rng)
    counts, ratio = sums[:, :, 0].sum(axis=0)[:, :-1], sums[:, :, 1].sum(axis=0)[:, :-1]
    with np.errstate(invalid="ignore"):
        mean_ratio = ratio / counts
    table = {
        "grains_counted": np.repeat(["all", "load-bearing"], bins),
        "neighbour_ratio_low": np.tile(_NEIGHBOUR_RATIOS[:-1], 2),
        "neighbour_ratio_high": np.tile(_NEIGHBOUR_RATIOS[1:], 2),
        "mean_neighbour_ratio": mean_ratio.ravel(),
        "grains": counts.astype(int).ravel(),
    }
    for k, reading in enumerate(_READINGS):
        for part, values in zip(("", "_low", "_high"), found, strict=True):
            table[f"energy_per_{reading}{part}"] = values[k].ravel()
    return table, _claim(sums[:, 0], largest, {**options, "rng": rng})


def _claim(sums, largest, options):
    """Answer the claim from the sums of all grains, shape (S, 5, bins + 1)."""
    counts = sums[:, 0, :-1].sum(axis=0)
    held = np.cumsum(counts[::-1])[::-1]
    enough = np.flatnonzero(held >= _FEWEST)
    first = min(enough[-1] if enough.size else 0, _NEIGHBOUR_RATIOS.size - 2)
    both = np.stack([sums[:, :, first:-1].sum(axis=2), sums[:, :, -1]], axis=2)

    def ratios(totals):
        number, _, energy, volume, contacts = np.moveaxis(totals, 1, 0)
        with np.errstate(invalid="ignore", divide="ignore"):
            found = np.stack([energy / contacts, energy / number, energy / volume], axis=1)
            return found[..., 0] / found[..., 1]

    limits = pooled_interval(both, ratios, **options)
    summary = {
        "largest_neighbour_ratio": float(largest),
        "neighbour_ratio_from": float(_NEIGHBOUR_RATIOS[first]),
        "grains": int(held[first]),
    }
    for k, reading in enumerate(_READINGS):
        estimate, low, high = (float(values[k]) for values in limits)
        name = f"energy_per_{reading}"
        summary |= {name: estimate, f"{name}_low": low, f"{name}_high": high}
        if _NEIGHBOUR_RATIOS[first] < LARGER:
            claim = "no such grain"
        elif high < VANISHED:
            claim = "supported"
        else:
            claim = "contradicted" if low > VANISHED else "undecided"
        summary[f"claim_per_{reading}"] = claim
    return summary


def network_branches(network, radius_max):
    """Return the branches of a network as `branch_shielding` takes them, of one seed."""
    return branch_columns(network.radius_i, network.radius_j, network.energy, radius_max)
