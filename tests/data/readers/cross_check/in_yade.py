# ruff: noqa: F403, F405
"""A packing at rest in YADE, and what YADE writes of it."""

import sys

import numpy as np
from yade import *
from yade import export, utils

EDGE, FOLDER = float(sys.argv[1]), sys.argv[2]
O.materials.append(FrictMat(young=1e9, poisson=0.3, frictionAngle=0.0, density=2500.0))
O.periodic = True
O.cell.setBox(EDGE, EDGE, EDGE)
for x, y, z, radius in np.loadtxt("grains.txt"):
    O.bodies.append(utils.sphere((x, y, z), radius))
stiffness = MatchMaker(algo="val", val=1e6)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], allowBiggerThanPeriod=True),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_FrictPhys(kn=stiffness, ks=MatchMaker(algo="val", val=0.0))],
        [Law2_ScGeom_FrictPhys_CundallStrack()],
    ),
    NewtonIntegrator(damping=0.4),
]
O.dt = 2e-7
O.run(4000, True)
export.textExt(f"{FOLDER}/yade_spheres.txt", format="id_x_y_z_r_matId")
writer = export.VTKExporter(f"{FOLDER}/yade")
writer.exportSpheres(what={"radius": "b.shape.radius"})
writer.exportInteractions(what={"forceN": "i.phys.normalForce.norm()"})
with open(f"{FOLDER}/yade_interactions.csv", "w") as file:
    print("id1,id2,isReal,fx,fy,fz", file=file)
    for i in O.interactions.all():
        force = i.phys.normalForce if i.isReal else Vector3.Zero
        print(i.id1, i.id2, int(i.isReal), *(f"{each:.6g}" for each in force), sep=",", file=file)
