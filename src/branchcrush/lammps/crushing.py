"""Crushing: a compression in LAMMPS in which overloaded grains break, led from Python."""

import contextlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import root_scalar

from branchcrush.breakage.account import Account
from branchcrush.breakage.criterion import CRITERIA, largest_force
from branchcrush.breakage.grains import Grains, exchange, first_grains
from branchcrush.breakage.rules import Breakage
from branchcrush.errors import SimulationError
from branchcrush.lammps.neighbours import neighbour_settings
from branchcrush.lammps.progress import Job, Progress, Saved
from branchcrush.lammps.session import Rest, Session
from branchcrush.loading.states import force_floor
from branchcrush.packings.geometry import solid_volume

# Evaluations, and the unbalanced force ratio, up to which fragments settle between two stages.
_STAGE_EVALUATIONS, _STAGE_TOLERANCE = 100, 0.1
# Of the search for the strain at which the next grain breaks, and how near it gets, over the strain
# step and the tolerance: nearer, the packing leaps past the strength of the grain.
_MOST_TRIALS, _SHORTEST = 50, 1.0e-2


class Ended(Exception):
    """A run ends before its last target, validly: the reason."""


class _Near(Exception):
    """A strain is found at which the first grain breaks."""


class Crushing:
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
        self.session, self.rules, self.grains, self.seed = session, rules, grains, seed
        self.progress = progress
        self.account = Account()
        self.settings: dict[str, Any] = {}
        # Of the grains at rest: the packing, and the stress of each over its strength.
        self.rest: Rest = session.rest()
        self.overload = self._overload()

    def begin(self) -> None:
        """Approach, to where strain steps begin: states 0 and 1."""
        session = self.session
        session.include("state")
        session.include("approach")
        if session.failure:
            raise Ended(session.failure)
        session.set(step_limit=session.read("largest_relaxation"), work=0.0)
        session.include("step")
        session.include("state")
        self._look()
        overloaded = int((self.overload >= 1.0).sum())
        if overloaded:
            raise SimulationError(
                f"{overloaded} grain(s) are overloaded at the end of the approach already, at a "
                f"mean stress of {session.read('mean_stress'):.3g} Pa: lower "
                "loading.approach_solid_fraction"
            )
        self.account = Account(stored=self.rest.elastic_energy)
        self.progress.note_state(self, targets=0)

    def go_on(self, targets: int, done: int) -> None:
        """Load to each target edge in turn, from where `done` of them are reached."""
        session = self.session
        for number in range(1, targets + 1):
            if number > done:
                session.include("target")
                self._load()
                session.include("state")
                self.progress.note_state(self, targets=number)
                self._end_at_stress()
            if number < targets:
                session.command("next targets")

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

    def _first_event(self, kept, loads):
        """Strain to where the first grain breaks, and return the edge there.

        `loads` holds the largest overload at both ends of the strain step, by edge.
        """
        before, end = loads
        tolerance = self.rules.event_tolerance

        def excess(edge):
            if edge not in loads:
                self._restore(kept)
                self._strain_to(edge, is_state=0, tolerance=self.rules.step_tolerance)
                loads[edge] = self._largest_overload
                if 1.0 <= loads[edge] <= 1.0 + tolerance:
                    raise _Near
            # A little above, where the grain does break.
            return loads[edge] - 1.0 - tolerance / 2.0

        # Where the packing leaps past the strength, there is no such place: it ends at the leap.
        shortest = _SHORTEST * tolerance * abs(end - before)
        with contextlib.suppress(_Near):
            root_scalar(excess, bracket=(before, end), xtol=shortest, maxiter=_MOST_TRIALS)
        found = min((edge for edge in loads if loads[edge] >= 1.0), key=lambda at: abs(at - before))
        if self.session.edge != found:
            self._restore(kept)
            self._strain_to(found, is_state=0, tolerance=self.rules.step_tolerance)
        return found

    @property
    def _largest_overload(self):
        return float(self.overload.max(initial=0.0))

    def _strain_to(self, edge, *, is_state, tolerance):
        session = self.session
        session.set_edge(edge)
        session.set(is_state=is_state, tolerance=tolerance)
        session.include("strain")
        self._relax()

    def _relax(self):
        self.session.include("relax")
        if self.session.failure:
            raise Ended(self.session.failure)
        self._look()

    def _look(self):
        self.rest = self.session.rest()
        self.overload = self._overload()

    def _overload(self):
        """Return the stress of each grain over its strength, 0 of those that never break."""
        breaks = 2.0 * self.grains.radius > self.rules.smallest_diameter
        return np.where(breaks, self.rest_stress / self.grains.strength, 0.0)

    @property
    def rest_stress(self) -> NDArray:
        """Stress that each grain feels, by the criterion [Pa]."""
        return CRITERIA[self.rules.criterion].stress(self.rest.sides, self.grains.radius)

    def _kept(self):
        """Return what a strain step is taken back to, and the force on the cell before it."""
        rest, session = self.rest, self.session
        return rest.number, rest.position, session.edge, session.read("work"), self._push

    def _restore(self, kept):
        """Take back a strain step: grains, cell and work."""
        number, position, edge, work, _ = kept
        session = self.session
        half = f"{edge / 2.0:.17g}"
        cell = " ".join(f"{axis} final -{half} {half}" for axis in "xyz")
        # In whichever order leaves no grain outside its cell on the way.
        larger = edge > session.edge
        for place in (larger, not larger):
            if place:
                session.command(f"change_box all {cell} units box")
            else:
                session.set_positions(number, position)
        if not session.periodic:
            session.include("walls")
        session.command("run 0 post no")
        session.include("mass")
        session.set_edge(edge)
        session.set(work=work)
        self._look()

    def _book(self, kept):
        *_, edge, work, push = kept
        # The trapezoidal rule between two packings at rest: the work of dL is the virial dL/L.
        quasi_static = (push + self._push) / 2.0 * (edge - self.session.edge)
        self.account.strained(
            self.session.read("work") - work, self.rest.elastic_energy, quasi_static
        )

    @property
    def _push(self):
        return self.session.read("virial") / self.session.edge

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

    def _end_at_stress(self):
        largest = self.rules.largest_mean_stress
        if largest is not None and self.session.read("mean_stress") >= largest:
            raise Ended(f"the mean stress has reached largest_mean_stress {largest:g} Pa")


