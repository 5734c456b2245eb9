"""How well a number tells those that an event meets from those that it spares: ROC curves."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray


class Places(NamedTuple):
    """Where those that an event meets stand among those that it spares; shape (n,) each [-]."""

    above: NDArray  # share of the spared whose number is greater
    level: NDArray  # share of the spared whose number is the same

    @property
    def below(self) -> NDArray:
        """Share of the spared whose number is smaller, half of the equal ones counted."""
        return 1.0 - self.above - self.level / 2.0


def places(values: ArrayLike, met: ArrayLike) -> Places:
    r"""Return where those that an event meets stand among the others.

    .. math:: \frac{1}{n} \sum_k \mathrm{below}_k = \frac{U}{n\,m}

    U is the statistic of Mann and Whitney, n are met and m spared: the mean of `below` is the area
    under the ROC curve, the chance that one that is met has the greater number.

    Parameters
    ----------
    values : array_like, shape (N,)
        Any one unit, no nan.
    met : array_like of bool, shape (N,)

    Returns
    -------
    Places
        Empty where none is met, or none spared.

    Raises
    ------
    ValueError
        Where a value is nan: it has no place.

    Examples
    --------
    >>> places([3.0, 1.0, 2.0, 2.0], [True, False, False, True]).below.tolist()
    [1.0, 0.75]

    References
    ----------
    Hanley and McNeil (1982), Radiology 143, 29; Pepe (2003), The Statistical Evaluation of Medical
    Tests for Classification and Prediction, section 4.3 (placement values).
    """
    values, met = np.asarray(values, dtype=float), np.asarray(met, dtype=bool)
    if np.isnan(values).any():
        raise ValueError("a value that is nan has no place among the others")
    spared = np.sort(values[~met])
    if not spared.size:
        return Places(np.empty(0), np.empty(0))
    first, last = (np.searchsorted(spared, values[met], side) for side in ("left", "right"))
    return Places(1.0 - last / spared.size, (last - first) / spared.size)


def roc_curve(found: Places, alarms: ArrayLike) -> NDArray:
    r"""Return the share of the met that is found at each share of false alarms.

    .. math:: \mathrm{found}(t) = \frac{1}{n} \sum_k
        \min\left(1, \max\left(0, \frac{t - \mathrm{above}_k}{\mathrm{level}_k}\right)\right)

    Parameters
    ----------
    found : Places
    alarms : array_like, shape (m,)
        Shares t of the spared that are taken for met, from 0 to 1 [-].

    Returns
    -------
    ndarray, shape (m,)
        [-]; its integral is the mean of `Places.below`. nan where none is met.

    Examples
    --------
    >>> roc_curve(places([3.0, 1.0, 2.0], [True, False, False]), [0.0, 0.5, 1.0]).tolist()
    [1.0, 1.0, 1.0]
    >>> roc_curve(places([1.0, 1.0], [True, False]), [0.0, 0.5, 1.0]).tolist()
    [0.0, 0.5, 1.0]
    """
    alarms = np.asarray(alarms, dtype=float)[:, None]
    if not found.above.size:
        return np.full(len(alarms), np.nan)
    past = alarms - found.above
    with np.errstate(divide="ignore", invalid="ignore"):
        shared = np.clip(past / found.level, 0.0, 1.0)
    return np.where(found.level > 0.0, shared, past >= 0.0).mean(axis=1)
