"""How what a packing takes grows with its number of grains, and what a larger one would take."""

import numpy as np

from benchmarks.measure import mean_and_error


def shares(evaluations):
    """Return how many force evaluations each part of a path to one state took.

    Parameters
    ----------
    evaluations : array_like of int
        So far, at the end of the approach and of each strain step; the last one is the state's.

    Returns
    -------
    dict of int
        `approach_evaluations`, `steps_evaluations` and `final_evaluations`.

    Examples
    --------
    >>> shares([100, 150, 170, 400])
    {'approach_evaluations': 100, 'steps_evaluations': 70, 'final_evaluations': 230}
    """
    approach, before, end = (int(evaluations[k]) for k in (0, -2, -1))
    return {
        "approach_evaluations": approach,
        "steps_evaluations": before - approach,
        "final_evaluations": end - before,
    }


def power_of_size(rows, name):
    r"""Return how a quantity grows with the number of grains, by least squares of its logarithm.

    .. math:: q = a N^p

    Parameters
    ----------
    rows : list of dict
        With `grains` and the quantity.
    name : str
        Of the quantity.

    Returns
    -------
    dict
        `factor` a, `power` p and its `standard_error`, None for two rows.

    Examples
    --------
    >>> rows = [{"grains": n, "seconds": 3.0 * n**1.5} for n in (100, 1000, 10_000)]
    >>> growth = power_of_size(rows, "seconds")
    >>> round(growth["factor"], 6), round(growth["power"], 6)
    (3.0, 1.5)
    """
    sizes = np.log([row["grains"] for row in rows])
    values = np.log([row[name] for row in rows])
    about = sizes - sizes.mean()
    power = float(about @ values / (about @ about))
    factor = float(np.exp(values.mean() - power * sizes.mean()))
    error, spare = None, len(rows) - 2
    if spare:
        left = values - values.mean() - power * about
        error = float(np.sqrt(left @ left / spare / (about @ about)))
    return {"factor": factor, "power": power, "standard_error": error}


def line_of_size(rows, name):
    r"""Return how a quantity grows with the number of grains, by least squares.

    .. math:: q = a + b N

    Parameters
    ----------
    rows : list of dict
        With `grains` and the quantity.
    name : str
        Of the quantity.

    Returns
    -------
    dict
        `start` a and `per_grain` b.

    Examples
    --------
    >>> rows = [{"grains": n, "MB": 90.0 + 0.002 * n} for n in (1000, 5000, 20_000)]
    >>> growth = line_of_size(rows, "MB")
    >>> round(growth["start"], 6), round(growth["per_grain"], 6)
    (90.0, 0.002)
    """
    slope, start = np.polyfit(*([row[key] for row in rows] for key in ("grains", name)), 1)
    return {"start": float(start), "per_grain": float(slope)}


def estimate(rows, growth, speed_up, grains):
    """Return what so many grains would take, from the largest packing that was run.

    Parameters
    ----------
    rows : list of dict
        Of one rank: `grains`, `evaluations` and `cpu_us_per_grain_and_evaluation`.
    growth : dict
        Of `power_of_size` for these two, of `line_of_size` for `peak_MB` and `output_MB`.
    speed_up : float or None
        On the clock, by the second rank.
    grains : int

    Returns
    -------
    dict
        `evaluations`, `cpu_us_per_grain_and_evaluation`, `hours_on_1_core`, `hours_on_8_ranks`
        (None without a speed-up), `peak_MB`, `output_MB`, and `assumptions` in words.

    Examples
    --------
    >>> rows = [{"grains": 10**5, "evaluations": 9000, "cpu_us_per_grain_and_evaluation": 0.4}]
    >>> growth = {"evaluations": {"power": 0.0}, "cpu_us_per_grain_and_evaluation": {"power": 0.0}}
    >>> growth |= dict.fromkeys(("peak_MB", "output_MB"), {"start": 90.0, "per_grain": 0.002})
    >>> told = estimate(rows, growth, 2.0, 10**6)
    >>> [round(told[f"hours_on_{on}"], 6) for on in ("1_core", "8_ranks")], told["peak_MB"]
    ([1.0, 0.125], 2090.0)
    """
    largest = max(row["grains"] for row in rows)
    of_largest = [row for row in rows if row["grains"] == largest]
    told = {"grains": grains}
    for name in ("evaluations", "cpu_us_per_grain_and_evaluation"):
        mean = mean_and_error([row[name] for row in of_largest])["mean"]
        told[name] = mean * (grains / largest) ** growth[name]["power"]
    seconds = told["evaluations"] * told["cpu_us_per_grain_and_evaluation"] * 1e-6 * grains
    told["hours_on_1_core"] = seconds / 3600.0
    told["hours_on_8_ranks"] = told["hours_on_1_core"] / speed_up**3 if speed_up else None
    for name in ("peak_MB", "output_MB"):
        told[name] = growth[name]["start"] + growth[name]["per_grain"] * grains
    told["assumptions"] = [
        f"evaluations, and the time of each for a grain, go on from {largest} grains with the "
        "powers fitted over all sizes; memory and output along their straight lines",
        "each doubling of the ranks gains what the second one gained for the largest packing run "
        "on both, with a core and a memory channel for each rank: 8 ranks are 3 doublings",
        "memory is that of one rank and its Python; more ranks hold their ghosts beside it",
        "the state is as far above jamming, and as well at rest",
    ]
    return told
