"""A packing of one seed, and each of its saved states."""

from functools import cached_property
from pathlib import Path
from typing import Any

import pandas as pd
from numpy.typing import NDArray

from branchcrush.errors import ResultsError
from branchcrush.files.tables import read_packing
from branchcrush.forces.chains import ForceChains, force_chains
from branchcrush.packings.cells import path_cells
from branchcrush.packings.geometry import sphere_volume
from branchcrush.packings.grains import grain_stress_volume
from branchcrush.packings.network import DIRECTION_COLUMNS, WALL_COLUMNS, Network, state_network
from branchcrush.results import vtp
from branchcrush.results.place import Place
from branchcrush.results.result import drawn_by_plotting

_CENTRE = ["x_m", "y_m", "z_m"]


class Packing(Place):
    """The packing of one seed as it was compressed: `path`, `contacts`, `steps` and its states.

    Taken from a sample, as `sample.seed(1)`.
    """

    pattern = "<sample>/seed_<seed>/"

    @property
    def seed(self) -> int:
        """Its number."""
        return int(self._words["seed"])

    @property
    def title(self) -> str:
        """How it is called in messages."""
        return f"sample {self._words['sample']}, seed {self.seed}"

    @property
    def crushed(self) -> "CrushedPacking | None":
        """The same packing as it was crushed; None where its grains do not break."""
        crushed = CrushedPacking(self.package, **self._words)
        return crushed if crushed.folder.is_dir() else None

    def as_crushed(self) -> "CrushedPacking":
        """Return the same packing as it was crushed.

        Returns
        -------
        CrushedPacking

        Raises
        ------
        ResultsError
            When its grains do not break.
        """
        if self.crushed is None:
            raise ResultsError(
                f"{self.title} was not crushed: {self.prefix} has no folder crushing beside it. "
                "Give the sample a section breakage"
            )
        return self.crushed

    @property
    def loose(self) -> pd.DataFrame:
        """Centres and radii of the grains as placed at random, a row a grain."""
        positions, radii, _ = self._packing
        return pd.DataFrame(dict(zip(_CENTRE, positions.T, strict=True)) | {"radius_m": radii})

    @cached_property
    def states(self) -> tuple["State", ...]:
        """Its saved states, from the loose packing on."""
        return tuple(State(self, int(number)) for number in self.path["state"])

    @property
    def end(self) -> "State":
        """The state at the end of its loading, before any unloading."""
        loading = self.path.data.loc[self.path["leg"] == "loading", "state"]
        return self.state(int(loading.iloc[-1]))

    def state(self, number: int) -> "State":
        """Return a saved state.

        Parameters
        ----------
        number : int
            As in `path.csv`: 0 is the packing as placed; -1 is the last one, as in a list.

        Returns
        -------
        State

        Raises
        ------
        ResultsError
            When no such state was saved.
        """
        known = [state.number for state in self.states]
        if number < 0 and -number <= len(known):
            number = known[number]
        if number not in known:
            raise ResultsError(
                f"{self.title} has no state {number}: {known[0]} to {known[-1]} were saved"
            )
        return self.states[known.index(number)]

    def __repr__(self) -> str:
        gone = self.missing()
        if self.path.missing:
            return f"{self.title}: {gone[0]}"
        head = (
            f"{self.title}: {len(self.states)} states in .states; results {', '.join(self.results)}"
        )
        return "\n".join([head, *(f"  missing: {one}" for one in gone)])

    # --- what states are made of -----------------------------------------------------------------

    @cached_property
    def _packing(self) -> tuple[NDArray, NDArray, float]:
        file = self.package.folder / self.filled(Packing.pattern) / "packing.npz"
        if not file.is_file():
            raise ResultsError(f"{file} is not there: rule compression writes it")
        return read_packing(self.package.checked(file))

    @cached_property
    def _cells(self) -> dict[int, NDArray]:
        told = self.results.get("reading")  # of a packing that another code made
        reading = told.summary if told and told.exists else None
        if reading is not None and "cells_m" not in reading:
            raise ResultsError(
                f"{self.prefix}reading.json of {self.title} lacks cells_m, as results of another "
                "version may: run the study again"
            )
        cells = path_cells(self.path.data, reading)
        return dict(zip(self.path["state"], cells, strict=True))

    def _grains_at(self, number: int) -> pd.DataFrame | None:
        """Return centre and radius of each grain in a state; None where they are not kept."""
        if number == 0:
            return self.loose
        return self.compressed.data.copy() if number == self.end.number else None

    def _radii_at(self, number: int) -> NDArray:
        return self._packing[1]


