"""How far the energies of branches are from a power law of branch length."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from branchcrush.energy.designs import LinearDesign, log_length, prepared
from branchcrush.energy.predictors import BranchColumns
from branchcrush.energy.state_fit import Curvature
from branchcrush.statistics.gamma_regression import gamma_fit, parameter_intervals
from branchcrush.statistics.resampling import Resampling


def curvature(
    seeds: Sequence[BranchColumns], *, confidence: float = 0.95, resamples: int = 2000
) -> Curvature:
    r"""Return how far the energies are from a power law of branch length: its curvature.

    .. math:: \ln \langle E \rangle = \ln A + n \ln\frac{l}{l_0} + c \left(\ln\frac{l}{l_0}\right)^2

    l_0 is the geometric mean length, so n is the slope there. The power law is contradicted when
    the interval of c leaves out 0. The slopes at short and long branches, n + 2 c ln(l/l_0), say
    what that amounts to.

    Parameters
    ----------
    seeds, confidence, resamples
        As for `energy.predictors.compared_predictors`.

    Returns
    -------
    Curvature

    Raises
    ------
    FitError
        When fewer than three lengths carry energy.

    Examples
    --------
    >>> log = np.linspace(-1.0, 1.0, 11)
    >>> bend = curvature([(log, log, np.exp(3.0 * log + 0.5 * log**2))])  # l = 2 r, l_0 = 2
    >>> round(bend.curvature.estimate, 9), round(bend.slope_at_mean.estimate, 9)
    (0.5, 3.0)
    """
    logs = np.concatenate([log_length(small, large) for small, large, _ in seeds])
    centre = logs.mean() if logs.size else 0.0
    short, long = np.quantile(logs - centre, [0.1, 0.9]) if logs.size else (0.0, 0.0)
    del logs

    def columns(small: NDArray, large: NDArray) -> list[NDArray]:
        x = log_length(small, large) - centre
        return [x, x * x]

    design, made = prepared(LinearDesign(columns, [3.0, 0.0]), seeds)
    fit = gamma_fit(made, design)

    def wanted(theta: NDArray) -> NDArray:
        slope, bend = theta[:, 1], theta[:, 2]
        return np.stack([bend, slope + 2 * bend * short, slope, slope + 2 * bend * long], axis=1)

    limits = parameter_intervals(
        fit, wanted, confidence=confidence, resamples=resamples, rng=Resampling.PREDICTORS.rng()
    )
    return Curvature(limits.part(0), limits.part(1), limits.part(2), limits.part(3))