def crushing_task(lammps: Any, payload: Mapping[str, Any]) -> str:
    """Crush a packing in a LAMMPS instance: what `lammps.run.run_task` runs.

    Parameters
    ----------
    lammps : object
        Started with the variables of in.compress.
    payload : mapping
        folder: of the progress; inputs: of mod.setup.

    Returns
    -------
    str
        Why it ended before its last target; empty where it did not.
    """
    progress = Progress(Path(payload["folder"]))
    job = progress.job()
    session = Session(lammps, payload["inputs"], periodic=job.periodic, law=job.law)
    session.include("setup")
    saved = progress.saved()
    try:
        if saved is None:
            grains = first_grains(job.radii, job.seed, job.rules)
            crushing = Crushing(session, job.rules, grains, job.seed, progress)
            crushing.begin()
            done = 0
        else:
            crushing = _restored(session, job, saved, progress)
            done = saved.targets
        crushing.go_on(len(job.targets), done)
    except Ended as end:
        return str(end)
    return ""


def _restored(session: Session, job: Job, saved: Saved, progress: Progress) -> Crushing:
    """Return the crushing as it was at a saved state, of which LAMMPS has read the grains."""
    session.set(**saved.scalars, step_limit=session.read("largest_relaxation"))
    session.set_edge(saved.edge)
    session.set(grains=saved.number.size)
    session.set_masses(saved.number, saved.mass)
    session.update()
    crushing = Crushing(session, job.rules, saved.grains, job.seed, progress)
    crushing.account, crushing.settings = saved.account, saved.settings
    return crushing
