"""What the notes of a certificate were found to change: one table, quoted by every note.

Measured by `make quality`, which writes the same numbers to docs/results/note_effects.csv;
docs/quality.md says how.
"""

from typing import NamedTuple

MEASURED = "2026-11-28"


class Effect(NamedTuple):
    """What a note changes, with the standard error of each number over packings."""

    check: str
    level: float  # overlap at 95 % of the contacts [-], or largest diameters in the cell [-]
    measured_on: str
    stress: tuple[float, float]  # mean stress [%]
    energy: tuple[float, float]  # elastic energy per volume [%]
    exponent: tuple[float, float]  # n [-]


EFFECTS = (
    Effect(
        "overlaps",
        0.05,
        "uniform 200, walls, linear",
        (2.4, 0.1),
        (4.4, 0.1),
        (0.0, 0.0),
    ),
    Effect(
        "overlaps",
        0.1,
        "uniform 200, walls, linear",
        (6.3, 0.1),
        (11.4, 0.1),
        (0.01, 0.0),
    ),
    Effect(
        "overlaps",
        0.15,
        "uniform 200, walls, linear",
        (12.1, 0.2),
        (22.0, 0.4),
        (0.02, 0.0),
    ),
    Effect(
        "few grains",
        3.1,
        "uniform 200, walls, linear",
        (12.0, 1.1),
        (51.4, 2.5),
        (0.04, 0.16),
    ),
    Effect(
        "few grains",
        3.1,
        "uniform 200, periodic, linear",
        (1.8, 1.6),
        (4.0, 3.3),
        (0.1, 0.16),
    ),
    Effect(
        "convergence",
        0,
        "standard against fine, three gradings",
        (-0.8, 0.4),
        (-0.6, 0.7),
        (0.01, 0.05),
    ),
)


def effect_of(check: str, value: float) -> str:
    """Return what a note of a check is likely to change, in words.

    Parameters
    ----------
    check : str
        Of `EFFECTS`.
    value : float
        What the check found; the effect told is of the next level that was measured, or of the
        last.

    Returns
    -------
    str
    """
    rows = [row for row in EFFECTS if row.check == check]
    levels = sorted({row.level for row in rows})
    level = next((known for known in levels if known >= value), levels[-1])
    measured = "; ".join(_words(row) for row in rows if row.level == level)
    beyond = f"; {_BEYOND[check]}" if _is_beyond(check, value, levels) else ""
    return f"{_BASIS[check].format(level=level)} {measured} ({MEASURED}){beyond}"


def _is_beyond(check, value, levels):
    return value < levels[0] if check == "few grains" else value > levels[-1]


_BASIS = {
    "overlaps": (
        "the solid fraction counts overlaps twice; at an equal one of the volume filled, at "
        "{level:.0%} of the radius,"
    ),
    "few grains": "a cell of {level:g} diameters beside one of 5:",
    "convergence": "standard strain steps beside a quarter of them:",
}
# What is said where a check found more than was measured.
_BEYOND = {
    "overlaps": "deeper ones were not measured and change more",
    "few grains": "narrower ones were not measured and may change more",
    "convergence": "",
}


def _words(row):
    numbers = [
        f"mean stress {row.stress[0]:+.1f} ± {row.stress[1]:.1f} %",
        f"energy {row.energy[0]:+.1f} ± {row.energy[1]:.1f} %",
        f"n {row.exponent[0]:+.2f} ± {row.exponent[1]:.2f}",
    ]
    return f"{', '.join(numbers)}, measured on {row.measured_on}"
