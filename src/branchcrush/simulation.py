"""The compression of a packing in LAMMPS: the only module that runs a simulation."""

import contextlib
import ctypes
import re
import shutil
import signal
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from branchcrush.contact_law import HertzContact, LinearContact
from branchcrush.errors import SimulationError
from branchcrush.lammps_files import read_dump, write_data_file
from branchcrush.lammps_library import load_lammps
from branchcrush.loading import UNBALANCED_FORCE_RATIO, loading_targets
from branchcrush.loading_path import (
    force_floor,
    path_row,
    state_contacts,
    stress_floor,
    wall_contacts,
)
from branchcrush.packing import cube_edge

# Skin of the neighbour list over the largest radius: grains move little once they touch.
_SKIN = 0.1
_DUMPS = ("particles.dump.gz", "pairs.dump.gz")
# Solid fraction of a loaded packing, on which a trial is made.
_TRIAL = 0.68
_LAWS = {"linear": LinearContact, "hertz": HertzContact}


def compression_variables(radii, initial_solid_fraction, *, boundary, law, loading, strain_step):
    """Return the variables of `in.compress` for a packing and its loading.

    Parameters
    ----------
    radii : array_like, shape (N,)
        [m]
    initial_solid_fraction : float
        Of the loose packing [-].
    boundary : {"walls", "periodic"}
    law : contact_law.LinearContact or HertzContact
    loading : dict
        The config section.
    strain_step : float
        Largest linear strain of a step [-].

    Returns
    -------
    dict
        A value is a list where the variable takes several.

    Raises
    ------
    SimulationError
        When the largest grain is larger than the final cell, or a target stress is one that a
        packing without load may have.

    Examples
    --------
    >>> from branchcrush.contact_law import LinearContact
    >>> loading = {"target": "edge_reduction", "value": 0.4, "states": 2, "unloading": False,
    ...            "approach_solid_fraction": 0.3}
    >>> variables = compression_variables(
    ...     [1e-3] * 8, 0.16, boundary="walls", law=LinearContact(1e6), loading=loading,
    ...     strain_step=1e-3)
    >>> variables["control"], [round(edge, 6) for edge in variables["targets"]]
    ('edge', [0.00419, 0.003563])
    """
    control, targets = loading_targets(radii, initial_solid_fraction, loading)
    largest, floor = float(np.max(radii)), stress_floor(radii, law)
    if control == "edge" and min(targets) < 2.0 * largest:
        raise SimulationError(
            f"the cell ends at an edge of {min(targets):.4g} m, smaller than the largest grain of "
            f"{2.0 * largest:.4g} m: use more grains or load less"
        )
    if control == "stress" and min(targets) < floor:
        raise SimulationError(
            f"a mean stress of {min(targets):.4g} Pa is below {floor:.4g} Pa, which grains of this "
            "stiffness may have without carrying load: ask for more, or for softer contacts"
        )
    return {
        "boundary": boundary,
        "law": law.name,
        "stiffness": float(law.stiffness),
        "approach_edge": cube_edge(radii, loading["approach_solid_fraction"]),
        "control": control,
        "targets": targets,
        "strain_step": float(strain_step),
        "state_tolerance": UNBALANCED_FORCE_RATIO,
        "force_floor": force_floor(radii, law),
        "largest_radius": largest,
        "skin": _SKIN * largest,
    }


class Compression(NamedTuple):
    """What a compression leaves: a table for each kind of thing."""

    path: pd.DataFrame  # a row for each state, as `loading_path.path_row`
    contacts: pd.DataFrame  # a row for each contact and state, as `loading_path.state_contacts`
    walls: pd.DataFrame  # the same with walls, as `loading_path.wall_contacts`
    steps: pd.DataFrame  # a row for each strain step


def compress(positions, radii, edge, variables, *, inputs, folder, log):
    """Compress a packing in LAMMPS and return its loading path and contacts.

    Runs `in.compress`; its dumps are moved into the folder when the run is complete. Where the
    script has to stop on the way (a grain escapes, a state does not come to rest, a stress is not
    reached) the states saved so far are returned, and column `stopped` of the last says why.

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
    Compression

    Raises
    ------
    SimulationError
        When LAMMPS itself stops, or lists a contact twice.
    """
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    with (
        tempfile.TemporaryDirectory(dir=folder, prefix=".compress-") as scratch,
        tempfile.TemporaryDirectory(prefix="branchcrush-") as links,
    ):
        scratch, links = Path(scratch).resolve(), Path(links)
        write_data_file(scratch / "packing.data", positions, radii, edge)
        # LAMMPS reads no path with a space in it, and the project may lie in such a one.
        (links / "inputs").symlink_to(Path(inputs).resolve())
        (links / "output").symlink_to(scratch)
        stopped = _run_script(
            links / "inputs",
            {
                **variables,
                "data": links / "output" / "packing.data",
                "inputs": links / "inputs",
                "output_folder": links / "output",
                "quit_on_failure": "no",
            },
            log,
        )
        tables = _read_states(scratch, variables, stopped)
        for name in _DUMPS:
            shutil.move(scratch / name, folder / name)
    return tables


