"""What a crushing leaves at each saved state: all that is needed to go on from there."""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from branchcrush.breakage.account import Account
from branchcrush.breakage.grains import Grains
from branchcrush.breakage.rules import Breakage
from branchcrush.breakage.strength import Strength
from branchcrush.files.replacing import replacing
from branchcrush.packings.contact_laws import CONTACT_LAWS, HertzContact, LinearContact

# What LAMMPS appends to, state after state.
WRITTEN_ON = ("states.csv", "steps.csv", "particles.dump", "pairs.dump")
_STATE, _JOB = "state.npz", "job.npz"


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
    variables: dict[str, Any]  # of in.compress
    code: str = ""  # stands for the code that runs

    @property
    def law(self) -> LinearContact | HertzContact:
        """Contact law of the grains."""
        return CONTACT_LAWS[self.law_name].kind(self.stiffness)


@dataclass(frozen=True, eq=False)
class Saved:
    """A saved state."""

    targets: int  # how many are reached
    number: NDArray  # of the grains, in the order in which LAMMPS has them
    position: NDArray  # [m]
    radius: NDArray  # [m]
    mass: NDArray  # [kg]
    edge: float  # of the cell [m]
    scalars: dict[str, float]  # variables of in.compress, by name
    evaluations: int
    settings: dict[str, Any]  # variables of in.compress that sizes decide
    account: Account
    grains: Grains
    sizes: dict[str, int]  # of the files that LAMMPS appends to [bytes]


# Variables of in.compress that tell where a run is.
_SCALARS = ("work", "stopped", "state", "step", "kinetic_energy")


class Progress:
    """The folder in which a crushing keeps what it has reached."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._breakages: list[dict[str, NDArray]] = []

    def write_job(self, job: Job) -> None:
        """Write what is asked for."""
        plain = {name: value for name, value in asdict(job).items() if name != "radii"}
        _write(self.folder / _JOB, plain, {"radii": job.radii})

    def job(self) -> Job:
        """Return what is asked for."""
        plain, arrays = _read(self.folder / _JOB)
        rules = plain.pop("rules")
        strength = Strength(**rules.pop("strength"))
        return Job(radii=arrays["radii"], rules=Breakage(strength=strength, **rules), **plain)

    def is_of(self, job: Job) -> bool:
        """Return whether what is here belongs to a job."""
        try:
            there = self.job()
        except (OSError, ValueError, KeyError, TypeError):
            return False
        ours, theirs = asdict(job), asdict(there)
        return bool(np.array_equal(ours.pop("radii"), theirs.pop("radii"))) and (
            json.dumps(ours, sort_keys=True) == json.dumps(theirs, sort_keys=True)
        )

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
        session, grains = crushing.session, crushing.grains
        number, position, radius, mass = session.local_order()
        scalars = {name: session.read(name) for name in _SCALARS}
        state = int(scalars["state"]) - 1
        if session.first_rank:
            self._write_state(
                crushing, state, {
                    "targets": targets,
                    "edge": session.edge,
                    "scalars": scalars,
                    "evaluations": int(session.lammps.extract_global("ntimestep")),
                    "settings": crushing.settings,
                    "account": crushing.account.plain(),
                    "next_number": grains.next_number,
                    "sizes": {name: (self.folder / name).stat().st_size for name in WRITTEN_ON},
                },
                {"number": number, "position": position, "radius": radius, "mass": mass},
            )  # fmt: skip
        self._breakages = []

    def _write_state(self, crushing, state, plain, arrays):
        grains = crushing.grains
        columns = {
            "number": grains.number,
            "radius": grains.radius,
            "strength": grains.strength,
            "parent": grains.parent,
            "generation": grains.generation,
            "stress": crushing.rest_stress,
            "descent": np.array([n for line in grains.descent for n in line], dtype=int),
        }
        _write(self._of_state("grains", state), {}, columns)
        broken = {}
        if self._breakages:
            names = self._breakages[0]
            broken = {name: np.concatenate([part[name] for part in self._breakages])
                      for name in names}  # fmt: skip
        _write(self._of_state("breakages", state), {}, broken)
        # Last: where this one is, all others are.
        _write(self._of_state("account", state), {**plain["account"], **plain["scalars"]}, {})
        _write(self.folder / _STATE, {**plain, "last": state}, arrays)

    def _of_state(self, name, state):
        return self.folder / f"{name}_{state}.npz"

    def saved(self) -> Saved | None:
        """Return the last state that was kept; None where there is none."""
        try:
            plain, arrays = _read(self.folder / _STATE)
        except FileNotFoundError:
            return None
        _, columns = _read(self._of_state("grains", plain.pop("last")))
        lines = np.split(columns["descent"], np.cumsum(columns["generation"] + 1)[:-1])
        grains = Grains(
            *(columns[name] for name in ("number", "radius", "strength", "parent")),
            descent=[tuple(map(int, line)) for line in lines],
            next_number=plain.pop("next_number"),
        )
        account = Account(**plain.pop("account"))
        return Saved(account=account, grains=grains, **plain, **arrays)

    def cut(self, saved: Saved) -> None:
        """Cut off what was written after a state."""
        for name, size in saved.sizes.items():
            with open(self.folder / name, "r+b") as file:
                file.truncate(size)

    def table(self, name: str, states: int) -> tuple[list[Mapping], list[Mapping]]:
        """Return values and columns of `account`, `grains` or `breakages`, of each state."""
        read = [_read_or_none(self._of_state(name, state)) for state in range(states)]
        return [plain for plain, _ in read], [columns for _, columns in read]


def _write(path, plain, arrays):
    """Write values and arrays to one file, which takes an older one's place when it is whole."""
    text = np.frombuffer(json.dumps(plain).encode(), dtype=np.uint8)
    with replacing(path) as file:
        np.savez(file, plain=text, **arrays)


def _read(path):
    with np.load(path) as file:
        arrays = {name: file[name] for name in file.files}
    return json.loads(arrays.pop("plain").tobytes()), arrays


def _read_or_none(path):
    try:
        return _read(path)
    except FileNotFoundError:
        return {}, {}
