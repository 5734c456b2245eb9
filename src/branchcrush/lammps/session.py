"""A LAMMPS instance that Python leads through the files of lammps_inputs, command by command.

Where a decision has to be made between two relaxations, no script can go on alone.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

from branchcrush.breakage.criterion import Sides, sides
from branchcrush.breakage.grains import Exchange, Grains
from branchcrush.lammps.run import why_stopped
from branchcrush.packings.contact_laws import HertzContact, LinearContact, reduced_radius

# Of the library interface: values of a compute by contact, as a table.
_LOCAL, _ARRAY = 2, 2
# Columns of the compute `pairs` of mod.output.
_DISTANCE, _VECTOR, _FORCE = 0, slice(1, 4), 4


@dataclass(frozen=True, eq=False)
class Rest:
    """A packing at rest, as LAMMPS has it: grains by rising number, contacts by grain."""

    number: NDArray  # of the grains, from 0, shape (N,)
    position: NDArray  # shape (N, 3) [m]
    radius: NDArray  # [m]
    i: NDArray  # rows of the grains of each contact, i < j, shape (M,)
    j: NDArray
    force: NDArray  # [N]
    direction: NDArray  # from i to j, of unit length, shape (M, 3) [-]
    energy: NDArray  # of each contact [J]
    wall_grain: NDArray  # row of the grain of each contact with a wall, shape (W,)
    wall_force: NDArray  # [N]
    wall_direction: NDArray  # from the grain to the wall, shape (W, 3) [-]
    wall_energy: NDArray  # [J]

    @property
    def elastic_energy(self) -> float:
        """Of all contacts, walls' included [J]."""
        return float(self.energy.sum() + self.wall_energy.sum())

    @property
    def sides(self) -> Sides:
        """The contacts as each grain feels them."""
        return sides(
            self.i, self.j, self.force, self.direction,
            self.wall_grain, self.wall_force, self.wall_direction,
        )  # fmt: skip


class Ended(Exception):
    """A run ends before its last target, validly: the reason."""


