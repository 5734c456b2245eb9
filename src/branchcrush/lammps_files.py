"""LAMMPS data and dump files: written for, and read back from, `lammps_inputs/in.compress`."""

import gzip

import numpy as np
import pandas as pd

PARTICLE_COLUMNS = ("id", "type", "radius", "x", "y", "z", "fx", "fy", "fz")
WALL_COLUMNS = ("v_wall_fx", "v_wall_fy", "v_wall_fz")


def write_data_file(path, positions, radii, edge):
    """Write a packing as a LAMMPS data file of atom style sphere; ids count from 1.

    Parameters
    ----------
    path : path-like
    positions : array_like, shape (N, 3)
        Centres, origin at the centre of the cube [m].
    radii : array_like, shape (N,)
        [m]
    edge : float
        Edge of the cube [m].
    """
    half = float(edge) / 2.0
    lines = ["branchcrush packing, SI units", "", f"{len(radii)} atoms", "1 atom types", ""]
    lines += [f"{-half!r} {half!r} {axis}lo {axis}hi" for axis in "xyz"]
    # The density only fills its column: the grain mass is set by mod.contact.
    lines += ["", "Atoms # sphere  (id type diameter density x y z)", ""]
    for n, (radius, place) in enumerate(zip(radii, positions, strict=True), start=1):
        x, y, z = (repr(float(value)) for value in place)
        lines.append(f"{n} 1 {2.0 * float(radius)!r} 1.0 {x} {y} {z}")
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")


def read_dump(path):
    """Return the frames of a LAMMPS text dump of atoms or of local data, one table a frame.

    Parameters
    ----------
    path : path-like
        Plain or gzipped.

    Returns
    -------
    list of pandas.DataFrame
        Columns as named in the dump; numbers as floats.
    """
    opener = gzip.open if str(path).endswith(".gz") else open
    with opener(path, "rt", encoding="ascii") as file:
        _, *frames = file.read().split("ITEM: TIMESTEP\n")
    return [_frame(text) for text in frames]


def _frame(text):
    # The last header line names the columns: "ITEM: ATOMS id type ..." or "ITEM: CONTACTS ...".
    start = text.rindex("ITEM: ")
    header, _, body = text[start:].partition("\n")
    columns = header.split()[2:]
    values = np.array(body.split(), dtype=float)
    return pd.DataFrame(values.reshape(-1, len(columns)), columns=columns)
