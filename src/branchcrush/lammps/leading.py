"""Leads a run of LAMMPS from state to state, each of them kept to go on from."""

from collections.abc import Callable
from typing import Protocol

from branchcrush.lammps.checkpoint import Checkpoint, Saved
from branchcrush.lammps.session import Session


class Run(Protocol):
    """A run that `led` leads from state to state."""

    def keep(self, targets: int) -> None:
        """Keep the state that is reached with some number of targets."""

    def load(self) -> None:
        """Go to the next target, and save a state there."""

    def judge(self) -> None:
        """End the run where its state asks for it."""


def led(
    session: Session,
    checkpoint: Checkpoint,
    targets: int,
    begun: Callable[[], Run],
    restored: Callable[[Saved], Run],
    note: str = "",
) -> None:
    """Lead a run from target to target, from the last state that was kept or from the beginning.

    Over several ranks each kept state is read again, in a run that was not stopped, too: which
    grains a rank has, and in which order, depends on all that was before.

    Parameters
    ----------
    session : Session
        Not set up.
    checkpoint : Checkpoint
    targets : int
        How many there are.
    begun : callable
        Returns a run at the end of the approach; LAMMPS is set up.
    restored : callable
        Returns a run at a saved state, with which LAMMPS is set up.
    note : str
        A line for the log.
    """
    if note:
        session.say(f"branchcrush: {note}")
    saved, run, done = checkpoint.saved(), None, 0
    if saved is None:
        session.include("setup")
        run = begun()
        run.keep(0)
    else:
        done = saved.targets
        session.say(f"branchcrush: continues from state {saved.state} of {targets + 1}")
        for _ in range(done - 1):
            session.command("next targets")
    while True:
        if run is None or session.ranks > 1:
            run = restored(checkpoint.restored(session))
        run.judge()
        if done == targets:
            return
        if done:
            session.command("next targets")
        run.load()
        done += 1
        run.keep(done)
