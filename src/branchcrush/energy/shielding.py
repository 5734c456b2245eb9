"""Shielding, measured: whether the energy vanishes where a grain is far larger than its neighbours.

The paper says so of a grain more than ten times as large; energy split functions of branch length
cannot say it. Here it is counted, by branch and by grain.
"""

import numpy as np

from branchcrush.energy.predictors import branch_columns, log_length
from branchcrush.packings.geometry import sphere_volume
from branchcrush.packings.grains import grain_energy, neighbour_ratio
from branchcrush.statistics.bins import bin_numbers
from branchcrush.statistics.gamma_regression import gamma_fit, parameter_intervals
from branchcrush.statistics.intervals import Interval, pooled_interval
from branchcrush.statistics.power_law import power_law_fit

# Edges of r_min/r_max, and of a grain's radius over that of its neighbours.
_RADIUS_RATIOS = np.array([0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0])
_NEIGHBOUR_RATIOS = np.array([0.0, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.25, 1.6, 2.5, 5.0, 10.0, np.inf])
# The claim: an order of magnitude larger, and the energy vanishes: an order of magnitude less.
LARGER = 10.0
VANISHED = 0.1
# So few grains tell nothing: then those of the largest ratios there are.
_FEWEST = 10
# Energies of single branches scatter more than those of grains: ten at random, of the scatter that
# is measured, give intervals of 95 % that cover 80 %, thirty give 90 %.
_FEWEST_BRANCHES = 30
# Radii of 0.1 and 1 have a ratio of 10 but for rounding: what is on an edge counts as beyond it.
_ROUNDING = 1e-9
# Bins of branch length in which the power law of equal lengths is fitted.
_LENGTHS = 60
_READINGS = ("contact", "grain", "volume")


def branch_shielding(seeds, *, confidence=0.95, resamples=2000, rng):
    r"""Return the mean energy of branches of equal length against the ratio of their radii.

    .. math:: \frac{\langle E \rangle_q}{\langle A\, l^n \rangle_q}, \qquad
        \langle E \rangle \sim l^n \left(\frac{r_{min}}{r_{max}}\right)^s

    The ratio is that to what branches of the same lengths hold on average, with A and n fitted to
    all branches, and fitted anew in every draw. s is 0 without shielding; energies vanish for
    unequal grains when it is large.

    Parameters
    ----------
    seeds : list of tuple
        From `energy.predictors.branch_columns`, of each seed.
    confidence, resamples, rng
        As for `statistics.intervals.pooled_interval`.

    Returns
    -------
    table : dict of ndarray
        radius_ratio_low, radius_ratio_high (a ratio on an edge is in the bin below), the
        mean_radius_ratio, branches, energy_ratio with _low and _high.
    summary : dict
        shielding_exponent s and length_exponent n of the fit of both, with _low and _high; of the
        branches up to `radius_ratio_to`, `unequal_branches` and unequal_over_equal, their ratio
        over that of the last bin, with _low and _high; and claim: no such branch up to a ratio of
        0.1, undecided with fewer than thirty of them, and else as for `grain_shielding`.

    Raises
    ------
    FitError
        As `statistics.gamma_regression.gamma_fit`, and as `energy.split.power_law_fit` of any draw.
    """
    options = {"confidence": confidence, "resamples": resamples, "rng": rng}
    logs = [log_length(small, large) for small, large, _ in seeds]
    both = gamma_fit(seeds, _length_and_ratio)
    # One seed may have no branch that carries energy, all together have: they were fitted.
    whole = np.concatenate(logs)
    first, last = whole.min(), whole.max()
    lengths = np.linspace(first, max(last, first + 1e-6), _LENGTHS + 1)
    bins, sums = _RADIUS_RATIOS.size - 1, []
    for (small, large, energy), log in zip(seeds, logs, strict=True):
        ratio = np.exp(small - large)
        group = np.searchsorted(_RADIUS_RATIOS * (1.0 + _ROUNDING), ratio, side="left") - 1
        place = bin_numbers(log, lengths)
        cell = place * bins + np.clip(group, 0, bins - 1)
        parts = (None, np.exp(log), ratio, energy)
        sums.append([np.bincount(cell, part, bins * _LENGTHS) for part in parts])
    sums = np.array(sums, dtype=float).reshape(len(seeds), 4, _LENGTHS, bins)
    count, length, ratio, _ = sums.sum(axis=0)
    filled = count.sum(axis=1) > 0
    length = length.sum(axis=1)[filled] / count.sum(axis=1)[filled]
    unequal = np.cumsum(count.sum(axis=0))
    tenth = int(np.searchsorted(_RADIUS_RATIOS, 1.0 / LARGER))  # bins up to the claim's ratio
    to = min(max(tenth, int(np.searchsorted(unequal, _FEWEST_BRANCHES)) + 1), bins)

    def ratios(totals):
        number, energy = totals[:, 0, filled], totals[:, 3, filled]
        weight = number.sum(axis=2)
        mean = energy.sum(axis=2) / np.maximum(weight, 1.0)
        law = power_law_fit(length, mean, weight)
        per_branch = law.amplitude[:, None] * length ** law.exponent[:, None]
        held, expected = energy.sum(axis=1), (number * per_branch[..., None]).sum(axis=1)
        # The draw's own scale: what is said is how branches of one draw compare.
        scale = held.sum(axis=1) / expected.sum(axis=1)
        with np.errstate(invalid="ignore", divide="ignore"):
            by_bin = held / expected / scale[:, None]
            few = held[:, :to].sum(axis=1) / expected[:, :to].sum(axis=1) / scale
            return np.concatenate([by_bin, (few / by_bin[:, -1])[:, None]], axis=1)

    found = pooled_interval(sums, ratios, **options)
    limits = parameter_intervals(both, **options)
    count, ratio = count.sum(axis=0), ratio.sum(axis=0)
    with np.errstate(invalid="ignore"):
        mean_ratio = ratio / count
    table = {
        "radius_ratio_low": _RADIUS_RATIOS[:-1],
        "radius_ratio_high": _RADIUS_RATIOS[1:],
        "mean_radius_ratio": mean_ratio,
        "branches": count.astype(int),
        **found.part(slice(-1)).named("energy_ratio"),
    }
    unequal_over_equal = found.part(-1)
    # Branches less unequal than the claim's are counted for what they hold, and do not answer it.
    as_claimed = unequal[tenth - 1]
    answer = _answer(unequal_over_equal) if as_claimed >= _FEWEST_BRANCHES else "undecided"
    return table, {
        **limits.part(1).named("length_exponent"),
        **limits.part(2).named("shielding_exponent"),
        "radius_ratio_to": float(_RADIUS_RATIOS[to]),
        "unequal_branches": int(unequal[to - 1]),
        **unequal_over_equal.named("unequal_over_equal"),
        "claim": answer if as_claimed else "no such branch",
    }


