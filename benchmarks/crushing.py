"""What a crushing takes: 500 grains of 0.8 to 1.2 mm, b = 1, until there are some 13 500.

Once with saved states as near to rest as those of the workflow, once with states saved as they are
when grains are judged. Beside it the packing whose grains do not break in the same strain steps,
each relaxed as far, for the cost of a force evaluation and grain; and the share of the time that
is not LAMMPS's.
"""

import tempfile
import time
from pathlib import Path

import numpy as np

from branchcrush.breakage.rules import Breakage
from branchcrush.breakage.strength import Strength
from branchcrush.lammps import session
from branchcrush.lammps.compression import Packing, compression_variables
from branchcrush.lammps.crush import crush
from branchcrush.loading.targets import Loading
from branchcrush.packings.contact_laws import LinearContact
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing

INPUTS = Path(__file__).resolve().parents[1] / "lammps_inputs"


def run(grains=500, solid_fraction=0.763, states=39, strain_step=2e-3, seed=1):
    """Return what a crushing takes, and what its LAMMPS takes of that.

    Parameters
    ----------
    grains : int
        Of the first packing.
    solid_fraction : float
        At its end [-].
    states : int
        Saved on the way.
    strain_step : float
        [-]
    seed : int

    Returns
    -------
    dict
        `as_judged`, `crushed` and `control`: `cpu_s`, `inside_cpu_s` within commands of LAMMPS,
        `outside_share` that is not, `evaluations`, `grain_evaluations` (over the path, grains of
        each state), `ns_per_grain_and_evaluation`, `grains`, `breakages`, `rounds`; `cost_ratio`,
        of an evaluation and grain of the second over the control's.
    """
    rng = np.random.default_rng(seed)
    radii = rng.uniform(0.4e-3, 0.6e-3, grains)
    edge = cube_edge(radii, 0.2)
    packing = Packing(random_packing(radii, edge, periodic=True, rng=rng), radii, edge)
    loading = Loading("solid_fraction", solid_fraction, states=states, approach_solid_fraction=0.6)

    def timed(strength, tolerance):
        variables = compression_variables(
            radii, 0.2, boundary="periodic", law=LinearContact(1e6), loading=loading,
            strain_step=strain_step, state_tolerance=tolerance,
        )  # fmt: skip
        return _timed(packing, variables, strength, seed)

    results = {
        "as_judged": timed(2e7, Breakage.step_tolerance),
        "crushed": timed(2e7, 1e-6),
        "control": timed(np.inf, 1e-6),
    }
    of_each, of_control = (
        results[name]["ns_per_grain_and_evaluation"] for name in ("crushed", "control")
    )
    return {**results, "cost_ratio": of_each / of_control}


def summary(result):
    """Return in words what came of it."""
    lines = [
        f"{words}: {one['grains']} grains, {one['breakages']} breakages, {one['rounds']} rounds, "
        f"{one['evaluations']} evaluations: {one['cpu_s']:.0f} CPU s, "
        f"{100 * one['outside_share']:.1f} % of it outside LAMMPS"
        for words, one in (
            ("states as grains are judged", result["as_judged"]),
            ("states at rest", result["crushed"]),
        )
    ]
    return [
        *lines,
        f"{result['crushed']['ns_per_grain_and_evaluation']:.0f} ns a grain and evaluation, "
        f"{result['cost_ratio']:.2f} times that of grains that do not break",
    ]


def _timed(packing, variables, strength, seed):
    """Crush a packing, with the time within commands of LAMMPS."""
    inside = []
    begun = session.Session.__init__

    def watched(self, *arguments, **others):
        begun(self, *arguments, **others)
        command = self.command

        def timed(text):
            start = time.process_time()
            command(text)
            inside.append(time.process_time() - start)

        self.command = timed

    rules = Breakage(
        strength=Strength(
            strength=strength, weibull_modulus=3.0, reference_diameter=1e-3, size_exponent=1.0
        ),
        smallest_diameter=2.5e-4,
    )
    session.Session.__init__ = watched
    try:
        with tempfile.TemporaryDirectory(prefix="branchcrush-") as folder:
            start = time.process_time()
            tables = crush(
                *packing, variables, rules, seed=seed, inputs=INPUTS, folder=folder,
                log=Path(folder, "log"), keep_dumps="none",
            )  # fmt: skip
            cpu = time.process_time() - start
    finally:
        session.Session.__init__ = begun
    path = tables.path
    steps = np.diff(path["force_evaluations"].astype(float))
    work = float(steps @ path["grains"][1:])
    return {
        "cpu_s": cpu,
        "inside_cpu_s": sum(inside),
        "outside_share": 1.0 - sum(inside) / cpu,
        "evaluations": int(path["force_evaluations"][-1]),
        "grain_evaluations": work,
        "ns_per_grain_and_evaluation": 1e9 * cpu / work,
        **{name: int(path[name][-1]) for name in ("grains", "breakages", "rounds")},
    }
