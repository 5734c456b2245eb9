"""The energy-split function f(l) = (l/l_r)^n: how elastic energy divides among branches.

Energy is broad at every length (its coefficient of variation is about 1), so the power law is
fitted as a mean of gamma-distributed energies with a logarithmic link: each branch counts alike,
whatever the scale of its energy, and the amplitude is free.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.statistics.power_law import PowerLaw

# n, by the paper.
PAPER_EXPONENT = 3.0


def energy_split(
    sums: ArrayLike, law: PowerLaw, radius_max: float
) -> tuple[dict[str, NDArray], float]:
    r"""Return the bins of the energy-split function, scaled by the fitted law.

    .. math:: f(l) = \frac{\psi_b(l)/N_b}{A\, l_r^n}

    l_r is the mean length of the bin nearest to R_max. The paper divides by that bin's own mean
    (Eq. 26), whose noise then multiplies the whole curve; here f(l_r) is 1 on the fitted law.

    Parameters
    ----------
    sums : array_like, shape (3, n)
        `statistics.bins.binned_sums` of all seeds together.
    law : PowerLaw
        A l^n, fitted to the bins.
    radius_max : float
        [m]

    Returns
    -------
    dict of ndarray
        branch_length_m, branches, mean_energy_J, f; nan where a bin is empty.
    reference_length : float
        l_r [m].

    Examples
    --------
    >>> from branchcrush.statistics.power_law import PowerLaw
    >>> sums = np.array([[9.0, 4.0], [9.0, 8.0], [9.0, 32.0]])
    >>> table, reference = energy_split(sums, PowerLaw(1.0, 3.0), 1.1)
    >>> table["f"].tolist(), reference
    ([1.0, 8.0], 1.0)

    References
    ----------
    Paper, Eqs. 25 and 26.
    """
    counts, lengths, energies = np.asarray(sums, dtype=float)
    with np.errstate(invalid="ignore"):
        length, energy = lengths / counts, energies / counts
    reference = float(length[np.nanargmin(np.abs(length - radius_max))])
    return {
        "branch_length_m": length,
        "branches": counts.astype(int),
        "mean_energy_J": energy,
        "f": energy / (law.amplitude * reference**law.exponent),
    }, reference


def cubic_r_squared(relative_length: ArrayLike, f: ArrayLike) -> tuple[float, float]:
    r"""Return slope and R^2 of the paper's Fig. 6: f against (l/l_r)^3, a line through 0.

    .. math:: R^2 = 1 - \frac{\sum (f - a x)^2}{\sum (f - \bar f)^2}, \quad x = (l/l_r)^3

    Bins count alike here, as in the paper's figure; empty ones are left out.

    Parameters
    ----------
    relative_length, f : array_like, shape (n,)
        l/l_r [-] and the energy-split function [-].

    Returns
    -------
    slope, r_squared : float

    Examples
    --------
    >>> cubic_r_squared([1.0, 2.0], [1.0, 8.0])
    (1.0, 1.0)
    """
    cube, split = np.asarray(relative_length, dtype=float) ** 3, np.asarray(f, dtype=float)
    known = np.isfinite(cube) & np.isfinite(split)
    cube, split = cube[known], split[known]
    slope = cube @ split / (cube @ cube)
    residual = np.sum((split - slope * cube) ** 2)
    return float(slope), float(1.0 - residual / np.sum((split - split.mean()) ** 2))
