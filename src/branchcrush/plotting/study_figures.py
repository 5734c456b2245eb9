"""The figures of all samples together, a function each: from their result files to one picture."""

import os
from collections.abc import Callable, Mapping
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from branchcrush.files.tables import Table
from branchcrush.plotting import study, study_networks
from branchcrush.plotting.style import SIZE, figure, reason

Path = str | os.PathLike
Tables = Mapping[str, Table]
Styles = Mapping[str, Mapping]

_SIDE_BY_SIDE = (2 * SIZE[0], 1.2 * SIZE[1])


def draw_exponents(path: Path, dpi: int, paths: Tables, styles: Styles) -> Figure:
    """Draw n against the distance from jamming, a panel for each contact law.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    paths : mapping of DataFrame
        `energy_split_path.csv` by sample.
    styles : mapping of dict
        From `plotting.study.sample_styles`.

    Returns
    -------
    Figure
    """
    known = {
        name: table
        for name, table in with_data(paths).items()
        if table["solid_fraction_above_jamming"].notna().any()
    }
    panels = []
    for law in dict.fromkeys(style["law"] for style in styles.values()):
        of_law = {name: table for name, table in known.items() if styles[name]["law"] == law}
        panels.append((study.plot_exponents, of_law, styles, law))
    return _draw(path, dpi, _SIDE_BY_SIDE, *panels, nothing="of no sample are n and phi_J known")


def draw_lengths(path: Path, dpi: int, rows: Table) -> Figure:
    """Draw how far predicted branch lengths are off, from `findings.csv`."""
    return _draw_samples(path, dpi, rows, "lengths", "no sample has a state near jamming")


def draw_energies(path: Path, dpi: int, rows: Table) -> Figure:
    """Draw what predictors explain of the energies, from `findings.csv`."""
    return _draw_samples(path, dpi, rows, "energies", "no sample has seeds to leave out")


def draw_coordination(path: Path, dpi: int, states: Table, styles: Styles) -> Figure:
    """Draw coordination numbers by void ratio and by distance from jamming.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    states : DataFrame
        `coordination.csv` of all samples.
    styles : mapping of dict
        From `plotting.study.sample_styles`.

    Returns
    -------
    Figure
    """
    # A sample without data has a row that says why, and no state.
    known = states[states["state"].notna()] if "state" in states else states[:0]
    return _draw(
        path,
        dpi,
        _SIDE_BY_SIDE,
        (study_networks.plot_coordination, known, styles),
        (study_networks.plot_jamming_law, known, styles),
    )


def draw_shielding(
    path: Path, dpi: int, branches: Tables, grains: Tables, styles: Styles
) -> Figure:
    """Draw the shielding of branches and of grains.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    branches, grains : mapping of DataFrame
        `shielding_branches.csv` and `shielding_grains.csv` by sample.
    styles : mapping of dict
        From `plotting.study.sample_styles`.

    Returns
    -------
    Figure
    """
    return _draw(
        path,
        dpi,
        _SIDE_BY_SIDE,
        (study_networks.plot_branch_shielding, with_data(branches), styles),
        (study_networks.plot_grain_shielding, with_data(grains), styles),
    )


def draw_forces(path: Path, dpi: int, stress: Tables, forces: Tables, styles: Styles) -> Figure:
    """Draw how stress is shared and how forces are distributed.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    stress, forces : mapping of DataFrame
        `stress_sharing.csv` and `force_distribution.csv` by sample.
    styles : mapping of dict
        From `plotting.study.sample_styles`.

    Returns
    -------
    Figure
    """
    return _draw(
        path,
        dpi,
        _SIDE_BY_SIDE,
        (study_networks.plot_stress, with_data(stress), styles),
        (study_networks.plot_forces, with_data(forces), styles),
    )


def with_data(tables: Tables) -> dict[str, Table]:
    """Return the tables of the samples that have data: the others hold a reason.

    Examples
    --------
    >>> import pandas as pd
    >>> list(with_data({"a": pd.DataFrame({"reason": ["no load"]}), "b": pd.DataFrame()}))
    ['b']
    """
    return {name: table for name, table in tables.items() if "reason" not in table}


def _draw_samples(path: Path, dpi: int, rows: Table, kind: str, nothing: str) -> Figure:
    known = rows[rows["exponent_at_end"].notna()] if "exponent_at_end" in rows else rows[:0]
    # A sample of one state has no number near jamming, nor one of one seed a deviance.
    pattern = study.COLUMNS[kind].format(".+")
    known = known[known.filter(regex=f"^{pattern}$").notna().any(axis="columns")]
    size = (2 * SIZE[0], SIZE[1] + 0.16 * len(rows))
    return _draw(path, dpi, size, (study.plot_samples, known, kind), nothing=nothing)


def _draw(
    path: Path,
    dpi: int,
    size: tuple[float, float],
    *panels: tuple[Callable[..., Axes], Any, Any],
    nothing: str = "no sample has any",
) -> Figure:
    """Draw panels side by side; of each a plot, its data and what it takes besides."""
    with figure(path, dpi, size, (1, len(panels)), squeeze=False) as axes:
        for ax, (plot, data, *rest) in zip(axes.flat, panels, strict=True):
            plot(data, *rest, ax=ax) if len(data) else reason(ax, nothing)
    return axes[0, 0].figure
