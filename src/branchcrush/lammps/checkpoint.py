"""What a run keeps of each saved state, to go on from there to the same bytes when it is killed.

Forces are summed in the order in which LAMMPS has its grains, and a packing is chaotic: so they are
kept in that order, with their masses and all variables that tell where the run is. LAMMPS sorts
them and makes its lists anew before the next time step in a run that was not stopped, too.
"""

import hashlib
import json
import time
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from branchcrush import __version__
from branchcrush.lammps.files import write_data_file
from branchcrush.lammps.kept import Damaged, read_kept, write_kept
from branchcrush.lammps.library import lammps_version
from branchcrush.lammps.session import Session

# What LAMMPS appends to, state after state.
WRITTEN_ON = ("states.csv", "steps.csv", "particles.dump", "pairs.dump")
STATE = "state.kept"
# Variables of style equal that tell where a run is; those of the last line, on the way to a stress.
_SCALARS = (
    "work", "stopped", "state", "step", "kinetic_energy", "step_limit",
    "slope", "largest_change", "undone", "kept_edge", "kept_stress",
)  # fmt: skip
# A state that took less processor time is not kept: to keep it takes a millisecond or two [s].
LEAST_SECONDS = 0.1
# What the last digits of a path depend on.
_PACKAGES = ("lammps", "mpi4py", "mpich", "numpy", "scipy")
_AT_ONCE = 2**20  # [bytes]


@dataclass(frozen=True, eq=False)
class Saved:
    """A saved state."""

    targets: int  # how many are reached
    number: NDArray  # of the grains, in the order in which LAMMPS has them
    position: NDArray  # [m]
    radius: NDArray  # [m]
    mass: NDArray  # [kg]
    cell: float  # edge of it [m]
    edge: str  # the same, as the script has it
    scalars: dict[str, float]  # variables of in.compress, by name
    evaluations: int
    settings: dict[str, Any]  # variables of in.compress that have other values than at the start
    more: dict[str, Any]  # what only some runs have
    files: dict[str, tuple[int, int]]  # that LAMMPS appends to: size [bytes] and checksum

    @property
    def state(self) -> int:
        """Its number."""
        return int(self.scalars["state"]) - 1


def run_key(*parts: Any) -> str:
    """Return what tells a run from any other: of what was asked for, and by which versions.

    Parameters
    ----------
    *parts : arrays, or what JSON can hold

    Returns
    -------
    str

    Examples
    --------
    >>> run_key([0.1, 0.2], {"seed": 1}) == run_key([0.1, 0.3], {"seed": 1})
    False
    """
    digest = hashlib.sha256()
    versions = [__version__, lammps_version(), *map(_version, _PACKAGES)]
    for part in (versions, *parts):
        if isinstance(part, np.ndarray):
            digest.update(f"{part.dtype} {part.shape} ".encode() + part.tobytes())
        else:
            # JSON holds each digit of a float.
            digest.update(json.dumps(part, sort_keys=True, default=_plain).encode() + b"\n")
    return digest.hexdigest()


class Checkpoint:
    """The folder in which a run keeps the states that it has reached.

    Parameters
    ----------
    folder : Path
        LAMMPS writes its output there, too.
    key : str
        From `run_key`. What was kept under another one is never gone on with.
    """

    def __init__(self, folder: Path, key: str) -> None:
        self.folder, self.key = folder, key
        self._files = dict.fromkeys(WRITTEN_ON, (0, 0))
        self._since = time.process_time()

    def opened(self) -> str:
        """Make the folder ready: as the last saved state left it, or empty.

        Returns
        -------
        str
            Why what an earlier run kept is of no use, for the log; empty where it is of use, or
            nothing was kept.
        """
        try:
            if (saved := self.saved()) is not None:
                self._check(saved)
                self._cut(saved)
                return ""
            why = "is of other settings or another version" if self._has_state() else ""
        except Damaged as error:
            why = f"is damaged ({error})"
        self.folder.mkdir(parents=True, exist_ok=True)
        # The folder itself stays: one of scratch is locked.
        for path in self.folder.iterdir():
            path.unlink()
        return why and f"what an earlier run kept {why}: begins anew"

    def saved(self) -> Saved | None:
        """Return the last state that was kept; None where there is none of this key."""
        if not self._has_state():
            return None
        plain, arrays = read_kept(self.folder / STATE)
        return Saved(**plain, **arrays) if plain.pop("key") == self.key else None

    def note(
        self,
        session: Session,
        targets: int,
        settings: Mapping[str, Any] | None = None,
        more: Mapping[str, Any] | None = None,
    ) -> None:
        """Keep a state that LAMMPS has just written, if it pays.

        Over ranks it always does: the run reads it again.

        Parameters
        ----------
        session : Session
        targets : int
            How many are reached.
        settings : mapping, optional
            Variables of in.compress that have other values than at the start.
        more : mapping, optional
            What else is needed to go on, as JSON can hold it.
        """
        if session.ranks == 1 and time.process_time() - self._since < LEAST_SECONDS:
            return
        number, position, radius, mass = session.local_order()
        plain = {
            "key": self.key,
            "targets": targets,
            "cell": session.edge,
            "edge": session.text("edge"),
            "scalars": {name: session.read(name) for name in _SCALARS},
            "evaluations": int(session.lammps.extract_global("ntimestep")),
            "settings": dict(settings or {}),
            "more": dict(more or {}),
        }
        if session.first_rank:
            self._files = {name: self._sum(name, *self._files[name]) for name in WRITTEN_ON}
            arrays = {"number": number, "position": position, "radius": radius, "mass": mass}
            write_kept(self.folder / STATE, {**plain, "files": self._files}, arrays)
        session.wait()
        self._since = time.process_time()

    def restored(self, session: Session) -> Saved:
        """Set LAMMPS up with the last state that was kept, as it was then, and return it.

        Parameters
        ----------
        session : Session
        """
        saved = self.saved()
        if saved is None:
            raise RuntimeError(f"{self.folder} holds no state to go on from")
        self._files = saved.files
        if session.first_rank:
            write_data_file(
                self.folder / "packing.data",
                saved.position, saved.radius, saved.cell, saved.number,
            )  # fmt: skip
        session.wait()
        session.command("clear")
        going_on = {"append": "yes", "evaluations": saved.evaluations}
        session.set_index({**saved.settings, **going_on})
        session.include("setup")
        session.set(**saved.scalars)
        session.command(f"variable edge string {saved.edge}")
        session.set_masses(saved.number, saved.mass)
        session.update()
        return saved

    def _has_state(self):
        return (self.folder / STATE).exists()

    def _check(self, saved):
        """Look whether what was written before a state is whole."""
        for name, known in saved.files.items():
            path = self.folder / name
            if not path.exists() or self._sum(name, size=known[0]) != tuple(known):
                raise Damaged(name)

    def _cut(self, saved):
        """Cut off what was written after a state."""
        for name, (size, _) in saved.files.items():
            with open(self.folder / name, "r+b") as file:
                file.truncate(size)

    def _sum(self, name, start=0, checksum=0, size=None):
        """Return where a file or its part ends, and the checksum, known to `start`, until there."""
        with open(self.folder / name, "rb") as file:
            file.seek(start)
            while part := file.read(_AT_ONCE if size is None else min(_AT_ONCE, size - start)):
                start, checksum = start + len(part), zlib.crc32(part, checksum)
        return start, checksum


def _version(name):
    try:
        return version(name)
    except PackageNotFoundError:  # one that was built for this machine
        return None


def _plain(value):
    """Return what JSON can hold of a number of NumPy."""
    return value.tolist()