class CrushedPacking(Packing):
    """The packing of one seed as it was crushed: its `grains` in every state, its `breakages`.

    Taken from a packing, as `sample.seed(1).crushed`.
    """

    pattern = "<sample>/crushing/seed_<seed>/"

    @property
    def title(self) -> str:
        """How it is called in messages."""
        return f"{super().title}, crushed"

    def _grains_at(self, number: int) -> pd.DataFrame | None:
        grains = self.grains.data
        rows = grains[grains["state"] == number].drop(columns="state").reset_index(drop=True)
        if number == 0:
            rows[_CENTRE] = self.loose[_CENTRE].to_numpy()
        return rows

    def _radii_at(self, number: int) -> NDArray:
        grains = self.grains.data
        return grains.loc[grains["state"] == number, "radius_m"].to_numpy()


class State:
    """A saved state of a packing: its numbers, grains, contacts, network and force chains.

    Parameters
    ----------
    packing : Packing
    number : int
        As in `path.csv`.
    """

    def __init__(self, packing: Packing, number: int) -> None:
        self.packing, self.number = packing, number

    @property
    def title(self) -> str:
        """How it is called in messages."""
        return f"{self.packing.title}, state {self.number}"

    @cached_property
    def numbers(self) -> pd.Series:
        """Its row of `path.csv`: solid fraction, stress, energy, coordination and the like."""
        table = self.packing.path.data
        return table[table["state"] == self.number].iloc[0]

    @property
    def cell(self) -> NDArray:
        """Vectors of the edges of the cell, a row each; its centre is the origin [m]."""
        return self.packing._cells[self.number]

    @cached_property
    def contacts(self) -> pd.DataFrame:
        """The contacts between grains, a row each, as `contacts.parquet` has them: the branches."""
        return self.packing.contacts.read(states=[self.number]).reset_index(drop=True)

    @cached_property
    def wall_contacts(self) -> pd.DataFrame:
        """The contacts with walls, a row each; none in a periodic cell."""
        return self.packing.wall_contacts.read(states=[self.number]).reset_index(drop=True)

    @cached_property
    def network(self) -> Network:
        """The contact network as arrays, with branch vectors, contact numbers and rattlers."""
        radii, walls = self.packing._radii_at(self.number), self.wall_contacts
        # A periodic cell has an empty table, whose columns have no type.
        held = {name: walls[name].to_numpy(dtype=float) for name in WALL_COLUMNS}
        return state_network(radii, self.contacts, held, self.number)

    @property
    def has_centres(self) -> bool:
        """Whether the centres of its grains are kept."""
        return self.packing._grains_at(self.number) is not None

    @cached_property
    def grains(self) -> pd.DataFrame:
        """The grains, a row each: centre, radius, contacts with grains, rattler, mean stress.

        Raises
        ------
        ResultsError
            When centres of this state are not kept.
        """
        table = self.packing._grains_at(self.number)
        if table is None:
            raise ResultsError(
                f"{self.title}: centres are kept of the loose packing (.state(0)) and of the "
                "end of the loading (.end). keep_dumps: all in config.yaml keeps those of every "
                "state as LAMMPS dumps, which OVITO opens"
            )
        network = self.network
        table["contacts"], table["rattler"] = network.contacts, network.rattlers
        table["mean_stress_Pa"] = grain_stress_volume(network) / sphere_volume(network.radius)
        table.attrs["units"] = {
            name: {"m": "m", "Pa": "Pa"}.get(name.rpartition("_")[2], "-") for name in table
        }
        return table

    @cached_property
    def force_chains(self) -> ForceChains:
        """Which contacts are links of force chains, by `forces.chains.force_chains`."""
        return force_chains(
            self.network, self.wall_contacts[[*DIRECTION_COLUMNS]].to_numpy(dtype=float)
        )

    def plot(self, ax: Any = None) -> Any:
        """Draw its grains in the cell, and return the Axes.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            A new figure by default.

        Returns
        -------
        Axes
        """
        return drawn_by_plotting(self, ax)

    def export_vtp(self, folder: str | Path) -> list[Path]:
        """Write it for ParaView: grains, contacts, with walls too, chains and cell, a file each.

        Parameters
        ----------
        folder : path-like
            Is made.

        Returns
        -------
        list of Path
            What was written, as `grains_0009.vtp` of state 9: ParaView shows states in turn.
        """
        table, chains = self.grains, self.force_chains
        contacts = self.contacts, self.wall_contacts
        return vtp.write_state(folder, self.number, self.cell, table, *contacts, chains)

    def __repr__(self) -> str:
        row = self.numbers
        carries = "carries load" if row["carries_load"] else "without load"
        return (
            f"{self.title}: φ = {row['solid_fraction']:.4f}, mean stress "
            f"{row['mean_stress_Pa']:.3g} Pa, {carries}, κ = {row['coordination_number']:.2f}, "
            f"{row['rattler_fraction']:.1%} rattlers"
        )
