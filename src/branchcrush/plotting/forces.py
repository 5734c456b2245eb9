"""Whether the contact network leans one way: the fabric of each seed beside what chance gives."""

import numpy as np

from branchcrush.forces.fabric import chance_range
from branchcrush.plotting.style import FAINT, STATES, axes

_KINDS = {"branches": ("", "o"), "forces": ("force_", "^")}


def plot_fabric(table, summary, ax=None):
    """Draw the deviator of the fabric of each seed against the one expected by chance.

    Parameters
    ----------
    table : DataFrame
        `fabric.csv`.
    summary : dict
        `sharing.json`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    largest = 0.0
    for where, (label, color) in STATES.items():
        rows = table[table["where"] == where]
        if rows.empty:
            continue
        for kind, (key, marker) in _KINDS.items():
            expected = rows[f"expected_{key}deviator"]
            ratio = summary[where]["fabric"][kind]["deviator_over_expected"]
            ax.plot(
                expected,
                rows[f"{key}deviator"],
                marker,
                ms=3,
                color=color,
                mfc=color if kind == "branches" else "none",
                label=f"{kind}, {label}: {ratio:.2f}",
            )
            largest = max(largest, float(expected.max()))
    line = np.array([0.0, 1.1 * largest])
    low, high = chance_range(1)
    ax.fill_between(
        line,
        low * line,
        high * line,
        color=FAINT,
        alpha=0.25,
        lw=0,
        label="95 % of seeds by chance",
    )
    ax.plot(line, line, color=FAINT, lw=0.8)
    ax.set(
        xlabel=r"deviator expected by chance $1/\sqrt{M}$ [-]",
        ylabel="deviator of the fabric q [-]",
        xlim=(0, line[1] or 1.0),
    )
    ax.set_ylim(0, 1.6 * ax.get_ylim()[1])
    ax.legend(loc="upper left", title="root mean square over expected", title_fontsize=6.5)
    return ax
