"""What logs tell: how far a packing is, and why a job failed."""

import os
import re
from dataclasses import dataclass
from os import PathLike

# As `lammps_inputs/mod.step` prints it after each strain step.
_STEP = re.compile(
    rb"^step \d+: state (\d+) of (\S+), .*?solid fraction (\S+), mean stress (\S+) Pa", re.MULTILINE
)
# A strain step may need many lines; what is older than this many bytes is not looked for.
_TAIL = 65536
_MESSAGE = "branchcrush: "


@dataclass(frozen=True)
class Progress:
    """How far along its path a packing is.

    Examples
    --------
    >>> print(Progress(7, "16", 0.652, 1.23e7))
    state 7 of 16, phi 0.652, 12.3 MPa
    """

    state: int  # that it is on its way to
    last_state: str
    solid_fraction: float  # [-]
    mean_stress: float  # [Pa]

    def __str__(self) -> str:
        return (
            f"state {self.state} of {self.last_state}, phi {self.solid_fraction:.3f}, "
            f"{stress_text(self.mean_stress)}"
        )


def stress_text(stress: float) -> str:
    """Return a stress with three digits and the unit that suits it.

    Parameters
    ----------
    stress : float
        [Pa]

    Returns
    -------
    str

    Examples
    --------
    >>> [stress_text(stress) for stress in (0.0, 313.2, 9.996e5, 5.88e7, 2e10)]
    ['0 Pa', '313 Pa', '1.00 MPa', '58.8 MPa', '20.0 GPa']
    """
    value, unit = stress, "Pa"
    for larger in ("kPa", "MPa", "GPa"):
        if abs(value) < 999.5:
            break
        value, unit = value / 1000.0, larger
    digits = 0 if unit == "Pa" or abs(value) >= 99.95 else 1 if abs(value) >= 9.995 else 2
    return f"{value:.{digits}f} {unit}"


def packing_progress(log: str | PathLike[str]) -> Progress | None:
    """Return how far the packing is whose compression writes a log.

    LAMMPS writes its log in blocks of some kB, so this is some strain steps behind.

    Parameters
    ----------
    log : path-like

    Returns
    -------
    Progress or None
        None before the first strain step.
    """
    steps = _STEP.findall(_tail(log))
    if not steps:
        return None
    state, last_state, solid_fraction, stress = (word.decode() for word in steps[-1])
    try:
        return Progress(int(state), last_state, float(solid_fraction), float(stress))
    except ValueError:
        return None


def log_mark(log: str | PathLike[str]) -> tuple[int, ...]:
    """Return what tells a log from one that is written in its place; empty where there is none.

    Parameters
    ----------
    log : path-like

    Returns
    -------
    tuple of int
    """
    try:
        status = os.stat(log)
    except OSError:
        return ()
    return status.st_ino, status.st_mtime_ns, status.st_size


def failure_message(log: str | PathLike[str]) -> str:
    """Return why the job of a log failed, as its end tells.

    Parameters
    ----------
    log : path-like

    Returns
    -------
    str
        The package's own message, or the last line of an error's trace; empty where neither is.
    """
    text = "\n" + _tail(log).decode("utf-8", "replace").rstrip()
    # A message may take several lines, of which only the first has this before it.
    message = text[text.rfind(f"\n{_MESSAGE}") :].removeprefix(f"\n{_MESSAGE}")
    is_message = f"\n{_MESSAGE}" in text and "Traceback (most recent call last)" not in message
    if is_message and not message.partition("\n")[0].endswith(" s inside LAMMPS"):
        return message
    last = text.rpartition("\n")[2]
    return last if re.match(r"[A-Za-z_.]+(Error|Exception|Interrupt|Exit)\b", last) else ""


def _tail(log: str | PathLike[str]) -> bytes:
    """Return the end of a file; nothing where it cannot be read."""
    try:
        with open(log, "rb") as file:
            size = file.seek(0, os.SEEK_END)
            file.seek(max(0, size - _TAIL))
            return file.read()
    except OSError:
        return b""
