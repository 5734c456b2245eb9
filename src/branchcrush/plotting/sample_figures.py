"""The figures of a sample, a function each: from its result files to one picture."""

import os
from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.files.tables import Table
from branchcrush.packings.contact_laws import OVERLAP_FLAG
from branchcrush.plotting import (
    branches,
    certificate,
    crushing,
    energy,
    forces,
    gradings,
    loading,
    predictors,
    shielding,
)
from branchcrush.plotting.packings import plot_packing
from branchcrush.plotting.style import SIZE, drawn, figure
from branchcrush.samples.ensemble import end_of_loading

Path = str | os.PathLike


def grid(rows: int, columns: int) -> tuple[tuple[float, float], tuple[int, int]]:
    """Return size [inch] and panels of a figure of panels of one journal column each.

    Examples
    --------
    >>> grid(1, 2)
    ((7.0, 2.7), (1, 2))
    """
    return (columns * SIZE[0], rows * SIZE[1]), (rows, columns)


# --- packings ------------------------------------------------------------------------------------


def draw_grading(path: Path, dpi: int, grading: Table) -> Figure:
    """Draw Fig. 3 from `grading.csv`, and return it."""
    with figure(path, dpi) as ax:
        gradings.plot_grading(grading, ax)
    return ax.figure


def draw_packing(
    path: Path,
    dpi: int,
    packing: tuple[NDArray, NDArray, float],
    particles: Mapping[str, NDArray],
    loading_path: Table,
    radius_max: float,
) -> Figure:
    """Draw Fig. 4, a packing before and after its loading to one scale, and return it.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    packing : tuple
        Positions, shape (N, 3), radii, shape (N,), and edge of `packing.npz` [m].
    particles : mapping of ndarray, shape (N,)
        The frame of `particles.dump.gz` at the end of the loading: x, y, z, radius [m].
    loading_path : DataFrame
        `path.csv` of this packing.
    radius_max : float
        At the dark end of the colours [m].

    Returns
    -------
    Figure
    """
    positions, radii, edge = packing
    end = end_of_loading(loading_path)
    scale = {"extent": edge, "radius_max": radius_max}
    with figure(path, dpi, *grid(1, 2)) as (before, after):
        plot_packing(positions, radii, edge, **scale, ax=before)
        positions = np.column_stack([particles[axis] for axis in "xyz"])
        last_edge = end["volume_m3"] ** (1 / 3)
        plot_packing(positions, particles["radius"], last_edge, **scale, ax=after)
        first = loading_path["solid_fraction"].iloc[0]
        before.set_title(rf"placed at random, $\phi$ = {first:.3f}")
        after.set_title(rf"compressed, $\phi$ = {end['solid_fraction']:.3f}")
    return before.figure


def draw_loading_path(path: Path, dpi: int, states: Table, model: Mapping) -> Figure:
    """Draw stress, energies, coordination and elastic law along the loading, and return it.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    states : DataFrame
        `path.csv` of all seeds, from `samples.ensemble.stacked`.
    model : dict
        `thermodynamics.json`.

    Returns
    -------
    Figure
    """
    with figure(path, dpi, *grid(2, 2)) as panels:
        loading.plot_mean_stress(states, panels[0, 0])
        loading.plot_energy_balance(states, panels[0, 1])
        loading.plot_coordination(states, panels[1, 0])
        drawn(loading.plot_elastic_law, model.get("reason"), states, model, ax=panels[1, 1])
    return panels[0, 0].figure


def draw_certificate(
    path: Path, dpi: int, states: Table, jamming: Table, verdict: Mapping
) -> Figure:
    """Draw the certificate from `certificate.csv`, `jamming.csv` and `certificate.json`."""
    with figure(path, dpi, *grid(2, 2)) as panels:
        certificate.plot_rest(states, verdict["limits"], panels[0, 0])
        certificate.plot_overlaps(states, OVERLAP_FLAG, panels[0, 1])
        certificate.plot_dissipation(states, panels[1, 0])
        certificate.plot_jamming(jamming, panels[1, 1])
    return panels[0, 0].figure


# --- fits ----------------------------------------------------------------------------------------


def draw_energy_split(path: Path, dpi: int, table: Table, fit: EnergySplitFit) -> Figure:
    """Draw Fig. 5 from `energy_split.csv` and `energy_split.json`, and return it."""
    with figure(path, dpi) as ax:
        drawn(energy.plot_energy_split, fit.reason, table, fit, ax=ax)
    return ax.figure


def draw_cubic(path: Path, dpi: int, table: Table, fit: EnergySplitFit) -> Figure:
    """Draw Fig. 6 from `energy_split.csv` and `energy_split.json`, and return it."""
    with figure(path, dpi) as ax:
        drawn(energy.plot_cubic, fit.reason, table, fit, ax=ax)
    return ax.figure


