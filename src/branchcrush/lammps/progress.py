"""What a crushing leaves at each saved state: all that is needed to go on from there."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from branchcrush.breakage.grains import Grains
from branchcrush.breakage.rules import Breakage
from branchcrush.breakage.strength import Strength
from branchcrush.lammps.checkpoint import Checkpoint, Saved
from branchcrush.lammps.kept import read_kept, write_kept
from branchcrush.packings.contact_laws import CONTACT_LAWS, HertzContact, LinearContact

_JOB = "job.kept"
_TABLES = ("grains", "breakages", "account")


@dataclass(frozen=True, kw_only=True, eq=False)
class Job:
    """A crushing as it was asked for."""

    radii: NDArray  # of the first packing, shape (N,) [m]
    targets: list[float]  # edges of the states [m]
    seed: int
    rules: Breakage
    law_name: str
    stiffness: float
    periodic: bool

    @property
    def law(self) -> LinearContact | HertzContact:
        """Contact law of the grains."""
        return CONTACT_LAWS[self.law_name].kind(self.stiffness)


class Progress(Checkpoint):
    """The folder in which a crushing keeps what it has reached: of each state its tables, too."""

    def __init__(self, folder: Path, key: str) -> None:
        super().__init__(folder, key)
        self._breakages: list[dict[str, NDArray]] = []

    def write_job(self, job: Job) -> None:
        """Write what is asked for."""
        plain = {name: value for name, value in asdict(job).items() if name != "radii"}
        write_kept(self.folder / _JOB, plain, {"radii": job.radii})

    def job(self) -> Job:
        """Return what is asked for."""
        plain, arrays = read_kept(self.folder / _JOB)
        rules = plain.pop("rules")
        strength = Strength(**rules.pop("strength"))
        return Job(radii=arrays["radii"], rules=Breakage(strength=strength, **rules), **plain)

    def note_breakages(self, **columns: Any) -> None:
        """Note grains that break, a value each or one for all; kept with the next state."""
        rows = columns["number"].size
        self._breakages.append(
            {name: np.array(value) if np.ndim(value) else np.full(rows, value)
             for name, value in columns.items()}
        )  # fmt: skip

    def note_state(self, crushing: Any, targets: int) -> None:
        """Keep a state that LAMMPS has just written.

        Parameters
        ----------
        crushing : lammps.crushing.Crushing
        targets : int
            How many are reached.
        """
        session = crushing.session
        number, position, *_ = session.local_order()
        if session.first_rank:
            self._write_tables(crushing, number, position)
        self._breakages = []
        # Last: where this one is, all others are.
        more = {
            "account": crushing.account.plain(),
            "next_number": crushing.grains.next_number,
        }
        self.note(session, targets, crushing.settings, more)

    def _write_tables(self, crushing, number, position):
        grains, session = crushing.grains, crushing.session
        state = int(session.read("state")) - 1
        order = np.argsort(number)
        place = order[np.searchsorted(number[order], grains.number)]
        columns = {
            "number": grains.number,
            "position": position[place],
            "radius": grains.radius,
            "strength": grains.strength,
            "parent": grains.parent,
            "generation": grains.generation,
            "stress": crushing.rest_stress,
            "descent": np.array([n for line in grains.descent for n in line], dtype=int),
        }
        broken = {}
        if self._breakages:
            names = self._breakages[0]
            broken = {name: np.concatenate([part[name] for part in self._breakages])
                      for name in names}  # fmt: skip
        plain = {name: session.read(name) for name in ("work", "stopped")}
        write_kept(self._of_state("grains", state), {}, columns)
        write_kept(self._of_state("breakages", state), {}, broken)
        write_kept(self._of_state("account", state), {**crushing.account.plain(), **plain}, {})

    def grains(self, saved: Saved) -> Grains:
        """Return the grains of a state that was kept."""
        _, columns = read_kept(self._of_state("grains", saved.state))
        lines = np.split(columns["descent"], np.cumsum(columns["generation"] + 1)[:-1])
        return Grains(
            *(columns[name] for name in ("number", "radius", "strength", "parent")),
            descent=[tuple(map(int, line)) for line in lines],
            next_number=saved.more["next_number"],
        )

    def table(self, name: str, states: int) -> tuple[list[Mapping], list[Mapping]]:
        """Return values and columns of `account`, `grains` or `breakages`, of each state."""
        # Nothing is kept of the loose packing.
        read = [({}, {}), *(read_kept(self._of_state(name, n)) for n in range(1, states))]
        return [plain for plain, _ in read], [columns for _, columns in read]

    def _check(self, saved):
        super()._check(saved)
        for state in range(1, saved.state + 1):
            for name in _TABLES:
                read_kept(self._of_state(name, state))

    def _of_state(self, name, state):
        return self.folder / f"{name}_{state}.kept"
