"""Rule crushing_results: the compression line of grains that break, and its slope."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from branchcrush.packings.contact_laws import HertzContact
from branchcrush.samples.crushed_path import control_law
from branchcrush.samples.crushed_sizes import Crushable
from branchcrush.statistics.intervals import Interval
from branchcrush.statistics.resampling import Resampling, pooled_interval

# Share of the mass in fragments from which on a packing yields, and states that a line needs.
YIELDED, _STATES = 0.05, 4
_UNITS = ("_J_per_m3", "_Pa")


def on_the_line(states: pd.DataFrame) -> pd.DataFrame:
    """Return the states of the way in where the packing yields: a twentieth of the mass is broken.

    Parameters
    ----------
    states : DataFrame
        `crushing_states.csv`.

    Returns
    -------
    DataFrame
    """
    way_in = (states["leg"] == "loading") & states["carries_load"].astype(bool)
    return states[way_in & (states["broken_mass_fraction"] >= YIELDED)]


def compression_slope(void_ratio: NDArray, stress: NDArray) -> float:
    r"""Return the slope of the compression line in logarithms.

    .. math:: \lambda = -\frac{d \ln e}{d \ln p}

    A straight line of ln p over ln e: the strain is set and the stress scatters, by a fifth from
    state to state. A line of ln e over ln p would come out too flat.

    Parameters
    ----------
    void_ratio, stress : ndarray, shape (n,)
        e [-], and p [Pa].

    Returns
    -------
    float
        [-]; nan with fewer than 4 states, or where stress does not rise.

    Examples
    --------
    >>> stress = np.array([1e6, 2e6, 4e6, 8e6])
    >>> round(compression_slope(0.5 * (stress / 1e6) ** -0.5, stress), 9)
    0.5
    """
    if len(void_ratio) < _STATES:
        return float("nan")
    rise = np.polyfit(np.log(void_ratio), np.log(stress), 1)[0]
    return float(-1.0 / rise) if rise < 0.0 else float("nan")


def compression_line(
    states: pd.DataFrame,
    controls: Mapping[int, pd.DataFrame],
    sample: Crushable,
    intervals: Mapping[str, Any],
) -> tuple[pd.DataFrame, dict]:
    r"""Return the line that the gradings alone predict, and slopes beside the laws.

    .. math:: e = \frac{1 - \epsilon_e}{\phi_J} - 1, \qquad p = S\, p_0(\epsilon_e), \qquad
        \epsilon_e = \epsilon_0 \left(\frac{d_Q}{d_{Q0}}\right)^x

    The gradings are the simulated ones; phi_J, S and d_Q are by rods, p_0 is that of the same
    packing whose grains do not break. eps_0 is the one number that is taken from the crushing: the
    geometric mean over the states that yield. x is 1 - b, with Hertz's contacts -2b/3.

    Parameters
    ----------
    states : DataFrame
        `crushing_states.csv`.
    controls : mapping of int to DataFrame
        `path.csv` of grains that do not break, by seed.
    sample : Crushable
    intervals : mapping
        confidence and resamples.

    Returns
    -------
    table : DataFrame
        `crushing_line.csv`, a row for each state that yields.
    summary : dict
    """
    line = on_the_line(states[~states["halved_step"]]).copy()
    b = sample.size_exponent
    power = -2.0 * b / 3.0 if isinstance(sample.law, HertzContact) else 1.0 - b
    change = line["contact_diameter_ratio"] ** power
    ratio = np.log(line["elastic_strain"] / change)
    scale = float(np.exp(ratio.mean())) if len(line) else float("nan")
    line["predicted_elastic_strain"] = scale * change
    jammed = (1.0 - line["predicted_elastic_strain"]) / line["jamming_by_rods"]
    line["predicted_void_ratio"] = jammed - 1.0
    line["predicted_stress_Pa"] = np.nan
    for seed, rows in line.groupby("seed"):
        strain, stress = control_law(controls[seed], sample.law)
        at = rows["predicted_elastic_strain"].to_numpy()
        if len(strain) > 1:
            # In logarithms: the law is close to a power.
            law = np.exp(np.interp(np.log(at), np.log(strain), np.log(stress), np.nan, np.nan))
            line.loc[rows.index, "predicted_stress_Pa"] = rows["stiffness_ratio"] * law
    columns = ["seed", "state", "solid_fraction", "void_ratio", "mean_stress_Pa", "elastic_strain"]
    predicted = [f"predicted_{name}" for name in ("elastic_strain", "void_ratio", "stress_Pa")]
    return line[columns + predicted].reset_index(drop=True), {
        "states_on_line": len(line),
        "yields_from_broken_mass": YIELDED,
        "elastic_strain_scale": scale,
        **_slopes(line, sample, intervals),
        "void_ratio_error": _root_mean_square(line["predicted_void_ratio"] - line["void_ratio"]),
        # Of the logarithm: e^rms is by what factor the stress is off.
        "log_stress_factor": float(
            np.exp(_root_mean_square(np.log(line["predicted_stress_Pa"] / line["mean_stress_Pa"])))
        ),
    }


def mean_interval(values: Sequence[float], intervals: Mapping[str, Any]) -> Interval:
    """Return the mean of one number a seed with its interval; of fewer than two there is none.

    Parameters
    ----------
    values : sequence of float
        Of each seed; nan is left out.
    intervals : mapping
        confidence and resamples.

    Returns
    -------
    Interval

    Examples
    --------
    >>> mean_interval([1.0, float("nan")], {"confidence": 0.95, "resamples": 100})
    Interval(estimate=1.0, low=nan, high=nan)
    """
    known = np.asarray(values, float)
    known = known[np.isfinite(known)]
    if not known.size:
        return Interval(np.nan, np.nan, np.nan)
    sums = np.stack([known, np.ones_like(known)], axis=1)
    return pooled_interval(
        sums, lambda x: x[:, 0] / x[:, 1], rng=Resampling.CRUSHED.rng(), **intervals
    )


def named_mean(
    name: str, values: Sequence[float], intervals: Mapping[str, Any]
) -> dict[str, float]:
    """Return `mean_interval` by its names in tables, where a unit stays last.

    Parameters
    ----------
    name : str
        Of the quantity, with its unit.
    values : sequence of float
        Of each seed.
    intervals : mapping
        confidence and resamples.

    Returns
    -------
    dict

    Examples
    --------
    >>> list(named_mean("stress_Pa", [1.0], {"confidence": 0.95, "resamples": 100}))
    ['stress_Pa', 'stress_low_Pa', 'stress_high_Pa']
    """
    unit = next((unit for unit in _UNITS if name.endswith(unit)), "")
    stem = name.removesuffix(unit)
    named = mean_interval(values, intervals).named(stem)
    return {key + unit: value for key, value in named.items()}


def _slopes(line: pd.DataFrame, sample: Crushable, intervals: Mapping[str, Any]) -> dict:
    measured, predicted, exponents = [], [], []
    for _, rows in line.groupby("seed"):
        measured.append(compression_slope(*rows[["void_ratio", "mean_stress_Pa"]].to_numpy().T))
        known = rows.dropna(subset=["predicted_stress_Pa"])
        of_model = known[["predicted_void_ratio", "predicted_stress_Pa"]].to_numpy().T
        predicted.append(compression_slope(*of_model))
        exponents.append(rows["number_exponent"].iloc[-1])
    alpha = mean_interval(exponents, intervals)
    return {
        **mean_interval(measured, intervals).named("slope"),
        **mean_interval(predicted, intervals).named("predicted_slope"),
        **alpha.named("number_exponent"),
        "slope_by_strength": 1.0 / (2.0 * sample.size_exponent),
        "slope_by_number_exponent": (3.0 - alpha.estimate) / sample.size_exponent,
        "slopes": measured,
    }


def _root_mean_square(values: pd.Series) -> float:
    return float(np.sqrt((values**2).mean()))
