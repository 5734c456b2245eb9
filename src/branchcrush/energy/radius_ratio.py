"""How the energy of a branch depends on the ratio of its radii, its length being taken out."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from branchcrush.energy.designs import log_equality, log_length
from branchcrush.energy.predictors import BranchColumns
from branchcrush.energy.shielding import ROUNDING
from branchcrush.energy.shielding_branches import RADIUS_RATIOS
from branchcrush.statistics.resampling import Resampling, pooled_interval


def radius_ratio_table(
    seeds: Sequence[BranchColumns],
    length_exponent: float,
    ratio_exponent: float,
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
) -> dict[str, NDArray]:
    r"""Return g of E = A l^q g(r_min/r_max) in bins of the ratio, measured and as it was fitted.

    .. math:: g_k = \frac{\sum_{b \in k} E_b}{A \sum_{b \in k} l_b^{\,q}}, \qquad
        g = \left(\frac{4 r_1 r_2}{l^2}\right)^t

    The measured one has no form: of it, only q is fitted. A is such that both are the same in the
    last bin that has branches, of the most equal radii, which so has no interval of its own.

    Parameters
    ----------
    seeds : list of tuple
        From `energy.predictors.branch_columns`, of each seed.
    length_exponent, ratio_exponent : float
        q and t of the predictor length_and_ratio [-].
    confidence : float
    resamples : int

    Returns
    -------
    dict of ndarray
        radius_ratio_low and _high (a ratio on an edge is in the bin below), mean_radius_ratio,
        branches, g with g_low and g_high, and g_fitted, mean of the bin; nan where there is no
        branch.

    Examples
    --------
    >>> small, large = np.log([0.5, 0.25]), np.log([0.5, 0.75])  # one length, two ratios
    >>> table = radius_ratio_table([(small, large, np.array([8.0, 4.0]))] * 2, 3.0, 2.0)
    >>> table["g"][[4, -1]].round(9).tolist(), table["g_fitted"][[4, -1]].round(9).tolist()
    ([0.5, 1.0], [0.5625, 1.0])
    """
    bins = RADIUS_RATIOS.size - 1
    sums = np.zeros((len(seeds), 5, bins))
    for number, (small, large, energy) in enumerate(seeds):
        ratio = np.exp(small - large)
        group = np.searchsorted(RADIUS_RATIOS * (1.0 + ROUNDING), ratio, side="left") - 1
        group = np.clip(group, 0, bins - 1)
        power = np.exp(length_exponent * log_length(small, large))
        expected = power * np.exp(ratio_exponent * log_equality(small, large))
        parts = (None, ratio, power, expected, energy)
        sums[number] = [np.bincount(group, part, bins) for part in parts]
    count, ratio, power, expected, _ = sums.sum(axis=0)
    last = int(np.flatnonzero(count)[-1])
    with np.errstate(invalid="ignore", divide="ignore"):
        fitted = expected / power

        def measured(totals: NDArray) -> NDArray:
            per_power = totals[:, 4] / totals[:, 2]
            return fitted[last] * per_power / per_power[:, last, None]

        found = pooled_interval(
            sums,
            measured,
            confidence=confidence,
            resamples=resamples,
            rng=Resampling.PREDICTORS.rng(),
        )
        return {
            "radius_ratio_low": RADIUS_RATIOS[:-1],
            "radius_ratio_high": RADIUS_RATIOS[1:],
            "mean_radius_ratio": ratio / count,
            "branches": count.astype(int),
            **found.named("g"),
            "g_fitted": fitted,
        }
