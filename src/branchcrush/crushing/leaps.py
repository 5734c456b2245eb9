"""Where crushing goes on by itself: loads that the next C does not hold."""

from typing import NamedTuple

import numpy as np

from branchcrush.crushing.yield_line import YieldLine

# Rise of a load that is rounding, and a leap of C that is not worth telling.
_NOTHING, _SMALL = 1e-12, 1e-3


class Leap(NamedTuple):
    """C goes on by itself at one load."""

    crushing: float  # C before [-]
    crushing_after: float  # C after; where no C holds the load the last that is known [-]
    load: float  # total strain [-] or stress [Pa]


def load_leaps(line: YieldLine, largest: float) -> list[Leap]:
    """Return where a load that rises makes C go on by itself, by 0.001 or more.

    They are the jumps of `evolve`, found without a history.

    Parameters
    ----------
    line : YieldLine
        Of a strain or of a stress.
    largest : float
        The largest elastic strain that the law is meant for [-]; the line is followed up to it.

    Returns
    -------
    list of Leap
    """
    elastic = line.resistance.yield_strain(line.looks, line.form, line.elasticity)
    beyond = np.flatnonzero(~(elastic <= largest))
    known = beyond[0] if beyond.size else line.looks.size
    looks, loads = line.looks[:known], line.loads[:known]
    # What does not rise falls as well: there a load leaves open how far C goes.
    falls = np.zeros(loads.size, dtype=bool)
    falls[1:] = loads[1:] <= np.maximum.accumulate(loads)[:-1] * (1.0 + _NOTHING)
    begins = np.flatnonzero(falls[1:] & ~falls[:-1]) + 1
    leaps = []
    for begin in begins.tolist():
        top = line.top(float(looks[max(begin - 2, 0)]), float(looks[begin]))
        load = float(line.load_at(top))
        if load <= loads[begin - 1] * (1.0 + _NOTHING):  # no peak between two looks
            top, load = float(looks[begin - 1]), float(loads[begin - 1])
        holds = np.flatnonzero(~falls[begin:])
        if holds.size:
            high = begin + holds[0]
            after = line.holding(load, float(looks[high - 1]), float(looks[high]))
        else:
            after = float(looks[-1])
        leaps.append(Leap(top, after, load))
    return [leap for leap in leaps if leap.crushing_after - leap.crushing > _SMALL]
