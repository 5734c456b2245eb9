"""Compress a packing of frictionless spheres isotropically with YADE.

yade -n -x -j1 yade_compress.py case.json output.json

The same task as `lammps_inputs/in.compress`, written as YADE does it best (README.md tells what was
tried): the packing is scaled step by step, and relaxes after each. `case.json`:

packing             npz with positions and radii, or csv with x,y,z,radius: about the centre [m];
                    a path that is not absolute is relative to the folder of case.json
edge, final_edge    of the cube [m]; without a difference the packing only relaxes
boundary            walls or periodic
normal_stiffness    of every contact [N/m]
state_tolerance     mean net force over mean contact force at the end
path                any of the keys of PATH, otherwise as there
largest_iterations  optional: give up after so many, and report where it is

Writes output.json and, beside it, output.npz with positions and radii in the order of the packing.
"""

import json
import math
import sys
import time
from pathlib import Path

import numpy as np
import yade.config
from yade import Omega, utils

# Run by YADE, which neither looks beside a script nor gives it a __file__ of its own.
sys.path.insert(0, str(Path(sys.argv[0]).resolve().parent))
from yade_packing import Packing

PATH = {
    # Linear strain of a step, before and after the solid fraction where grains begin to carry load.
    "approach_step": 4e-2,
    "strain_step": 1e-2,
    "approach_solid_fraction": 0.55,
    # Unbalanced force ratio that ends the relaxation of a step, or so many iterations.
    "step_tolerance": 1e-2,
    "largest_approach_iterations": 20,
    "largest_step_iterations": 20,
    # How the packing comes to rest: `local` is Cundall's damping; `kinetic` also stops all grains
    # whenever their kinetic energy has passed a peak.
    "relaxation": "kinetic",
    "damping": 0.2,
    "check_every": 10,
    # Masses: `equal`; or `scaled`, where YADE lowers what a grain of many contacts is accelerated.
    "masses": "scaled",
    "mass_interval": 20,
    # Of a grain without contacts, which may find many of them before its mass is looked at again:
    # its critical time step over the one that is used.
    "loose_time_step": 0.5,
    # Over the critical one: of a grain with six contacts for equal masses, of each if scaled.
    "time_step": 0.8,
    # By how much the collider enlarges the grains, over their mean radius, and in how many
    # iterations a grain should use it up.
    "verlet": 0.3,
    "target_interval": -1,
    # Tricks: walls as `box` or, cheaper to meet, as `plane`, which a fine grain can be pressed
    # through, so that it has to be put back; grains that nothing turns, kept from turning.
    "walls": "box",
    "turning": True,
}
omega = Omega()


def main(case_file, output_file):
    """Compress the packing of one case."""
    started = time.perf_counter(), time.process_time()
    case = json.loads(Path(case_file).read_text())
    unknown = set(case.get("path", {})) - set(PATH)
    if unknown:
        raise SystemExit(f"no such settings of the path: {sorted(unknown)}")
    path = {**PATH, **case.get("path", {})}
    positions, radii = read_packing(Path(case_file).parent / case["packing"])
    periodic = case["boundary"] == "periodic"
    packing = Packing(positions, radii, case["edge"], periodic, case["normal_stiffness"], path)
    packing.engines(path)
    prepared = time.perf_counter(), time.process_time()

    run = Compression(packing, path, case.get("largest_iterations", math.inf))
    reached = run.compress(case["final_edge"], case["state_tolerance"])
    looped = time.perf_counter(), time.process_time()

    output_file = Path(output_file)
    np.savez(
        output_file.with_suffix(".npz"),
        positions=packing.positions(),
        radii=radii,
        box=np.full(3, packing.edge),
    )
    ended = time.perf_counter(), time.process_time()
    seconds = {
        "seconds_total": ended[0] - started[0],
        "seconds_total_cpu": ended[1] - started[1],
        "seconds_loop": looped[0] - prepared[0],
        "seconds_loop_cpu": looped[1] - prepared[1],
        # Parts of the loop: Python that scales the packing, and the first iteration, in which the
        # collider sorts all grains.
        "seconds_strain": run.seconds_strain,
        "seconds_first_iteration": run.seconds_first,
    }
    result = {
        **seconds,
        "iterations": run.iterations,
        "iterations_of_last_step": run.iterations_last,
        "strain_steps": run.steps,
        "collisions_detected": packing.collider.numAction,
        "reached": reached,
        "unbalanced_force_ratio": utils.unbalancedForce(),
        "edge": packing.edge,
        "outside": packing.outside(),
        "path": path,
        "version": f"YADE {yade.config.version}",
        "threads": omega.numThreads,
    }
    output_file.write_text(json.dumps(result, indent=2) + "\n")


