"""The force network of a packing in space: chains in a slab, and which way contacts point."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.colors import LogNorm
from numpy.typing import NDArray

from branchcrush.files.tables import Table
from branchcrush.forces.fabric import orientation_band
from branchcrush.packings.cells import cell_corners
from branchcrush.plotting.style import FAINT, MEASURED, MODEL, axes

# Sectors of the rose, over half a turn: a branch has no head and no tail.
SECTORS = 12
# Widest line of a chain [points].
_WIDEST = 4.0


def plot_slab(
    grains: Table, contacts: Table, cell: NDArray, thickness: float, ax: Axes | None = None
) -> Axes:
    r"""Draw the force chains of the grains whose centres are in a slab across the middle.

    A line joins the centres of two touching grains, as wide as the force is over the largest; a
    branch through a face of a periodic cell is drawn from either grain.

    Parameters
    ----------
    grains : DataFrame
        `compressed.parquet`, places about the centre of the cell.
    contacts : DataFrame
        `contacts.parquet` of that state.
    cell : ndarray, shape (3, 3)
        Vectors of the edges of the cell, a row each [m].
    thickness : float
        Of the slab, across y [m].
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    seen, i, j, ends = _in_slab(grains, contacts, thickness)
    places = 1e3 * grains[["x_m", "z_m"]].to_numpy()
    _discs(ax, places[seen], 2e3 * grains["radius_m"].to_numpy()[seen])
    force = contacts["normal_force_N"].to_numpy()
    shown = seen[i] & seen[j]
    lines = LineCollection(
        _segments(places, i, j, ends, shown),
        linewidths=np.repeat(_WIDEST * force[shown] / force.max(), 2),
        colors=MODEL,
        capstyle="round",
    )
    ax.add_collection(lines)
    ax.set_title(f"force: widest {force.max():.3g} N, mean {force.mean():.3g} N")
    return _framed(ax, cell)


def plot_branch_energy(
    grains: Table, contacts: Table, cell: NDArray, thickness: float, ax: Axes | None = None
) -> Axes:
    """Draw the branches of the same slab, coloured by the energy that each holds over the mean.

    Parameters
    ----------
    grains, contacts, cell, thickness
        As for `plot_slab`.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    seen, i, j, ends = _in_slab(grains, contacts, thickness)
    places = 1e3 * grains[["x_m", "z_m"]].to_numpy()
    _discs(ax, places[seen], 2e3 * grains["radius_m"].to_numpy()[seen])
    energy = contacts["energy_J"].to_numpy() / contacts["energy_J"].mean()
    shown = seen[i] & seen[j]
    lines = LineCollection(
        _segments(places, i, j, ends, shown),
        array=np.repeat(energy[shown], 2),
        norm=LogNorm(1e-2, 1e1),
        cmap="viridis_r",
        linewidths=1.4,
    )
    ax.add_collection(lines)
    ax.figure.colorbar(
        lines, ax=ax, label="energy of the branch\nover the mean [-]", extend="both", shrink=0.8
    )
    return _framed(ax, cell)


def plot_rose(contacts: Table, normal: str, ax: Axes | None = None) -> Axes:
    r"""Draw which way the branches point about an axis, over what chance gives.

    Of independent, isotropic branches each of k sectors of half a turn has M/k of the M branches,
    and 95 % of such sectors lie in the grey band, by the binomial distribution.

    Parameters
    ----------
    contacts : DataFrame
        `contacts.parquet` of one state.
    normal : str
        The axis looked along: x, y or z.
    ax : Axes, optional
        With polar axes.

    Returns
    -------
    Axes
    """
    from matplotlib import pyplot as plt

    ax = ax if ax is not None else plt.subplots(subplot_kw={"projection": "polar"})[1]
    right, up = (name for name in "xyz" if name != normal)
    angle = np.arctan2(contacts[f"branch_{up}"], contacts[f"branch_{right}"]) % np.pi
    counts, edges = np.histogram(angle, bins=SECTORS, range=(0.0, np.pi))
    middle = (edges[1:] + edges[:-1]) / 2.0
    low, high = orientation_band(len(contacts), SECTORS)
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    ax.fill_between(turn, low, high, color=FAINT, alpha=0.4, lw=0, label="95 % by chance")
    share = counts * SECTORS / len(contacts)
    both = np.concatenate([middle, middle + np.pi])
    width = np.pi / SECTORS
    ax.bar(both, np.tile(share, 2), width, fill=False, edgecolor=MEASURED, lw=1.0, label="branches")
    ax.set(rlim=(0.0, max(1.5, 1.1 * float(share.max()))), rticks=(0.5, 1.0), rlabel_position=15)
    ax.set_xticks(np.arange(4) * np.pi / 2.0, [right, up, "", ""])
    ax.set_title(f"seen along {normal}")
    return ax


def _in_slab(
    grains: Table, contacts: Table, thickness: float
) -> tuple[NDArray, NDArray, NDArray, NDArray]:
    """Return which grains are in the slab, and of each contact the grains and its branch [mm]."""
    seen = np.abs(grains["y_m"].to_numpy()) <= thickness / 2.0
    i, j = (contacts[name].to_numpy() for name in ("i", "j"))
    return seen, i, j, 1e3 * contacts[["branch_x", "branch_z"]].to_numpy()


def _segments(places: NDArray, i: NDArray, j: NDArray, ends: NDArray, shown: NDArray) -> NDArray:
    """Return two halves of each branch, from its grains: one through a face is not drawn across."""
    half = ends[shown] / 2.0  # from grain i to j, or to its image
    one, other = places[i[shown]], places[j[shown]]
    halves = np.stack([np.stack([one, one + half], 1), np.stack([other, other - half], 1)], 1)
    return halves.reshape(-1, 2, 2)


def _discs(ax: Axes, places: NDArray, diameters: NDArray) -> None:
    """Draw the grains of the slab as pale discs of their largest section."""
    discs = EllipseCollection(
        diameters,
        diameters,
        np.zeros(len(diameters)),
        units="xy",
        offsets=places,
        offset_transform=ax.transData,
        facecolor="#eef1f5",
        edgecolor="#c3cad3",
        lw=0.4,
        zorder=0,
    )
    ax.add_collection(discs)


def _framed(ax: Axes, cell: NDArray) -> Axes:
    half = 1.06e3 * np.abs(cell_corners(cell)[:, [0, 2]]).max()
    ax.set(xlim=(-half, half), ylim=(-half, half), aspect="equal", xlabel="x [mm]", ylabel="z [mm]")
    return ax