def declared_variables(script):
    """Return the variables a LAMMPS script declares with style index, and their defaults.

    Parameters
    ----------
    script : path-like

    Returns
    -------
    dict of str
    """
    text = Path(script).read_text(encoding="utf-8")
    return dict(re.findall(r"^variable\s+(\w+)\s+index\s+(.+)$", text, re.MULTILINE))


def trial(positions, radii, edge, variables, *, inputs, folder, log):
    """Return the time that a force evaluation of a grain takes on this machine, tried out.

    Runs the approach of a packing and one strain step in the range of a loaded packing.

    Parameters
    ----------
    positions, radii, edge, variables, inputs, folder, log
        As for `compress`.

    Returns
    -------
    float
        [s]
    """
    variables = {**variables, "control": "edge", "targets": [cube_edge(radii, _TRIAL)]}
    variables |= {"strain_step": 1.0, "approach_steps": 20}
    with tempfile.TemporaryDirectory(dir=folder, prefix=".trial-") as scratch:
        start = time.perf_counter()
        result = compress(positions, radii, edge, variables, inputs=inputs, folder=scratch, log=log)
        seconds = time.perf_counter() - start
    return seconds / result.path["force_evaluations"].iloc[-1] / len(radii)


def _run_script(inputs, variables, log):
    """Run in.compress and return why it stopped before its end, if it did."""
    # LAMMPS ignores a misspelt -var silently.
    unknown = set(variables) - set(declared_variables(inputs / "in.compress"))
    if unknown:
        raise SimulationError(f"in.compress declares no variable {', '.join(sorted(unknown))}")
    arguments = ["-nocite", "-screen", "none", "-log", str(log)]
    for name, value in variables.items():
        arguments += ["-var", name, *_words(value)]
    lammps = None
    try:
        lammps = load_lammps()(cmdargs=arguments)
        with _interruptible():
            lammps.file(str(inputs / "in.compress"))
        if not int(lammps.extract_variable("failed")):
            return ""
        edge = float(lammps.extract_variable("edge"))
        return f"stopped at an edge of {edge:.6g} m: {lammps.extract_variable('failure')}"
    except Exception as error:  # LAMMPS raises plain exceptions
        first_line = str(error).strip().splitlines()[0]
        raise SimulationError(f"LAMMPS stopped: {first_line} (log: {log})") from error
    finally:
        if lammps is not None:
            lammps.close()


def _read_states(folder, variables, stopped):
    """Turn the output of a run into tables."""
    scalars, steps = (pd.read_csv(folder / f"{name}.csv") for name in ("states", "steps"))
    law = _LAWS[variables["law"]](variables["stiffness"])
    periodic = variables["boundary"] == "periodic"
    path, contacts, walls = [], [], []
    frames = zip(*(read_dump(folder / name) for name in _DUMPS), strict=True)
    for (_, line), (particles, pairs) in zip(scalars.iterrows(), frames, strict=True):
        radii = particles["radius"].to_numpy()
        state = int(line["state"])
        touching = state_contacts(pairs, radii, law)
        at_wall = wall_contacts(particles, line["edge"])
        row = path_row(
            line,
            particles,
            touching,
            at_wall,
            first_edge=scalars["edge"][0],
            law=law,
            periodic=periodic,
        )
        path.append({**row, "leg": _leg(state, variables), "stopped": ""})
        contacts.append(pd.DataFrame({"state": state, **touching}))
        walls.append(pd.DataFrame({"state": state, **at_wall}))
    path[-1]["stopped"] = stopped
    path = pd.DataFrame(path)
    # Work is counted from the end of the approach, the second state: what it holds was put in.
    held = path["elastic_energy_J"].iloc[1:2].sum()
    steps["work"] += held
    path.loc[1:, ["work_J", "dissipated_J"]] += held
    return Compression(
        path,
        pd.concat(contacts, ignore_index=True),
        pd.concat(walls, ignore_index=True),
        _steps(steps, path.iloc[0]),
    )


def _leg(state, variables):
    # Targets that go back unload. Two states come before the first target.
    targets = np.asarray(variables["targets"]) * (-1 if variables["control"] == "edge" else 1)
    return "loading" if state - 2 <= int(np.argmax(targets)) else "unloading"


def _steps(steps, first):
    """Return the strain steps with units in the names."""
    volume = steps["edge"] ** 3
    return pd.DataFrame(
        {
            "step": steps["step"],
            "solid_fraction": first["solid_fraction"] * first["volume_m3"] / volume,
            "volume_m3": volume,
            "mean_stress_Pa": steps["mean_stress"],
            "work_J": steps["work"],
            "unbalanced_force_ratio": steps["unbalanced"],
            "contacts": steps["contacts"],
            "force_evaluations": steps["evaluations"],
        }
    )


def _words(value):
    # repr keeps all digits, but that of a NumPy number is not one LAMMPS reads.
    values = value if isinstance(value, list) else [value]
    return [repr(float(item)) if isinstance(item, float) else str(item) for item in values]


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
