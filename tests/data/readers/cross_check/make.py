"""One packing of this workflow, at rest in YADE and in LIGGGHTS as well, written by each of them.

    python tests/data/readers/cross_check/make.py

needs the Debian packages yade and liggghts; the tests read only what it wrote.
"""

import subprocess
import tempfile
from pathlib import Path

import numpy as np

from branchcrush.gradings.forms import uniform
from branchcrush.gradings.sampling import sampled_radii
from branchcrush.lammps.compression import compress, compression_variables
from branchcrush.lammps.files import write_data_file
from branchcrush.loading.targets import Loading
from branchcrush.packings.contact_laws import LinearContact
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing

HERE = Path(__file__).parent
ROOT = HERE.parents[3]
STIFFNESS = 1e6
GRAINS = 200


def main(folder: Path) -> None:
    """Compress a packing, and let both codes bring it to rest."""
    rng = np.random.default_rng(7)
    radii = sampled_radii(uniform(4e-4, 1e-3), GRAINS, "random", rng)
    edge = cube_edge(radii, 0.2)
    law = LinearContact(STIFFNESS)
    loading = Loading("solid_fraction", 0.7, states=2, approach_solid_fraction=0.5)
    variables = compression_variables(
        radii, 0.2, boundary="periodic", law=law, loading=loading, strain_step=2e-3
    )
    positions = random_packing(radii, edge, periodic=True, rng=rng)
    tables = compress(
        positions,
        radii,
        edge,
        variables,
        inputs=ROOT / "lammps_inputs",
        folder=folder,
        log=folder / "log.lammps",
        keep_dumps="none",
    )
    grains = np.column_stack([tables.compressed[name] for name in ("x_m", "y_m", "z_m")])
    last = cube_edge(radii, float(tables.path["solid_fraction"][-1]))
    np.savetxt(folder / "grains.txt", np.column_stack([grains, radii]), fmt="%.17g")
    end = tables.contacts["state"] == tables.path["state"][-1]
    np.savetxt(
        HERE / "lammps.csv",
        np.column_stack([tables.contacts[name][end] for name in ("i", "j", "normal_force_N")]),
        fmt=["%d", "%d", "%.9g"],
        delimiter=",",
        header="i,j,normal_force_N",
        comments="",
    )
    (HERE / "edge.txt").write_text(f"{last!r}\n")
    data = folder / "packing.data"
    write_data_file(data, grains, radii, last)
    text = data.read_text()
    # LIGGGHTS knows no comment after the word Atoms.
    data.write_text(
        text.replace("Atoms # sphere  (id type diameter density x y z)", "Atoms").replace(
            " 1.0 ", " 2500.0 ", GRAINS
        )
    )
    yade = ["yade", "-n", "-x", "-j1", HERE / "in_yade.py", str(last), HERE]
    subprocess.run(yade, cwd=folder, check=True)
    liggghts = ["liggghts", "-in", HERE / "in.liggghts", "-log", "none", "-var", "data", data]
    subprocess.run(liggghts, cwd=HERE, check=True)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        main(Path(scratch))
