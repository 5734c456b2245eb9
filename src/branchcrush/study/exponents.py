"""The exponent of the energy split along the loading: where it is what, in samples of one study."""

from collections.abc import Sequence

import numpy as np

from branchcrush.energy.split import PAPER_EXPONENT
from branchcrush.files.tables import Table
from branchcrush.statistics.intervals import Interval, interval_names


def at_distance(path: Table, distance: float) -> Interval:
    """Return the exponent at a distance from jamming, between the states next to it.

    Parameters
    ----------
    path : DataFrame
        `energy_split_path.csv`.
    distance : float
        phi - phi_J [-].

    Returns
    -------
    Interval
        Of the exponent; nan beyond the states there are.

    Examples
    --------
    >>> import pandas as pd
    >>> path = pd.DataFrame({"solid_fraction_above_jamming": [0.0, 0.2], "exponent": [2.0, 4.0],
    ...                      "exponent_low": [1.0, 3.0], "exponent_high": [3.0, 5.0]})
    >>> [round(value, 9) for value in at_distance(path, 0.1)]
    [3.0, 2.0, 4.0]
    """
    known = path[path["exponent"].notna()]
    above = known["solid_fraction_above_jamming"].to_numpy()
    if not above.size or not above[0] <= distance <= above[-1]:
        return Interval(np.nan, np.nan, np.nan)
    return Interval(
        *(float(np.interp(distance, above, known[name])) for name in interval_names("exponent"))
    )


def crossing(path: Table, exponent: float = PAPER_EXPONENT) -> float:
    """Return the distance from jamming from which on the exponent is above a value.

    Parameters
    ----------
    path : DataFrame
        `energy_split_path.csv`.
    exponent : float

    Returns
    -------
    float
        phi - phi_J [-]; nan when it is above all the way, or below at the end.

    Examples
    --------
    >>> import pandas as pd
    >>> path = pd.DataFrame({"solid_fraction_above_jamming": [0.0, 0.2], "exponent": [2.0, 4.0]})
    >>> round(crossing(path), 9)
    0.1
    """
    known = path[path["exponent"].notna()]
    above, value = (known[name].to_numpy() for name in ("solid_fraction_above_jamming", "exponent"))
    below = np.flatnonzero(value < exponent)
    if not below.size or below[-1] == value.size - 1:
        return np.nan
    last = below[-1]
    share = (exponent - value[last]) / (value[last + 1] - value[last])
    return float(above[last] + share * (above[last + 1] - above[last]))


def common_distance(paths: Sequence[Table]) -> float:
    """Return the largest distance from jamming that all samples reach, rounded down to 0.01.

    Parameters
    ----------
    paths : list of DataFrame
        `energy_split_path.csv` of each sample with data.

    Returns
    -------
    float
        phi - phi_J [-]; nan without samples. Those of one state, which have no path, and those
        whose phi_J is unknown do not count.

    Examples
    --------
    >>> import pandas as pd
    >>> common_distance([pd.DataFrame({"solid_fraction_above_jamming": [0.01, 0.128]})])
    0.12
    """
    ends = [path["solid_fraction_above_jamming"].max() for path in paths if len(path) > 1]
    known = [end for end in ends if np.isfinite(end)]
    return float(np.floor(min(known) * 100.0 + 1e-9) / 100.0) if known else float("nan")