def draw_branch_lengths(
    path: Path, dpi: int, table: Table, statistics: Mapping, radius_max: float
) -> Figure:
    """Draw Fig. 7 from `branch_lengths.csv` and `branch_lengths.json`, over R_M [m]."""
    with figure(path, dpi) as ax:
        drawn(
            branches.plot_branch_lengths,
            statistics.get("reason"),
            table,
            statistics,
            radius_max,
            ax=ax,
        )
    return ax.figure


def draw_exponent_path(path: Path, dpi: int, states: Table, fit: EnergySplitFit) -> Figure:
    """Draw n along the loading from `energy_split_path.csv` and `energy_split.json`."""
    with figure(path, dpi) as ax:
        drawn(energy.plot_exponent_path, fit.reason, states, fit, ax=ax)
    return ax.figure


def draw_predictors(path: Path, dpi: int, fit: EnergySplitFit) -> Figure:
    """Draw what predicts the energies, and their local exponents, from `energy_split.json`."""
    with figure(path, dpi, *grid(1, 2)) as panels:
        drawn(predictors.plot_predictors, fit.reason, fit, ax=panels[0])
        drawn(predictors.plot_slopes, fit.reason, fit, ax=panels[1])
    return panels[0].figure


def draw_crushing_model(path: Path, dpi: int, curves: Table, model: Mapping) -> Figure:
    """Draw the crushing model from `thermodynamics.csv` and `thermodynamics.json`."""
    free, stress = r"free energy $\Psi$ [MJ/m³]", r"mean stress $\sigma$ [MPa]"
    with figure(path, dpi, *grid(3, 2)) as panels:
        for ax, plot, *data in (
            (panels[0, 0], crushing.plot_reference_energy, curves),
            (panels[0, 1], crushing.plot_family, curves, "free_energy_J_per_m3", free),
            (panels[1, 0], crushing.plot_family, curves, "stress_Pa", stress),
            (panels[1, 1], crushing.plot_crushing, curves, model),
            (panels[2, 0], crushing.plot_driving_force, curves),
            (panels[2, 1], crushing.plot_dissipation, curves),
        ):
            drawn(plot, model.get("reason"), *data, ax=ax)
    return panels[0, 0].figure


# --- networks ------------------------------------------------------------------------------------


def draw_who_touches_whom(
    path: Path, dpi: int, numbers: Mapping, tables: Mapping[str, Table], radius_max: float
) -> Figure:
    """Draw contact numbers, pairs of radii and predicted branch lengths, and return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    numbers : dict
        `contact_numbers.json`.
    tables : mapping of DataFrame
        `contact_numbers.csv`, `contact_pairs.csv` and `length_predictions.csv`, by these names
        without their ends.
    radius_max : float
        R_M [m].

    Returns
    -------
    Figure
    """
    lengths = tables["length_predictions"]
    with figure(path, dpi, *grid(2, 2)) as panels:
        for ax, plot, *data in (
            (panels[0, 0], branches.plot_contact_numbers, tables["contact_numbers"], numbers),
            (panels[0, 1], branches.plot_pairs, tables["contact_pairs"], numbers),
            (panels[1, 1], branches.plot_mean_lengths, lengths),
        ):
            drawn(plot, numbers.get("reason"), *data, radius_max, ax=ax)
        drawn(branches.plot_distances, numbers.get("reason"), lengths, ax=panels[1, 0])
    return panels[0, 0].figure


def draw_sharing(
    path: Path, dpi: int, shared: Mapping, tables: Mapping[str, Table], radius_max: float
) -> Figure:
    """Draw who carries what: shielding, forces, stress and fabric; and return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    shared : dict
        `sharing.json`.
    tables : mapping of DataFrame
        `samples.sharing.TABLES` of the sample, by name.
    radius_max : float
        R_M [m].

    Returns
    -------
    Figure
    """
    why = shared.get("reason")
    by_branch = why or shared["end"]["shielding"]["branches"].get("reason")
    with figure(path, dpi, *grid(4, 2)) as panels:
        panels.flat[-1].set_axis_off()
        for ax, (name, plot, result, *data) in zip(
            panels.flat[:-1],
            (
                ("shielding_branches", shielding.plot_branch_shielding, by_branch, shared),
                ("shielding_grains", shielding.plot_grain_shielding, why),
                ("force_distribution", forces.plot_force_distribution, why, shared),
                ("force_by_length", forces.plot_force_by_length, why, shared, radius_max),
                ("stress_by_radius", forces.plot_stress_by_radius, why, radius_max),
                ("stress_sharing", forces.plot_stress_sharing, why, shared),
                ("fabric", forces.plot_fabric, why, shared),
            ),
            strict=True,
        ):
            drawn(plot, result, tables[name], *data, ax=ax)
    return panels[0, 0].figure
