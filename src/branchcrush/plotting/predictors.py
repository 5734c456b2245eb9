"""What the energy of a branch depends on: predictors judged on seeds left out."""

import numpy as np
from matplotlib.axes import Axes

from branchcrush.energy.designs import log_equality
from branchcrush.energy.fit import EnergySplitFit
from branchcrush.energy.predictors import PREDICTORS
from branchcrush.energy.split import PAPER_EXPONENT
from branchcrush.files.tables import Table
from branchcrush.plotting.style import FAINT, MEASURED, MODEL, OTHER, STATES, axes, reason
from branchcrush.statistics.intervals import interval_names

# A bin of the ratio is drawn with so many branches or more, as by the shielding.
_FEWEST = 20


def plot_predictors(fit: EnergySplitFit, ax: Axes | None = None) -> Axes:
    """Draw the deviance that each predictor explains on seeds left out of its fit.

    Parameters
    ----------
    fit : EnergySplitFit
        Read from `energy_split.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    shown = 0
    for (label, color), state, side in _states(fit):
        known = [one for one in state.predictors if np.isfinite(one.explained.estimate)]
        rows = [list(PREDICTORS).index(one.name) - 0.12 * side for one in known]
        if known:
            value, low, high = np.array([one.explained for one in known]).T
            ax.errorbar(
                value, rows, xerr=[value - low, high - value], fmt="o", color=color, label=label
            )
            shown += 1
    ax.set_yticks(range(len(PREDICTORS)), [p.label for p in PREDICTORS.values()])
    ax.invert_yaxis()
    ax.set_xlabel("deviance explained on seeds left out [-]")
    if not shown:
        ax.text(0.5, 0.5, "needs two seeds or more", ha="center", transform=ax.transAxes)
        return ax
    ax.set_xlim(min(0.0, ax.get_xlim()[0]), None)
    ax.locator_params(axis="x", nbins=5)
    ax.legend(loc="lower center", bbox_to_anchor=(0.4, 1.0), ncols=2)
    return ax


def plot_local_exponents(fit: EnergySplitFit, ax: Axes | None = None) -> Axes:
    """Draw the exponent in ranges of branch length at the end, and the same at equal radius ratio.

    Parameters
    ----------
    fit : EnergySplitFit
        Read from `energy_split.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    parts = fit.end.local_exponents
    if not parts:
        return reason(ax, "branches have too few lengths")
    middle = np.array([(part.length_low + part.length_high) / 2.0 for part in parts])
    width = parts[0].length_high - parts[0].length_low
    series = (
        ("all", [part.exponent for part in parts], MEASURED, "o-", -0.06),
        ("at equal ratio", [part.at_equal_ratio for part in parts], OTHER, "v--", 0.06),
    )
    for label, exponents, color, style, side in series:
        value, low, high = np.array(exponents).T
        error = [value - low, high - value] if np.isfinite(low).any() else None
        ax.errorbar(middle + side * width, value, error, fmt=style, color=color, label=label)
    ax.axhline(PAPER_EXPONENT, color=MODEL, ls=":", lw=0.9, label="the paper's n = 3")
    if (fitted := fit.end.predictor("length_and_ratio")) is not None:
        q = fitted.parameters["length_exponent"].estimate
        ax.axhline(q, color=OTHER, ls="-.", lw=0.9, label=f"q = {q:.2f}")
    ax.set(
        xlabel=r"branch length $l/R_M$ [-]",
        ylabel="local exponent d ln E / d ln l [-]",
        xlim=(parts[0].length_low, parts[-1].length_high),
    )
    low, high = ax.get_ylim()
    ax.set_ylim(low, high + 0.45 * (high - low))
    ax.legend(loc="upper left", ncols=2)
    return ax


def plot_radius_ratio(table: Table, fit: EnergySplitFit, ax: Axes | None = None) -> Axes:
    """Draw the energy at equal length against the ratio of the radii, measured and as fitted.

    Parameters
    ----------
    table : DataFrame
        `energy_split_ratio.csv`.
    fit : EnergySplitFit
        Read from `energy_split.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    fitted = fit.end.predictor("length_and_ratio")
    if fitted is None:
        return reason(ax, "no two ratios of radii")
    rows = table[table["branches"] >= _FEWEST]
    value, low, high = (rows[name] for name in interval_names("g"))
    error = [value - low, high - value] if low.notna().any() else None
    x = rows["mean_radius_ratio"]
    ax.errorbar(x, value, error, fmt="o", color=MEASURED, label="measured")
    ratio = np.linspace(1e-3, 1.0, 200)
    t = fitted.parameters["ratio_exponent"].estimate
    g = np.exp(t * log_equality(np.log(ratio), np.zeros_like(ratio)))
    text = rf"$(4 r_1 r_2/l^2)^t$, t = {t:.2f}"
    ax.plot(ratio, g, color=OTHER, label=text)
    ax.axhline(1.0, color=FAINT, lw=0.8)
    ax.set(
        xlabel=r"ratio of the radii $r_{min}/r_{max}$ [-]",
        ylabel=r"energy at equal length, $g$ [-]",
        xlim=(0, 1.02),
    )
    ax.set_ylim(0.0, max(1.3, 1.1 * value.max()))
    ax.legend(loc="upper left")
    return ax


def _states(fit: EnergySplitFit) -> list[tuple]:
    """Return look, fit and side of the end, and of the state near jamming where there is one."""
    states = [(STATES["end"], fit.end, 1)]
    if fit.near_jamming is not None:
        states.append((STATES["near_jamming"], fit.near_jamming, -1))
    return states
