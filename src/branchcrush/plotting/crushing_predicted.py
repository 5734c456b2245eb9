"""Crushing predicted from strengths and contacts alone, beside crushed packings."""

import os

from matplotlib.axes import Axes

from branchcrush.files.tables import Table
from branchcrush.plotting.style import MEASURED, MODEL, axes, figure, grid, reason

LABELS = {
    "grains_ratio": "grains over those before [-]",
    "einav_breakage": "Einav's breakage B [-]",
}
_MEGA = 1e6


def plot_predicted(quantity: str, predicted: Table, beside: Table, ax: Axes | None = None) -> Axes:
    """Draw a quantity against the solid fraction, predicted and measured.

    Parameters
    ----------
    quantity : str
        Of `LABELS`.
    predicted, beside : DataFrame
        From `samples.crushing_predicted`: of `predicted_states` and of `beside_predicted`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    rows = beside[beside["quantity"] == quantity]
    ax.plot(predicted["solid_fraction"], predicted[quantity], color=MODEL, label="predicted")
    _points(ax, rows)
    ax.set(xlabel="solid fraction [-]", ylabel=LABELS[quantity])
    end = rows["solid_fraction"].max()
    ax.set_xlim(right=end + 0.01)
    shown = predicted[quantity][predicted["solid_fraction"] <= end + 0.01]
    ax.set_ylim(0.0, 1.1 * max(shown.max(), rows["measured"].max()))
    return ax


def plot_predicted_line(predicted: Table, beside: Table, ax: Axes | None = None) -> Axes:
    """Draw the void ratio against the logarithm of the mean stress, predicted and measured.

    Parameters
    ----------
    predicted, beside : DataFrame
        As for `plot_predicted`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    rows = beside[beside["quantity"] == "mean_stress_Pa"]
    loaded = predicted[
        (predicted["mean_stress_Pa"] > 0.0)
        & (predicted["solid_fraction"] <= rows["solid_fraction"].max() + 0.01)
    ]
    style = {"color": MODEL, "label": "predicted"}
    ax.plot(loaded["mean_stress_Pa"] / _MEGA, loaded["void_ratio"], **style)
    void_ratio = 1.0 / rows["solid_fraction"] - 1.0
    label = f"simulated, mean of {rows['seeds'].iloc[0]} seeds"
    ax.plot(rows["measured"] / _MEGA, void_ratio, "o", color=MEASURED, label=label)
    ax.set(xscale="log", xlabel="mean stress [MPa]", ylabel="void ratio e [-]")
    ax.xaxis.set_major_formatter("{x:g}")
    return ax


def draw_crushing_predicted(
    path: str | os.PathLike, dpi: int, predicted: Table, beside: Table, why: str | None = None
) -> None:
    """Draw grains, the compression line and the breakage, predicted beside simulated.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    predicted, beside : DataFrame
        As for `plot_predicted`.
    why : str, optional
        Why nothing is predicted.
    """
    if why is not None:
        with figure(path, dpi) as ax:
            reason(ax, why)
        return
    with figure(path, dpi, *grid(1, 3)) as (numbers, line, breakage):
        plot_predicted("grains_ratio", predicted, beside, numbers)
        plot_predicted_line(predicted, beside, line)
        plot_predicted("einav_breakage", predicted, beside, breakage)
        line.legend()


def _points(ax: Axes, rows: Table) -> None:
    phi, mean = rows["solid_fraction"], rows["measured"]
    ax.plot(
        phi, mean, "o", color=MEASURED, label=f"simulated, mean of {rows['seeds'].iloc[0]} seeds"
    )
    if rows["measured_low"].notna().any():
        half = rows["measured_high"] - mean
        # No interval of these quantities reaches below 0.
        ax.errorbar(phi, mean, [half.clip(upper=mean), half], fmt="none", color=MEASURED, lw=0.6)
