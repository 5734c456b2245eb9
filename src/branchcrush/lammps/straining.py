"""A packing that is strained in LAMMPS, and how near its grains at rest are to breaking."""

import contextlib

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import root_scalar

from branchcrush.breakage.criterion import CRITERIA
from branchcrush.breakage.grains import Grains
from branchcrush.breakage.rules import Breakage
from branchcrush.lammps.session import Rest, Session

# Of the search for the strain at which the next grain breaks, and how near it gets, over the strain
# step and the tolerance: nearer, the packing leaps past the strength of the grain.
_MOST_TRIALS, _SHORTEST = 50, 1.0e-2


class _Near(Exception):
    """A strain is found at which the first grain breaks."""


class Strained:
    """A packing that is strained and comes to rest, and whose strain steps can be taken back.

    Parameters
    ----------
    session : Session
        Set up, grains in it or not yet loaded.
    rules : Breakage
    grains : Grains
    """

    def __init__(self, session: Session, rules: Breakage, grains: Grains) -> None:
        self.session, self.rules, self.grains = session, rules, grains
        # Of the grains at rest: the packing, and the stress of each over its strength.
        self.rest: Rest = session.rest()
        self.overload = self._overload()

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

    @property
    def _push(self):
        return self.session.read("virial") / self.session.edge

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
