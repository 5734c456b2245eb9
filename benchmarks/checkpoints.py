"""What it takes to keep a state and to read it again, and what reading it again changes.

A packing of each size is loaded to twelve states of quality `draft`, once as it is and once with
each state read again, as ranks do. Cheaper paths are not asked for, so the shares are the largest.
Times are processor time.
"""

import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from branchcrush.gradings.forms import uniform
from branchcrush.lammps.checkpoint import Checkpoint
from branchcrush.lammps.compression import compress, placed_packing, sample_variables
from branchcrush.lammps.session import Session
from branchcrush.loading.sample import Sample
from branchcrush.loading.targets import STATE_TOLERANCES, STRAIN_STEPS, Loading
from branchcrush.packings.contact_laws import LinearContact

INPUTS = Path(__file__).parents[1] / "lammps_inputs"
COMPARED = ("mean_stress", "virial")


def run(grains=(60, 300, 1000), solid_fraction=0.66):
    """Return what it takes for packings of some numbers of grains.

    Parameters
    ----------
    grains : sequence of int
    solid_fraction : float
        Of the last of twelve states; loaded, where it is above about 0.64.

    Returns
    -------
    dict
        `rows`: for each number of grains what the run takes (`run_s`), and of it to keep a state
        and to read it again (`keep_s`, `read_again_s`), and the share of the whole run
        (`share_kept`, `share_read_again`); `kept_states` of `states`, the others having taken too
        little time; how large what is kept of a state is (`state_MB`); the largest relative change
        of the stress by reading again (`largest_change`); whether the path is the same to the last
        digit (`same`).
    """
    return {"solid_fraction": solid_fraction, "rows": [_row(n, solid_fraction) for n in grains]}


def summary(result):
    """Return a line for each number of grains."""
    return [
        f"{row['grains']} grains, {row['run_s']:.1f} s: {row['kept_states']} of {row['states']} "
        f"states kept, in {1e3 * row['keep_s']:.1f} ms each ({row['share_kept']:.2%}); all read "
        f"again, in {1e3 * row['read_again_s']:.1f} ms each ({row['share_read_again']:.2%}); "
        f"{row['state_MB']:.2f} MB, changes {row['largest_change']:.1e}, same path: {row['same']}"
        for row in result["rows"]
    ]


def _row(grains, solid_fraction):
    sample = Sample(
        grading=uniform(5e-4, 1e-3),
        sampling="number_quantiles",
        grains=grains,
        boundary="walls",
        initial_solid_fraction=0.16,
        law=LinearContact(1e6),
        loading=Loading("solid_fraction", solid_fraction, states=10, approach_solid_fraction=0.55),
        strain_step=STRAIN_STEPS["draft"],
        state_tolerance=STATE_TOLERANCES["draft"],
    )
    packing = placed_packing(sample, np.random.default_rng(1))
    variables = sample_variables(sample, packing.radii)
    with _watched() as plain:
        one, seconds, _ = _compressed(packing, variables)
    with _watched(read_again=True) as again:
        other, _, size = _compressed(packing, variables)
    states = len(again["keep"])
    return {
        "grains": grains,
        "states": states,
        "kept_states": len(plain["keep"]),
        "run_s": seconds,
        "keep_s": sum(again["keep"]) / states,
        "share_kept": sum(plain["keep"]) / seconds,
        "read_again_s": sum(again["read"]) / states,
        "share_read_again": sum(again["read"]) / seconds,
        "state_MB": size / 1e6,
        "largest_change": max(again["changes"]),
        # As text: what is not known is NaN in both.
        "same": all(
            str(one.path[name].tolist()) == str(other.path[name].tolist()) for name in one.path
        ),
    }


def _compressed(packing, variables):
    with tempfile.TemporaryDirectory() as scratch:
        folder, kept = Path(scratch), Path(scratch, "kept")
        places = {"inputs": INPUTS, "folder": folder, "log": folder / "log", "checkpoint": kept}
        start = time.process_time()
        tables = compress(*packing, variables, **places)
        seconds = time.process_time() - start
        return tables, seconds, sum(path.stat().st_size for path in kept.glob("state.kept"))


@contextmanager
def _watched(read_again=False):
    """Measure how long states take to be kept and read, and read each again if asked for."""
    seen = {"keep": [], "read": [], "changes": []}
    note, restored, begin = Checkpoint.note, Checkpoint.restored, Session.__init__

    def timed_note(self, *given):
        start, since = time.process_time(), self._since
        note(self, *given)
        if self._since != since:
            seen["keep"].append(time.process_time() - start)

    def timed_restored(self, session):
        before = [session.read(name) for name in COMPARED]
        start = time.process_time()
        saved = restored(self, session)
        seen["read"].append(time.process_time() - start)
        after = [session.read(name) for name in COMPARED]
        seen["changes"] += [
            abs(new - old) / abs(old) if old else abs(new)
            for old, new in zip(before, after, strict=True)
        ]
        return saved

    def as_ranks(self, *given, **named):
        begin(self, *given, **named)
        self.ranks = 2

    Checkpoint.note, Checkpoint.restored = timed_note, timed_restored
    if read_again:
        Session.__init__ = as_ranks
    try:
        yield seen
    finally:
        Checkpoint.note, Checkpoint.restored, Session.__init__ = note, restored, begin