def read_packing(path):
    """Return centres (N, 3) and radii (N,) [m]."""
    if path.suffix == ".npz":
        with np.load(path) as file:
            return file["positions"], file["radii"]
    table = np.loadtxt(path, delimiter=",", skiprows=1)
    return table[:, :3], table[:, 3]


class Compression:
    """Strain steps and relaxation, with a count of what they cost."""

    def __init__(self, packing, path, largest_iterations):
        self.packing, self.path, self.left = packing, path, largest_iterations
        self.iterations = self.iterations_last = self.steps = 0
        self.seconds_strain = self.seconds_first = 0.0
        # Mean grains pressed together by 1e-4 of their radius, as in branchcrush.
        mean = float(np.mean(packing.radii))
        self.stress_floor = 1e-4 * packing.stiffness / (math.pi * mean)

    def compress(self, final_edge, tolerance):
        """Go to an edge, come to rest there, and return whether that was reached."""
        path, packing = self.path, self.packing
        solid = 4.0 / 3.0 * math.pi * float(np.sum(packing.radii**3))
        loose_edge = math.cbrt(solid / path["approach_solid_fraction"])
        middle = min(max(loose_edge, final_edge), packing.edge)
        started = time.process_time()
        self._iterate(1)
        self.seconds_first = time.process_time() - started
        for target, size, most in (
            (middle, path["approach_step"], path["largest_approach_iterations"]),
            (final_edge, path["strain_step"], path["largest_step_iterations"]),
        ):
            first = packing.edge
            count = math.ceil(abs(math.log(target / first)) / size - 1e-6)
            for n in range(1, count + 1):
                started = time.process_time()
                packing.scale(first + (target - first) * n / count)
                self.seconds_strain += time.process_time() - started
                self.steps += 1
                if n < count or target > final_edge:
                    self._relax(path["step_tolerance"], most)
                if self.left <= 0:
                    return False
        before = self.iterations
        reached = self._relax(tolerance, math.inf)
        # The last iteration has moved the grains on from where their forces were: judge them at
        # rest, as the positions that are handed over will be.
        while reached:
            utils.calm()
            self._iterate(1)
            if self._unbalanced(tolerance) <= tolerance:
                break
            reached = self._relax(tolerance / 2.0, math.inf)
        self.iterations_last = self.iterations - before
        return reached

    def _relax(self, tolerance, most):
        """Iterate to a tolerance and return whether it was reached."""
        kinetic = self.path["relaxation"] == "kinetic"
        last, end = 0.0, self.iterations + most
        while self.left > 0 and self.iterations < end:
            self._iterate(min(self.path["check_every"], self.left))
            if self._unbalanced(tolerance) <= tolerance:
                return True
            if kinetic:
                energy = utils.kineticEnergy()
                if energy < last:
                    utils.calm()
                    energy = 0.0
                last = energy
        return False

    def _unbalanced(self, tolerance):
        ratio = utils.unbalancedForce()
        if ratio <= tolerance:
            return ratio
        # A packing that carries no load has nothing to relax to: below a stress floor the net
        # force is compared with what makes that stress. Without contacts the ratio is not finite.
        stress = abs(utils.getStress(self.packing.edge**3).trace()) / 3.0
        return ratio * min(stress / self.stress_floor, 1.0) if stress > 0.0 else 0.0

    def _iterate(self, count):
        # Not omega.run(count, wait=True), which looks only every 40 ms whether it has ended.
        for _ in range(count):
            omega.step()
        self.iterations += count
        self.left -= count


main(*sys.argv[1:])
