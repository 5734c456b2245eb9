"""Crushing: a compression in LAMMPS in which overloaded grains break, led from Python."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from branchcrush.breakage.account import Account
from branchcrush.breakage.criterion import largest_force
from branchcrush.breakage.grains import Grains, exchange, first_grains
from branchcrush.breakage.rules import Breakage
from branchcrush.errors import SimulationError
from branchcrush.lammps.leading import led
from branchcrush.lammps.neighbours import neighbour_settings
from branchcrush.lammps.progress import Progress
from branchcrush.lammps.session import Ended, Session
from branchcrush.lammps.straining import Strained
from branchcrush.loading.states import force_floor
from branchcrush.packings.geometry import solid_volume

# Evaluations, and the unbalanced force ratio, up to which fragments settle between two stages.
_STAGE_EVALUATIONS, _STAGE_TOLERANCE = 100, 0.1


class Crushing(Strained):
    """A packing that is crushed: what LAMMPS has of it, its grains, and what was counted.

    Parameters
    ----------
    session : Session
        Set up, grains in it or not yet loaded.
    rules : Breakage
    grains : Grains
    seed : int
        Of the packing.
    progress : Progress
        Where states are kept.
    """

    def __init__(
        self, session: Session, rules: Breakage, grains: Grains, seed: int, progress: Progress
    ) -> None:
        super().__init__(session, rules, grains)
        self.seed, self.progress = seed, progress
        self.account = Account()
        self.settings: dict[str, Any] = {}

    def begin(self) -> None:
        """Approach, to where strain steps begin: states 0 and 1."""
        session = self.session
        session.include("begin")
        self._look()
        overloaded = int((self.overload >= 1.0).sum())
        if overloaded:
            raise SimulationError(
                f"{overloaded} grain(s) are overloaded at the end of the approach already, at a "
                f"mean stress of {session.read('mean_stress'):.3g} Pa: lower "
                "loading.approach_solid_fraction"
            )
        self.account = Account(stored=self.rest.elastic_energy)

    def load(self) -> None:
        """Go to the next target edge, and save a state there."""
        self.session.include("target")
        self._load()
        self.session.include("state")

    def keep(self, targets: int) -> None:
        """Keep the state that is reached with some number of targets."""
        self.progress.note_state(self, targets)

    def judge(self) -> None:
        """End the run where the stress that it is to reach is reached at a saved state."""
        largest = self.rules.largest_mean_stress
        # Not at the end of the approach, where every loading begins.
        if largest is None or self.session.read("state") <= 2:
            return
        if self.session.read("mean_stress") >= largest:
            raise Ended(f"the mean stress has reached largest_mean_stress {largest:g} Pa")

    def _load(self):
        """Take strain steps to a target, all grains at rest and none overloaded after each."""
        session = self.session
        while True:
            session.include("edge")
            edge = session.read("edge")
            saved = {name: session.read(name) for name in ("is_state", "tolerance")}
            # Each event on the way shortens what is left of the step.
            while self._strain(edge, saved):
                self._cascade()
            self._cascade(saved)
            session.set(**saved)
            session.include("step")
            if session.read("reached"):
                return

    def _strain(self, edge, saved):
        """Strain to an edge and come to rest; return whether a grain broke on the way there."""
        before, load, kept = self.session.edge, self._largest_overload, self._kept()
        self._strain_to(edge, **saved)
        reached, beyond = edge, self._largest_overload
        if self.rules.stepping == "events" and beyond > 1.0 + self.rules.event_tolerance:
            reached = self._first_event(kept, {before: load, edge: beyond})
        self._book(kept)
        return reached != edge

    def _book(self, kept):
        *_, edge, work, push = kept
        # The trapezoidal rule between two packings at rest: the work of dL is the virial dL/L.
        quasi_static = (push + self._push) / 2.0 * (edge - self.session.edge)
        self.account.strained(
            self.session.read("work") - work, self.rest.elastic_energy, quasi_static
        )

    def _cascade(self, saved=None):
        """Let grains break, round after round, until none is overloaded at rest."""
        breaks = self.overload >= 1.0
        while breaks.any():
            if self.rules.per_round == "one":
                breaks = np.arange(breaks.size) == int(np.argmax(self.overload))
            self._round(breaks)
            breaks = self.overload >= 1.0
            if saved and saved["is_state"] and not breaks.any():
                # A saved state is nearer to rest, where another grain may be overloaded.
                self.session.set(**saved)
                self._relax()
                self.account.relaxed(self.rest.elastic_energy)
                breaks = self.overload >= 1.0

    def _round(self, breaks):
        """Put fragments in the place of some grains, let them grow, and come to rest."""
        session, rules = self.session, self.rules
        number = self.grains.number[breaks]
        more = self.grains.number.size + number.size * (rules.fragments - 1)
        if more > rules.largest_grains:
            raise Ended(
                f"the next round of breakage would make {more} grains, more than largest_grains "
                f"{rules.largest_grains}"
            )
        parents = self._note(breaks)
        grains, change = exchange(self.grains, number, self.rest.position, self.seed, rules)
        settings = self._settings(grains)
        session.replace(grains, change, settings)
        self.grains, self.settings = grains, settings
        put_in, stored = 0.0, session.elastic_energy()
        exchanged = self.account.stored - stored
        session.set(is_state=0, tolerance=_STAGE_TOLERANCE, step_limit=_STAGE_EVALUATIONS)
        *stages, _ = rules.growth
        # The last one as it is kept, to the last digit.
        full = grains.radius[-change.number.size :]
        for radius in [*(factor * change.touching_radius for factor in stages), full]:
            session.set_radii(change.number, radius)
            put_in += session.elastic_energy() - stored
            session.include("mass")
            if radius is not full:
                session.include("relax")
                stored = session.elastic_energy()
        session.set(tolerance=rules.step_tolerance, step_limit=session.read("largest_relaxation"))
        self._relax()
        self.account.broken(
            self.rest.elastic_energy,
            parents=parents,
            exchanged=exchanged,
            put_in=put_in,
            breakages=number.size,
        )

    def _settings(self, grains):
        """Return the variables of in.compress that sizes decide."""
        edge, law = self.session.edge, self.session.law
        return {
            **neighbour_settings(grains.radius, edge),
            "force_floor": force_floor(grains.radius, law),
        }

    def _note(self, breaks):
        """Note the grains that break; return what is stored in their contacts [J]."""
        rest, grains = self.rest, self.grains
        own = breaks[rest.i] | breaks[rest.j]
        at_wall = breaks[rest.wall_grain]
        felt = rest.sides
        energy = np.concatenate([rest.energy, rest.energy, rest.wall_energy])
        held = np.bincount(felt.grain, energy, breaks.size)
        self.progress.note_breakages(
            number=grains.number[breaks],
            parent=grains.parent[breaks],
            generation=grains.generation[breaks],
            radius=grains.radius[breaks],
            position=rest.position[breaks],
            largest_force=largest_force(felt, grains.radius)[breaks],
            stress=self.overload[breaks] * grains.strength[breaks],
            strength=grains.strength[breaks],
            contacts=np.bincount(felt.grain, minlength=breaks.size)[breaks],
            energy=held[breaks],
            round=self.account.rounds + 1,
            step=int(self.session.read("step")),
            state=int(self.session.read("state")),
            solid_fraction=solid_volume(grains.radius) / self.session.edge**3,
        )
        return float(rest.energy[own].sum() + rest.wall_energy[at_wall].sum())


def crushing_task(lammps: Any, payload: Mapping[str, Any]) -> str:
    """Crush a packing in a LAMMPS instance: what `lammps.run.run_task` runs.

    Parameters
    ----------
    lammps : object
        Started with the variables of in.compress.
    payload : mapping
        folder, key: of the progress; inputs: of mod.setup; note: for the log.

    Returns
    -------
    str
        Why it ended before its last target; empty where it did not.
    """
    progress = Progress(Path(payload["folder"]), payload["key"])
    job = progress.job()
    session = Session(lammps, payload["inputs"], periodic=job.periodic, law=job.law)

    def begun():
        grains = first_grains(job.radii, job.seed, job.rules)
        crushing = Crushing(session, job.rules, grains, job.seed, progress)
        crushing.begin()
        return crushing

    def restored(saved):
        grains = progress.grains(saved)
        crushing = Crushing(session, job.rules, grains, job.seed, progress)
        crushing.account = Account(**saved.more["account"])
        crushing.settings = saved.settings
        return crushing

    try:
        led(session, progress, len(job.targets), begun, restored, payload["note"])
    except Ended as end:
        return str(end)
    return ""
