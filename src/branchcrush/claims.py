"""Who makes which result: a claim of each job on what it makes, for as long as it lives.

A claim is a locked file in `.branchcrush/claims` that tells who holds it. The kernel lets it go
when the job dies, whichever way, and a server of files when the machine of the job does.
"""

import contextlib
import json
import os
import sys
from collections.abc import Iterator
from datetime import datetime
from os import PathLike
from pathlib import Path
from typing import NamedTuple

from branchcrush.files.locks import is_locked, locked

CLAIMS = Path(".branchcrush", "claims")
# Jobs of a cluster are told by their number: what the scheduler sets, and what it is called.
_SCHEDULERS = {"SLURM_JOB_ID": "Slurm job", "PBS_JOBID": "PBS job", "LSB_JOBID": "LSF job"}


class Claim(NamedTuple):
    """Who makes a result."""

    result: str  # its path
    host: str
    process: int
    job: str  # of a cluster, as "Slurm job 17"; empty of others
    since: str

    def __str__(self) -> str:
        """Return it in words."""
        who = self.job or f"process {self.process}"
        return f"{self.result} ({who} on {self.host} since {self.since})"


@contextlib.contextmanager
def claimed(result: str | PathLike[str]) -> Iterator[bool]:
    """Have the making of a result to this process, after whoever has it now.

    Parameters
    ----------
    result : path-like
        From the folder that the study runs in.

    Yields
    ------
    bool
        Whether somebody had it, who may have made the result.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
    ...     with claimed("results/sand/seed_1/made.json"):
    ...         (claim,) = standing_claims()
    ...     claim.result, claim.process == os.getpid(), standing_claims()
    ('results/sand/seed_1/made.json', True, [])
    """
    path = CLAIMS / str(result).replace(os.sep, "+")
    path.parent.mkdir(parents=True, exist_ok=True)
    lock, had = locked(path)
    if not had:
        os.close(lock)
        holder = _read(path)
        sys.stderr.write(f"branchcrush: waits for {holder or result}, which is being made\n")
        lock, _ = locked(path, wait=True)
    try:
        os.truncate(lock, 0)
        claim = Claim(str(result), os.uname().nodename, os.getpid(), _job(), _now())
        os.pwrite(lock, json.dumps(claim._asdict()).encode(), 0)
        yield not had
    finally:
        path.unlink(missing_ok=True)
        os.close(lock)


def standing_claims() -> list[Claim]:
    """Return the claims in the working folder that somebody holds.

    Returns
    -------
    list of Claim
    """
    claims = []
    for path in sorted(CLAIMS.glob("*")):
        # Not of one that is about to be written: who writes it would find it locked.
        if _read(path) and is_locked(path) and (claim := _read(path)):
            claims.append(claim)
    return claims


def _read(path):
    """Return a claim, or None of one that is about to be written or given up."""
    try:
        return Claim(**json.loads(path.read_bytes()))
    except (OSError, ValueError, TypeError):
        return None


def _job():
    """Return which job of a cluster this is."""
    for variable, name in _SCHEDULERS.items():
        if variable in os.environ:
            return f"{name} {os.environ[variable]}"
    return ""


def _now():
    return datetime.now().astimezone().isoformat(sep=" ", timespec="seconds")