def _answer(interval):
    """Return what an interval says of the claim; without one, as with one seed, nothing."""
    if interval.high < VANISHED:
        return "supported"
    return "contradicted" if interval.low > VANISHED else "undecided"


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
    grains. The claim is one of contacts: per volume a grain that carries the same stress as its
    finer neighbours has fewer contacts, on its surface, and 1/x of their energy without any
    shielding. Grains that touch none have no x, and count in the means of all.

    Parameters
    ----------
    networks : list of networks.Network
        One a seed.
    contact_exponent : float
        1 for linear contacts, 3/2 for Hertz.
    confidence, resamples, rng
        As for `statistics.intervals.pooled_interval`.

    Returns
    -------
    table : dict of ndarray
        grains_counted (all, or load-bearing), neighbour_ratio_low, neighbour_ratio_high,
        mean_neighbour_ratio, grains; energy_per_grain, energy_per_volume and energy_per_contact
        over the mean of all, with _low and _high.
    summary : dict
        largest_neighbour_ratio; grains_ten_times_larger, the number from 10 on; of the grains
        from `neighbour_ratio_from` on (the highest edge that ten grains reach) `grains`, and for
        each reading energy_per_<reading> with _low and _high and claim_per_<reading>: supported
        when all of the interval is below 0.1, contradicted when all of it is above, undecided
        between or with fewer than ten such grains, and no such grain when no ratio reaches 10.
    """
    options = {"confidence": confidence, "resamples": resamples}
    bins, sums, largest = _NEIGHBOUR_RATIOS.size - 1, [], 0.0
    for network in networks:
        energy, ratio = grain_energy(network, contact_exponent), neighbour_ratio(network)
        parts = (
            np.ones(energy.size),
            ratio,
            energy,
            sphere_volume(network.radius),
            (network.contacts + network.wall_contacts).astype(float),
        )
        touching = np.isfinite(ratio)
        edges = _NEIGHBOUR_RATIOS * (1.0 - _ROUNDING)
        group = np.searchsorted(edges, ratio[touching], side="right") - 1
        largest = max(largest, ratio[touching].max(initial=0.0))
        seed = []
        for kept in (np.ones(energy.size, dtype=bool), network.bearing):
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
    for number, reading in enumerate(_READINGS):
        interval = Interval(*(values[number].ravel() for values in found))
        table |= interval.named(f"energy_per_{reading}")
    return table, _claim(sums[:, 0], largest, {**options, "rng": rng})


def _claim(sums, largest, options):
    """Answer the claim from the sums of all grains, shape (S, 5, bins + 1)."""
    counts = sums[:, 0, :-1].sum(axis=0)
    held = np.cumsum(counts[::-1])[::-1]
    enough = np.flatnonzero(held >= _FEWEST)
    first = int(enough[-1]) if enough.size else 0
    reaching = int(held[np.searchsorted(_NEIGHBOUR_RATIOS, LARGER)])
    both = np.stack([sums[:, :, first:-1].sum(axis=2), sums[:, :, -1]], axis=2)

    def ratios(totals):
        number, _, energy, volume, contacts = np.moveaxis(totals, 1, 0)
        with np.errstate(invalid="ignore", divide="ignore"):
            found = np.stack([energy / contacts, energy / number, energy / volume], axis=1)
            return found[..., 0] / found[..., 1]

    limits = pooled_interval(both, ratios, **options)
    summary = {
        "largest_neighbour_ratio": float(largest),
        "grains_ten_times_larger": reaching,
        "neighbour_ratio_from": float(_NEIGHBOUR_RATIOS[first]),
        "grains": int(held[first]),
    }
    for number, reading in enumerate(_READINGS):
        interval = limits.part(number)
        summary |= interval.named(f"energy_per_{reading}")
        answer = _answer(interval) if reaching >= _FEWEST else "undecided"
        summary[f"claim_per_{reading}"] = answer if reaching else "no such grain"
    return summary


def network_branches(network, radius_max):
    """Return the branches of a network as `branch_shielding` takes them, of one seed."""
    return branch_columns(network.radius_i, network.radius_j, network.energy, radius_max)