class Session:
    """A LAMMPS instance and what it was started with.

    Parameters
    ----------
    lammps : object
        The instance, started with the variables of in.compress.
    inputs : path-like
        The folder of mod.setup.
    periodic : bool
    law : LinearContact or HertzContact, optional
        For `rest` and `elastic_energy` alone.
    """

    def __init__(
        self,
        lammps: Any,
        inputs: str | PathLike[str],
        *,
        periodic: bool,
        law: LinearContact | HertzContact | None = None,
    ) -> None:
        self.lammps, self.inputs, self.periodic, self.law = lammps, inputs, periodic, law
        # Of all ranks; alone there is nobody to ask.
        self.ranks = int(lammps.extract_setting("world_size"))
        self._ranks = lammps.get_mpi_comm() if self.ranks > 1 else None
        self.command = lammps.command

    def include(self, name: str) -> None:
        """Run one of the files mod.<name>; raise `Ended` where no other can go on from there."""
        self.command(f"include {self.inputs}/mod.{name}")
        if why := why_stopped(self.lammps):
            raise Ended(why)

    def read(self, name: str) -> float:
        """Return the value of a variable."""
        return float(self.lammps.extract_variable(name))

    def text(self, name: str) -> str:
        """Return the text of a variable."""
        return str(self.lammps.extract_variable(name))

    def say(self, text: str) -> None:
        """Write a line to the log."""
        self.command(f'print "{text}"')

    def wait(self) -> None:
        """Wait until all ranks are here."""
        if self._ranks is not None:
            self._ranks.Barrier()

    def set(self, **values: float | int) -> None:
        """Give variables of style equal their values."""
        for name, value in values.items():
            self.command(f"variable {name} equal {value:.17g}")

    def set_edge(self, edge: float) -> None:
        """Tell mod.strain where the next strain step ends."""
        self.command(f"variable edge string {edge:.17g}")

    def set_index(self, values: Mapping[str, Any]) -> None:
        """Give variables of in.compress other values than they were started with.

        A `run 0` has to follow before any compute is asked for: until then those that read
        variables know them by numbers that deleting one has changed.
        """
        for name, value in values.items():
            self.command(f"variable {name} delete")
            text = f"{value:.17g}" if isinstance(value, float) else value
            self.command(f'variable {name} index "{text}"')

    @property
    def edge(self) -> float:
        """Of the cell as it is [m]."""
        low, high, *_ = self.lammps.extract_box()
        return float(high[0] - low[0])

    @property
    def first_rank(self) -> bool:
        """Whether this process is the one that writes."""
        return bool(self.lammps.extract_setting("world_rank") == 0)

    def rest(self) -> Rest:
        """Return the packing as it is, all forces up to date.

        It has to follow a `run 0`: what a compute was asked for before is what it answers until
        the next one.
        """
        number, position, radius = self._grains()
        order = np.argsort(number)
        number, position, radius = number[order], position[order], radius[order]
        ids, pairs = self._pairs()
        first, second = (np.searchsorted(number, ids[:, n].astype(int) - 1) for n in (0, 1))
        # LAMMPS tells where the first grain is, seen from the second.
        towards = np.where(first < second, -1.0, 1.0)
        i, j = np.minimum(first, second), np.maximum(first, second)
        order = np.lexsort((pairs[:, _DISTANCE], j, i))
        i, j, pairs, towards = i[order], j[order], pairs[order], towards[order]
        wall_grain, wall_depth, wall_direction = self._walls(position, radius)
        wall_force = self.law.force(wall_depth, radius[wall_grain])
        return Rest(
            number, position, radius, i, j,
            pairs[:, _FORCE],
            (towards / pairs[:, _DISTANCE])[:, None] * pairs[:, _VECTOR],
            self.law.energy(pairs[:, _FORCE], reduced_radius(radius[i], radius[j])),
            wall_grain,
            wall_force,
            wall_direction,
            self.law.energy(wall_force, radius[wall_grain]),
        )  # fmt: skip

    def elastic_energy(self) -> float:
        """Return the energy of all contacts [J]: that of `rest`, in a fraction of its time."""
        number, position, radius = self._grains()
        of_number = np.zeros(number.max() + 1)
        of_number[number] = radius
        ids, pairs = self._pairs()
        first, second = (of_number[ids[:, n].astype(int) - 1] for n in (0, 1))
        energy = self.law.energy(pairs[:, _FORCE], reduced_radius(first, second)).sum()
        grain, depth, _ = self._walls(position, radius)
        at_wall = self.law.energy(self.law.force(depth, radius[grain]), radius[grain])
        return float(energy + at_wall.sum())

    def local_order(self) -> tuple[NDArray, NDArray, NDArray, NDArray]:
        """Return number, position, radius and mass of all grains in the order LAMMPS has them.

        Forces are summed in this order: a run that goes on from a file takes the same way only if
        the file has it.
        """
        return (*self._grains(), self._gathered(self._of_atoms("rmass")))

    def set_masses(self, numbers: NDArray, masses: NDArray) -> None:
        """Give grains their masses [kg]."""
        self._write("rmass", numbers, masses)

    def set_positions(self, numbers: NDArray, positions: NDArray) -> None:
        """Put grains where they are to be [m]."""
        self._write("x", numbers, positions)

    def set_radii(self, numbers: NDArray, radii: NDArray) -> None:
        """Give grains their radii [m], and bring every force up to date."""
        self._write("radius", numbers, radii)
        self.update()

    def update(self) -> None:
        """Bring every force up to date after grains, radii or places have changed."""
        if not self.periodic:
            self.include("near")
        self.command("run 0 post no")

    def replace(self, after: Grains, change: Exchange, settings: Mapping[str, Any]) -> None:
        """Put fragments, touching each other, in the place of grains that broke.

        Parameters
        ----------
        after : Grains
            All the grains that there are then.
        change : Exchange
        settings : mapping
            Variables of in.compress for the new sizes.
        """
        # Not all at once: an input line is not to be endless.
        for start in range(0, change.gone.size, 1000):
            part = " ".join(map(str, change.gone[start : start + 1000] + 1))
            self.command(f"group gone id {part}")
        # Hertz's pair style notes pairs by where grains are in memory, and at the next run would
        # look for those that are gone.
        self.command("pair_style none")
        self.command("delete_atoms group gone compress no")
        self.command("group gone delete")
        position = change.position
        if self.periodic:
            half = self.edge / 2.0
            position = (position + half) % (2.0 * half) - half
        ids = [int(number) + 1 for number in change.number]
        made = self.lammps.create_atoms(
            len(ids), ids, [1] * len(ids), position.ravel().tolist(), None, None, False
        )
        if made != len(ids):
            raise RuntimeError(f"{made} of {len(ids)} fragments lie in the cell")
        # Created grains are half a metre large, and as heavy.
        radius = after.radius.copy()
        radius[-len(ids) :] = change.touching_radius
        self._write("radius", after.number, radius)
        # Whatever is not 0; mod.mass gives them theirs.
        self._write("rmass", change.number, np.full(len(ids), 1.0))
        self.set_index(settings)
        self.include("neighbours")
        self.include("pair")
        self.set(grains=after.number.size)
        self.update()
        self.include("mass")

    def _grains(self):
        position = self._gathered(self._of_atoms("x"))
        return (
            self._gathered(self._of_atoms("id")) - 1,
            position,
            self._gathered(self._of_atoms("radius")),
        )

    def _of_atoms(self, name):
        """Return a view of what this rank's grains have, those behind faces left out."""
        return self.lammps.numpy.extract_atom(name)[: self.lammps.extract_setting("nlocal")]

    def _gathered(self, part):
        if self._ranks is None:
            return np.array(part)
        return np.concatenate(self._ranks.allgather(np.array(part)))

    def _pairs(self):
        """Return the ids of the grains of all pairs that touch, and what `pairs` has of them."""
        tables = []
        for name, columns in (("ids", 2), ("pairs", 8)):
            table = self.lammps.numpy.extract_compute(name, _LOCAL, _ARRAY)
            # None where this rank has no contact.
            table = np.empty((0, columns)) if table is None else table
            tables.append(self._gathered(table))
        return tables

    def _walls(self, position, radius):
        """Return the grains that touch walls, how deep they are in them, and where these are."""
        if self.periodic:
            return np.zeros(0, int), np.zeros(0), np.zeros((0, 3))
        half = self.edge / 2.0
        depth = radius[:, None] - (half - np.abs(position))
        grain, axis = np.nonzero(depth > 0.0)
        direction = np.zeros((grain.size, 3))
        direction[np.arange(grain.size), axis] = np.sign(position[grain, axis])
        return grain, depth[grain, axis], direction

    def _write(self, name, numbers, values):
        """Write what grains have where LAMMPS keeps it, on each rank for its own."""
        own = self._of_atoms("id") - 1
        order = np.argsort(numbers)
        sorted_numbers, sorted_values = numbers[order], values[order]
        rows = np.searchsorted(sorted_numbers, own)
        rows[rows == len(numbers)] = 0
        known = sorted_numbers[rows] == own
        self._of_atoms(name)[known] = sorted_values[rows[known]]
