"""The compression of a packing in LAMMPS: the only module that runs a simulation."""

import contextlib
import ctypes
import re
import shutil
import signal
import sys
import tempfile
from pathlib import Path

import numpy as np
import pandas as pd

from branchcrush.errors import SimulationError
from branchcrush.lammps_files import read_dump, write_data_file
from branchcrush.lammps_library import load_lammps
from branchcrush.loading_path import (
    check_state,
    force_floor,
    path_row,
    state_contacts,
    wall_contacts,
)
from branchcrush.packing import cube_edge

# Skin of the neighbour list over the largest radius: grains move little once they touch.
_SKIN = 0.1
_DUMPS = ("particles.dump.gz", "pairs.dump.gz")


def compression_variables(
    radii,
    edge,
    *,
    boundary,
    normal_stiffness,
    edge_reduction,
    approach_solid_fraction,
    steps,
    states,
    unbalanced_force_ratio,
):
    """Return the variables of `in.compress` for a packing and its loading.

    Parameters
    ----------
    radii : array_like, shape (N,)
        [m]
    edge : float
        Edge of the cube before loading [m].
    boundary : {"walls", "periodic"}
    normal_stiffness : float
        [N/m]
    edge_reduction : float
        Linear strain at the end of the path [-].
    approach_solid_fraction : float
        Where single strain steps begin, before contact percolates [-].
    steps, states : int
        Strain steps from there, and how many of them are saved.
    unbalanced_force_ratio : float
        Of a saved state [-].

    Returns
    -------
    dict

    Raises
    ------
    SimulationError
        When the largest grain is larger than the final cell.

    Examples
    --------
    >>> loading = dict(edge_reduction=0.4, approach_solid_fraction=0.3, steps=10, states=5)
    >>> variables = compression_variables(
    ...     [1e-3] * 8, 6e-3, boundary="walls", normal_stiffness=1e6,
    ...     unbalanced_force_ratio=1e-6, **loading)
    >>> variables["steps_per_state"], variables["final_edge"]
    (2, 0.0036)
    """
    final_edge, largest = float(edge) * (1.0 - edge_reduction), 2.0 * float(np.max(radii))
    if final_edge < largest:
        raise SimulationError(
            f"the cell ends at an edge of {final_edge:.4g} m, smaller than the largest grain of "
            f"{largest:.4g} m: use more grains or a smaller edge_reduction"
        )
    return {
        "boundary": boundary,
        "normal_stiffness": float(normal_stiffness),
        "approach_edge": cube_edge(radii, approach_solid_fraction),
        "final_edge": final_edge,
        "steps": steps,
        "steps_per_state": steps // states,
        "state_tolerance": unbalanced_force_ratio,
        "force_floor": force_floor(radii, normal_stiffness),
        "skin": _SKIN * float(np.max(radii)),
    }


def compress(positions, radii, edge, variables, *, inputs, folder, log):
    """Compress a packing in LAMMPS and return its loading path and contacts.

    Runs `in.compress`; its dumps are moved into the folder when the run is complete.

    Parameters
    ----------
    positions : ndarray, shape (N, 3)
        Origin at the centre of the cube [m].
    radii : ndarray, shape (N,)
        [m]
    edge : float
        [m]
    variables : dict
        From `compression_variables`; any other variable of in.compress may be set as well.
    inputs : path-like
        The folder of in.compress.
    folder : path-like
        Where the dumps go.
    log : path-like
        Where LAMMPS logs, a progress line each strain step.

    Returns
    -------
    path : DataFrame
        A row for each state, as `loading_path.path_row`.
    contacts, walls : DataFrame
        A row for each contact and state, as `loading_path.state_contacts` and `wall_contacts`.

    Raises
    ------
    SimulationError
        When LAMMPS stops, a grain escapes, a state does not come to rest, a number is not
        finite, or a saved state fails its checks.
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder, prefix=".compress-") as scratch:
        scratch = Path(scratch)
        write_data_file(scratch / "packing.data", positions, radii, edge)
        _run_script(
            Path(inputs),
            {
                **variables,
                "data": scratch / "packing.data",
                "inputs": Path(inputs),
                "output_folder": scratch,
                "quit_on_failure": "no",
            },
            log,
        )
        tables = _read_states(scratch, variables)
        for name in _DUMPS:
            shutil.move(scratch / name, folder / name)
    return tables


def declared_variables(script):
    """Return the names of the variables a LAMMPS script declares with a default of style index.

    Parameters
    ----------
    script : path-like

    Returns
    -------
    set of str
    """
    return set(re.findall(r"^variable\s+(\w+)\s+index\s", Path(script).read_text(), re.MULTILINE))


def _run_script(inputs, variables, log):
    # LAMMPS ignores a misspelt -var silently.
    unknown = set(variables) - declared_variables(inputs / "in.compress")
    if unknown:
        raise SimulationError(f"in.compress declares no variable {', '.join(sorted(unknown))}")
    arguments = ["-nocite", "-screen", "none", "-log", str(log)]
    for name, value in variables.items():
        arguments += ["-var", name, _text(value)]
    lammps = None
    try:
        lammps = load_lammps()(cmdargs=arguments)
        with _interruptible():
            lammps.file(str(inputs / "in.compress"))
        if int(lammps.extract_variable("failed")):
            edge = float(lammps.extract_variable("edge"))
            reason = lammps.extract_variable("failure")
            raise SimulationError(f"compression stopped at an edge of {edge:.6g} m: {reason}")
    except SimulationError:
        raise
    except Exception as error:  # LAMMPS raises plain exceptions
        first_line = str(error).strip().splitlines()[0]
        raise SimulationError(f"LAMMPS stopped: {first_line} (log: {log})") from error
    finally:
        if lammps is not None:
            lammps.close()


def _read_states(folder, variables):
    """Turn the dumps of a run into tables, checking every state."""
    scalars = pd.read_csv(folder / "states.csv")
    stiffness = variables["normal_stiffness"]
    periodic = variables["boundary"] == "periodic"
    path, contacts, walls = [], [], []
    frames = zip(*(read_dump(folder / name) for name in _DUMPS), strict=True)
    for (_, line), (particles, pairs) in zip(scalars.iterrows(), frames, strict=True):
        radii = particles["radius"].to_numpy()
        state = int(line["state"])
        touching = state_contacts(pairs, radii, stiffness)
        at_wall = wall_contacts(particles, line["edge"])
        row = path_row(
            line,
            particles,
            touching,
            at_wall,
            first_edge=scalars["edge"][0],
            normal_stiffness=stiffness,
            periodic=periodic,
        )
        check_state(
            row,
            touching,
            at_wall,
            radii,
            normal_stiffness=stiffness,
            tolerance=variables["state_tolerance"],
        )
        path.append(row)
        contacts.append(pd.DataFrame({"state": state, **touching}))
        walls.append(pd.DataFrame({"state": state, **at_wall}))
    return (
        pd.DataFrame(path),
        pd.concat(contacts, ignore_index=True),
        pd.concat(walls, ignore_index=True),
    )


def _text(value):
    # repr keeps all digits, but that of a NumPy number is not one LAMMPS reads.
    return repr(float(value)) if isinstance(value, float) else str(value)


@contextlib.contextmanager
def _interruptible():
    """Let Ctrl-C and the end of the parent process end a run that never returns to Python."""
    if sys.platform == "linux":
        set_parent_death_signal = 1
        ctypes.CDLL(None).prctl(set_parent_death_signal, signal.SIGTERM)
    before = signal.signal(signal.SIGINT, signal.SIG_DFL)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
