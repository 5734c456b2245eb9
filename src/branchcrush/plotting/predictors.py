"""What the energy of a branch depends on: predictors judged on seeds left out."""

import numpy as np
from matplotlib.axes import Axes

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.energy.predictors import PREDICTORS
from branchcrush.energy.split import PAPER_EXPONENT
from branchcrush.plotting.style import MODEL, STATES, axes


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
    ax.legend(loc="lower center", bbox_to_anchor=(0.4, 1.0), ncols=2)
    return ax


def plot_slopes(fit: EnergySplitFit, ax: Axes | None = None) -> Axes:
    """Draw the local exponents of the energy at short and at long branches.

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
    for (label, color), state, side in _states(fit):
        bend = state.curvature
        if bend.reason is not None:
            continue
        slopes = (bend.slope_at_10_percent, bend.slope_at_mean, bend.slope_at_90_percent)
        value, low, high = np.array(slopes).T
        text = f"{label}: c = {bend.curvature.estimate:.2f}"
        error = None
        if np.isfinite(low).all():
            text += f" ({bend.curvature.low:.2f} to {bend.curvature.high:.2f})"
            error = [value - low, high - value]
        ax.errorbar(np.arange(3) + 0.05 * side, value, error, fmt="o-", color=color, label=text)
    ax.axhline(PAPER_EXPONENT, color=MODEL, ls="--", lw=0.9, label="the paper's n = 3")
    ax.set_xticks(range(3), ["shortest 10 %", "mean", "longest 10 %"])
    ax.set(
        xlabel="branches, by length", ylabel="local exponent d ln E / d ln l [-]", xlim=(-0.3, 2.3)
    )
    low, high = ax.get_ylim()
    ax.set_ylim(low, high + 0.35 * (high - low))
    ax.legend(loc="upper left", title="c = 0 for a power law", title_fontsize=6.5)
    return ax


def _states(fit: EnergySplitFit) -> list[tuple]:
    """Return look, fit and side of the end, and of the state near jamming where there is one."""
    states = [(STATES["end"], fit.end, 1)]
    if fit.near_jamming is not None:
        states.append((STATES["near_jamming"], fit.near_jamming, -1))
    return states
