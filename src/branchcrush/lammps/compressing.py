"""A compression in LAMMPS, led from state to state: the loop of `in.compress`."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from branchcrush.lammps.checkpoint import Checkpoint
from branchcrush.lammps.leading import led
from branchcrush.lammps.session import Ended, Session


class Compressing:
    """A packing that is compressed.

    Parameters
    ----------
    session : Session
        Set up.
    checkpoint : Checkpoint
        Where states are kept.
    """

    def __init__(self, session: Session, checkpoint: Checkpoint) -> None:
        self.session, self.checkpoint = session, checkpoint

    def begin(self) -> None:
        """Approach, to where strain steps begin: states 0 and 1."""
        self.session.include("begin")

    def load(self) -> None:
        """Go to the next target, and save a state there."""
        self.session.include("load")

    def keep(self, targets: int) -> None:
        """Keep the state that is reached with some number of targets."""
        self.checkpoint.note(self.session, targets)

    def judge(self) -> None:
        """No state asks for an end."""


def compression_task(lammps: Any, payload: Mapping[str, Any]) -> str:
    """Compress a packing in a LAMMPS instance: what `lammps.run.run_task` runs.

    Parameters
    ----------
    lammps : object
        Started with the variables of in.compress.
    payload : mapping
        folder, key: of the checkpoint; inputs: of mod.setup; targets: how many; note: for the log.

    Returns
    -------
    str
        Why it ended before its last target; empty where it did not.
    """
    periodic = str(lammps.extract_variable("boundary")) == "periodic"
    session = Session(lammps, payload["inputs"], periodic=periodic)
    checkpoint = Checkpoint(Path(payload["folder"]), payload["key"])

    def begun():
        compressing = Compressing(session, checkpoint)
        compressing.begin()
        return compressing

    try:
        led(
            session,
            checkpoint,
            payload["targets"],
            begun,
            lambda saved: Compressing(session, checkpoint),
            payload["note"],
        )
    except Ended as end:
        return str(end)
    return ""
