"""The network of contact forces: how broad it is, how its tail falls, and what carries it."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.errors import FitError
from branchcrush.packings.network import Network
from branchcrush.statistics.bins import binned_sums
from branchcrush.statistics.intervals import Interval
from branchcrush.statistics.power_law import binned_exponent
from branchcrush.statistics.resampling import pooled_interval

# Narrow enough to show the peak below the mean force.
_BIN = 0.25
# Beyond so many mean forces, where hardly a packing has a contact, all are in one bin.
_LAST = 100.0
# Where tails begin, in mean forces.
THRESHOLDS = (1.0, 2.0, 3.0)


def relative_forces(force: ArrayLike) -> NDArray:
    r"""Return the forces over their mean, F/<F>.

    Parameters
    ----------
    force : array_like, shape (M,)
        Of one packing in one state [N].

    Returns
    -------
    ndarray, shape (M,)
        [-]

    Examples
    --------
    >>> relative_forces([1.0, 3.0]).tolist()
    [0.5, 1.5]
    """
    forces = np.asarray(force, dtype=float)
    return forces / forces.mean() if forces.size else forces


def force_distribution(
    forces: Sequence[ArrayLike],
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> dict[str, NDArray]:
    r"""Return the distribution of relative forces, P(F/<F>), with intervals.

    Parameters
    ----------
    forces : list of array_like
        Relative forces of each seed [-].
    confidence, resamples, rng
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    dict of ndarray
        force_low and force_high over the mean force, contacts, density with _low and _high, in
        equal bins up to the one of the largest force; all beyond a hundred mean forces are in one.

    Examples
    --------
    >>> table = force_distribution([[0.1, 1.9], [0.2, 1.8]], rng=np.random.default_rng(1))
    >>> table["density"][:2].tolist(), int(table["contacts"].sum())
    ([2.0, 0.0], 4)
    """
    largest = max((float(np.max(force, initial=0.0)) for force in forces), default=0.0)
    edges = np.arange(0.0, min(largest, _LAST) + _BIN, _BIN)
    if largest > edges[-1]:
        edges = np.append(edges, max(largest, edges[-1] + _BIN))
    counts = np.array([np.histogram(force, edges)[0] for force in forces])

    def density(totals: NDArray) -> NDArray:
        number = np.maximum(totals.sum(axis=1, keepdims=True), 1.0)
        return totals / number / np.diff(edges)

    limits = pooled_interval(counts, density, confidence=confidence, resamples=resamples, rng=rng)
    return {
        "force_low": edges[:-1],
        "force_high": edges[1:],
        "contacts": counts.sum(axis=0),
        **limits.named("density"),
    }


def share_below_mean(
    forces: Sequence[ArrayLike],
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> Interval:
    r"""Return the share of the contacts with less than the mean force.

    Parameters
    ----------
    forces : list of array_like
        Relative forces of each seed [-].
    confidence, resamples, rng
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    Interval
        [-]; 1 - 1/e for exponential forces, 1/2 for forces as much above the mean as below.

    Examples
    --------
    >>> share_below_mean([[0.5, 0.5, 2.0]], rng=None).estimate
    0.6666666666666666
    """
    sums = np.array([(np.sum(np.asarray(force) < 1.0), np.size(force)) for force in forces])
    return pooled_interval(
        sums,
        lambda totals: totals[:, 0] / np.maximum(totals[:, 1], 1.0),
        confidence=confidence,
        resamples=resamples,
        rng=rng,
    )


def force_tail(
    forces: Sequence[ArrayLike],
    threshold: float,
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> dict[str, float]:
    r"""Return how the distribution of relative forces falls above a threshold.

    .. math:: \beta = \frac{1}{\langle f - t \rangle_{f > t}}, \qquad
        v = \frac{\mathrm{var}(f - t)_{f > t}}{\langle f - t \rangle_{f > t}^2}

    For an exponential tail, P ~ exp(-beta f), beta is its rate whatever the threshold and v is 1.
    A tail that bends down, as a Gaussian's, has v < 1, and beta grows with the threshold.

    Parameters
    ----------
    forces : list of array_like
        Relative forces of each seed [-].
    threshold : float
        t [-].
    confidence, resamples, rng
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    dict
        threshold; share_above, of the contacts, decay_rate beta and squared_variation v, each with
        _low and _high [-]; nan where fewer than two forces are above.

    Examples
    --------
    >>> exponential = -np.log(1.0 - (np.arange(100_000) + 0.5) / 100_000)
    >>> tail = force_tail([exponential], 2.0, rng=None)
    >>> round(tail["decay_rate"], 2), round(tail["squared_variation"], 2)
    (1.0, 1.0)
    """
    excess = [np.asarray(force)[np.asarray(force) > threshold] - threshold for force in forces]
    sums = np.array(
        [
            (above.size, above.sum(), above @ above, np.size(force))
            for above, force in zip(excess, forces, strict=True)
        ]
    )

    def tail(totals: NDArray) -> NDArray:
        number, first, second, contacts = totals.T
        with np.errstate(invalid="ignore", divide="ignore"):
            mean = first / number
            parts = number / contacts, 1.0 / mean, second / number / mean**2 - 1.0
        return np.where(number[:, None] > 1, np.stack(parts, axis=1), np.nan)

    limits = pooled_interval(sums, tail, confidence=confidence, resamples=resamples, rng=rng)
    return {
        "threshold": threshold,
        **limits.part(0).named("share_above"),
        **limits.part(1).named("decay_rate"),
        **limits.part(2).named("squared_variation"),
    }


def force_by_length(
    networks: Sequence[Network],
    edges: ArrayLike,
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> tuple[dict[str, NDArray], Interval | None]:
    r"""Return the mean relative force in bins of branch length, and its exponent.

    .. math:: \langle F \rangle(l) \sim l^m

    Parameters
    ----------
    networks : list of Network
        One a seed.
    edges : array_like, shape (n+1,)
        Bin edges [m].
    confidence, resamples, rng
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    table : dict of ndarray
        branch_length_low_m, branch_length_high_m, branches, mean_force with _low and _high, over
        the mean of all.
    exponent : Interval or None
        None where the lengths bear no power law.
    """
    options: dict[str, Any] = {"confidence": confidence, "resamples": resamples, "rng": rng}
    ends = np.asarray(edges, dtype=float)
    sums = np.array(
        [binned_sums(seed.length, relative_forces(seed.force), ends) for seed in networks]
    )

    def means(totals: NDArray) -> NDArray:
        with np.errstate(invalid="ignore", divide="ignore"):
            mean = totals[:, 2].sum(axis=1) / totals[:, 0].sum(axis=1)
            return totals[:, 2] / totals[:, 0] / mean[:, None]

    limits = pooled_interval(sums, means, **options)
    exponent: Interval | None
    try:
        exponent = binned_exponent(sums, **options)[1]
    except FitError:
        exponent = None
    return {
        "branch_length_low_m": ends[:-1],
        "branch_length_high_m": ends[1:],
        "branches": sums[:, 0].sum(axis=0).astype(int),
        **limits.named("mean_force"),
    }, exponent


def force_network_result(
    networks: Sequence[Network],
    edges: ArrayLike,
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> tuple[dict[str, dict[str, NDArray]], dict[str, Any]]:
    r"""Return all that this module tells of the forces of a sample in one state.

    Parameters
    ----------
    networks : list of Network
        One a seed.
    edges : array_like, shape (n+1,)
        Bins of branch length [m].
    confidence, resamples, rng
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    tables : dict of dict of ndarray
        force_distribution and force_by_length.
    summary : dict
        share_below_mean with _low and _high; tails, one a threshold, as `force_tail`; by_length,
        the exponent with _low and _high, empty where the lengths bear no power law.
    """
    options: dict[str, Any] = {"confidence": confidence, "resamples": resamples, "rng": rng}
    forces = [relative_forces(network.force) for network in networks]
    by_length, exponent = force_by_length(networks, edges, **options)
    below = share_below_mean(forces, **options)
    tables = {
        "force_distribution": force_distribution(forces, **options),
        "force_by_length": by_length,
    }
    return tables, {
        **below.named("share_below_mean"),
        "tails": [force_tail(forces, threshold, **options) for threshold in THRESHOLDS],
        "by_length": {} if exponent is None else exponent.named("exponent"),
    }
