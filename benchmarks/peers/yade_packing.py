"""A packing in YADE: its spheres and walls, and the engines that move them."""

import math

import numpy as np
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

# Half the thickness of a wall over the edge: as a box, and not a plane, it pushes a fine grain
# back from whatever depth.
WALL = 0.25

omega = Omega()


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
