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
from yade import (
    Bo1_Box_Aabb,
    Bo1_Sphere_Aabb,
    Bo1_Wall_Aabb,
    ForceResetter,
    FrictMat,
    GlobalStiffnessTimeStepper,
    Ig2_Box_Sphere_ScGeom,
    Ig2_Sphere_Sphere_ScGeom,
    Ig2_Wall_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_FrictMat_FrictMat_FrictPhys,
    Law2_ScGeom_FrictPhys_CundallStrack,
    MatchMaker,
    NewtonIntegrator,
    Omega,
    utils,
)

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
# Half the thickness of a wall over the edge: as a box, and not a plane, it pushes a fine grain
# back from whatever depth.
WALL = 0.25

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


class Packing:
    """Spheres in a cube about the origin, between six walls or periodic."""

    def __init__(self, positions, radii, edge, periodic, stiffness, path):
        self.edge, self.periodic = edge, periodic
        self.radii, self.stiffness = radii, stiffness
        material = omega.materials.append(FrictMat(frictionAngle=0.0))
        if periodic:
            omega.periodic = True
            omega.cell.setBox(edge, edge, edge)
        # No friction: no torque, and inertia does not matter.
        self.spheres = [
            utils.sphere(tuple(p), r, material=material)
            for p, r in zip(positions.tolist(), radii.tolist(), strict=True)
        ]
        omega.bodies.append(self.spheres)
        self.states = [sphere.state for sphere in self.spheres]
        if not path["turning"]:
            for state in self.states:
                state.blockedDOFs = "XYZ"
        self.walls = []
        self.planes = path["walls"] == "plane"
        self.half = 0.0 if self.planes else WALL * edge
        for axis in range(0 if periodic else 3):
            for side in (-1, 1):
                extents, centre = [edge] * 3, [0.0] * 3
                extents[axis] = self.half
                centre[axis] = side * (edge / 2.0 + self.half)
                if self.planes:
                    wall = utils.wall(centre[axis], axis, sense=-side, material=material)
                else:
                    wall = utils.box(centre, extents, fixed=True, material=material)
                omega.bodies.append(wall)
                self.walls.append((wall.state, axis, side))

    def engines(self, path):
        """Give the grains masses and a law, and YADE what it does in an iteration."""
        stiffness = self.stiffness
        # Nothing depends on the masses once the packing is at rest. With these, a grain of
        # stiffness 6 k/3 along an axis, which is one with six contacts, has a critical time step
        # of 1 s in YADE's own count, sqrt(2 m/K).
        for state in self.states:
            state.mass = stiffness
        # YADE takes the critical time step of a sphere without contacts from a sound wave in its
        # material. As masses are equal, each sphere needs a Young's modulus of its own to have the
        # same; nothing else reads it.
        for body, radius in zip(self.spheres, self.radii.tolist(), strict=True):
            young = 3.0 * stiffness / (4.0 * math.pi * radius * path["loose_time_step"] ** 2)
            body.material = FrictMat(young=young, frictionAngle=0.0)
        self.collider = InsertionSortCollider(
            [Bo1_Sphere_Aabb(), Bo1_Wall_Aabb() if self.planes else Bo1_Box_Aabb()],
            verletDist=path["verlet"] * float(np.mean(self.radii)),
            targetInterv=path["target_interval"],
            allowBiggerThanPeriod=True,
        )
        # The tangential stiffness is zero, so there is no tangential force and no friction to
        # limit it either.
        law = InteractionLoop(
            [
                # What keeps tangential forces exact is not needed where there are none.
                Ig2_Sphere_Sphere_ScGeom(avoidGranularRatcheting=False),
                Ig2_Wall_Sphere_ScGeom() if self.planes else Ig2_Box_Sphere_ScGeom(),
            ],
            [
                Ip2_FrictMat_FrictMat_FrictPhys(
                    kn=MatchMaker(algo="val", val=stiffness),
                    ks=MatchMaker(algo="val", val=0.0),
                    frictAngle=MatchMaker(algo="val", val=0.0),
                )
            ],
            [Law2_ScGeom_FrictPhys_CundallStrack()],
        )
        self.newton = NewtonIntegrator(damping=path["damping"])
        engines = [ForceResetter(), self.collider, law]
        omega.dt = path["time_step"]
        if path["masses"] == "scaled":
            self.newton.densityScaling = True
            omega.dt = 1.0
            engines.append(
                GlobalStiffnessTimeStepper(
                    timeStepUpdateInterval=path["mass_interval"],
                    timestepSafetyCoefficient=path["time_step"],
                    densityScaling=True,
                    targetDt=1.0,
                )
            )
        omega.engines = [*engines, self.newton]

    def scale(self, edge):
        """Scale cell, walls and centres, with the grains at rest."""
        factor = edge / self.edge
        self.edge = edge
        if self.periodic:
            omega.cell.hSize = omega.cell.hSize * factor
        for state in self.states:
            state.pos = state.pos * factor
        if self.planes:
            self._put_back()
        for wall, axis, side in self.walls:
            # The box keeps its thickness: its face has to be where the wall is.
            place = [0.0] * 3
            place[axis] = side * (edge / 2.0 + self.half)
            wall.pos = place
        utils.calm()
        # The collider asks NewtonIntegrator how far it moved the grains, which knows nothing of
        # this: zero makes it look anew.
        self.newton.maxVelocitySq = 0.0

    def _put_back(self):
        """Put grains whose centre is behind a plane in front of it."""
        most = 0.49999 * self.edge
        for state in self.states:
            if max(map(abs, state.pos)) > most:
                state.pos = [min(max(x, -most), most) for x in state.pos]

    def positions(self):
        """Return the centres [m], for a periodic cell those of the grain inside it."""
        places = np.array([tuple(state.pos) for state in self.states])
        return places - self.edge * np.round(places / self.edge) if self.periodic else places

    def outside(self):
        """Return how many centres are beyond a wall."""
        beyond = np.abs(self.positions()).max(axis=1) > self.edge / 2.0
        return 0 if self.periodic else int(beyond.sum())


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
