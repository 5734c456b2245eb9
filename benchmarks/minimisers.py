"""Coming to rest by L-BFGS from Python, against the kinetic damping of `in.compress`.

Both begin from one loaded packing and walk the same strain steps, each relaxed to a state at rest;
each goes on from its own states. L-BFGS moves the grains in the memory of LAMMPS and asks it for
the net forces. No energy is needed: a step is cut where the slope along it has turned. It is not
in the package, because it does not pay reliably: from 1000 grains it took 0.5 to 1.3 of the
evaluations, each 1.4 to 2.7 times as long.
"""

import tempfile
import time
from pathlib import Path

import numpy as np

from benchmarks.dense import (
    INPUTS,
    STIFFNESS,
    apart,
    dense_packing,
    head_of_script,
    packing_variables,
)
from branchcrush.lammps.files import write_data_file
from branchcrush.lammps.library import load_lammps
from branchcrush.packings.contacts import mechanical_coordination_number, rattlers

# Grading, grains, solid fraction at the beginning, boundary.
CASES = (
    ("uniform", 1000, 0.72, "walls"),
    ("lognormal", 1000, 0.68, "periodic"),
    ("lognormal", 2000, 0.72, "walls"),
    ("fractal 20", 2000, 0.82, "periodic"),
)
METHODS = ("kinetic", "lbfgs")
STRAIN, TOLERANCE, MOST = 3e-3, 1e-7, 40_000
# Of L-BFGS: past steps that it knows, and the longest way of a grain in one, over the mean overlap.
# Chosen on one packing of 2000 grains under five strains, whose evaluations scatter by half.
MEMORY, LONGEST_WAY = 4, 3.0
# The mean contact force, which costs more than the net forces, is looked at so often.
_LOOK = 50
_BEGIN = """
run 0 post no
variable failed equal 0
variable work equal 0
variable kinetic_energy equal 0
variable is_state equal 1
variable step_limit equal {most}
variable tolerance equal {tolerance}
"""
_STRAIN = """
variable edge string $(lx*{factor!r}:%.17g)
include {inputs}/mod.strain
"""


def run(cases=CASES, states=2, memory=MEMORY):
    """Return what both ways to rest take, and the states that they come to.

    Parameters
    ----------
    cases : sequence of tuple
        As `CASES`.
    states : int
        Strain steps of 3e-3, each to a state at rest.
    memory : int
        Past steps that L-BFGS knows.

    Returns
    -------
    dict
        For each case, by its name, the list of states of each method, and over all states the
        `evaluations` and `cpu_s` of L-BFGS over those of kinetic damping.
    """
    result = {}
    for form, grains, solid_fraction, boundary in cases:
        with tempfile.TemporaryDirectory(prefix="branchcrush-") as folder:
            (packing,) = apart(dense_packing, (form, grains, solid_fraction, folder, boundary))
        # In a process each: what one leaves in memory does not help the other.
        paths = {
            method: apart(path, (*packing, boundary, method, states, memory))[0]
            for method in METHODS
        }
        totals = {
            name: [sum(state[name] for state in paths[method]) for method in METHODS]
            for name in ("evaluations", "cpu_s")
        }
        ratio = {name: lbfgs / kinetic for name, (kinetic, lbfgs) in totals.items()}
        result[f"{form}, {grains} grains, {solid_fraction}, {boundary}"] = {
            "ratio_to_kinetic": ratio,
            **paths,
        }
    return result


def path(positions, radii, edge, boundary, method, states, memory=MEMORY):
    """Return the states of a packing that is strained and comes to rest by one of `METHODS`."""
    lammps, found = load_lammps(), []
    with tempfile.TemporaryDirectory(prefix="branchcrush-") as scratch:
        scratch = Path(scratch)
        # LAMMPS reads no path with a space in it, and the project may lie in such a one.
        (scratch / "inputs").symlink_to(Path(INPUTS).resolve())
        begin = head_of_script() + _BEGIN.format(most=MOST, tolerance=TOLERANCE)
        (scratch / "begin").write_text(begin, encoding="utf-8")
        strain = _STRAIN.format(factor=1.0 - STRAIN, inputs=scratch / "inputs")
        (scratch / "strain").write_text(strain, encoding="utf-8")
        # A file of its own, as it jumps back in itself.
        relax = f"include {scratch}/inputs/mod.relax\n"
        (scratch / "relax").write_text(relax, encoding="utf-8")
        write_data_file(scratch / "packing.data", positions, radii, edge)
        variables = packing_variables(radii, edge, boundary)
        variables |= {"inputs": scratch / "inputs", "output_folder": scratch}
        variables |= {"data": scratch / "packing.data"}
        arguments = ["-nocite", "-screen", "none", "-log", "none"]
        for name, value in variables.items():
            arguments += ["-var", name, str(value)]
        run_of = lammps(cmdargs=arguments)
        try:
            run_of.file(str(scratch / "begin"))
            for _ in range(states):
                run_of.file(str(scratch / "strain"))
                first, start = run_of.extract_global("ntimestep"), time.process_time()
                if method == "lbfgs":
                    lbfgs(run_of, TOLERANCE, memory)
                else:
                    run_of.file(str(scratch / "relax"))
                taken = {"cpu_s": time.process_time() - start}
                taken["evaluations"] = run_of.extract_global("ntimestep") - first
                found.append(taken | state(run_of))
        finally:
            run_of.close()
    return found


def state(lammps):
    """Return how far from rest a packing is, and what it carries."""
    # In the order of memory. What a variable of LAMMPS tells of walls is zero in periodic cells.
    forces = lammps.numpy.extract_compute("pairs", 2, 2)[:, 4].copy()
    ids = lammps.numpy.extract_compute("ids", 2, 2)[:, :2].astype(int)
    grains = lammps.extract_setting("nlocal")
    names = ("wall_fx", "wall_fy", "wall_fz")
    at_walls = np.array([lammps.numpy.extract_variable(name, "all", 1) for name in names])
    at_walls = at_walls[:, :grains]
    on_wall = np.zeros(grains, dtype=int)
    on_wall[lammps.numpy.extract_atom("id")[:grains] - 1] = (at_walls != 0.0).sum(axis=0)
    i, j = ids.T - 1
    energy = (np.vdot(forces, forces) + np.vdot(at_walls, at_walls)) / (2.0 * STIFFNESS)
    loose = rattlers(i, j, grains, on_wall)
    measured = ("unbalanced", "mean_stress", "escaped", "work")
    return {name: float(lammps.extract_variable(name)) for name in measured} | {
        "energy": float(energy),
        "mechanical_coordination": mechanical_coordination_number(i, j, loose, on_wall),
    }


def lbfgs(lammps, tolerance, memory=MEMORY):
    """Bring the grains to rest with L-BFGS; count steps of LAMMPS to know the evaluations.

    The unknowns are scaled by the contact stiffness of each grain, which its fictitious mass tells:
    without that it takes three times as many evaluations.
    """
    lammps.commands_list(["velocity all set 0 0 0", "unfix motion", "unfix pause", "run 0 post no"])
    grains, array = lammps.extract_setting("nlocal"), lammps.numpy.extract_atom
    mean_force = lammps.extract_variable("reference_force")
    longest = LONGEST_WAY * mean_force / STIFFNESS
    tags = array("id")[:grains].copy()
    scale = np.sqrt(1.0 / (3.0 * array("rmass")[:grains]))[:, None]
    history, guess = _History(memory, 3 * grains), 0.5
    gradient = -array("f")[:grains] * scale
    for evaluation in range(1, MOST):
        direction = history.direction(gradient, guess)
        slope = np.vdot(gradient, direction)
        if not slope < 0.0:
            history.forget()
            guess, direction = 0.5, -0.5 * gradient
            slope = np.vdot(gradient, direction)
        way = direction * scale
        shorter = min(1.0, longest / np.sqrt((way**2).sum(axis=1).max()))
        for _ in range(4):
            direction, way, slope = direction * shorter, way * shorter, slope * shorter
            array("x")[:grains] += way
            lammps.command("run 1 pre no post no")
            # Grains are sorted in memory now and then, when the lists are made anew.
            now = array("id")[:grains]
            if not np.array_equal(tags, now):
                place = np.empty(grains, dtype=int)
                place[tags - 1] = np.arange(grains)
                order = place[now - 1]
                history.sort(order)
                scale, gradient = scale[order], gradient[order]
                direction, way, tags = direction[order], way[order], now.copy()
            forces = array("f")[:grains]
            new = -forces * scale
            new_slope = np.vdot(new, direction)
            if new_slope <= 0.9 * abs(slope):
                break
            # Too far: from the same beginning to where the slope vanishes, were it linear.
            array("x")[:grains] -= way
            shorter = abs(slope) / (abs(slope) + new_slope)
        else:
            array("x")[:grains] += way
        if new_slope > slope:
            guess = history.add(direction, new - gradient, new_slope - slope)
        else:
            history.forget()
            guess = 0.5
        gradient = new
        net = np.sqrt((forces**2).sum(axis=1)).mean()
        if evaluation % _LOOK == 0 or net <= tolerance * mean_force:
            mean_force = lammps.extract_variable("reference_force")
            if net <= tolerance * mean_force:
                break
    pause = "fix pause all halt ${check_every} v_pause != 0 error continue message no"
    lammps.commands_list(["fix motion all nve", pause, "run 0 post no"])


class _History:
    """Past steps and what they changed of the gradient: two passes over them give a direction.

    The compact form of Byrd, Nocedal and Schnabel, Math. Program. 63, 129 (1994): all products
    with long vectors are two, of one matrix.
    """

    def __init__(self, memory, size):
        self.memory = memory
        self.rows = np.zeros((2 * memory, size))
        self.products = np.zeros((2 * memory, 2 * memory))
        self.order = []

    def forget(self):
        self.order = []

    def sort(self, order):
        rows = self.rows.reshape(2 * self.memory, -1, 3)
        self.rows = np.ascontiguousarray(rows[:, order].reshape(2 * self.memory, -1))

    def add(self, step, change, slope):
        """Keep a step in place of the oldest; return the inverse stiffness that it tells."""
        place = (self.order[-1] + 1) % self.memory if self.order else 0
        self.order = [other for other in self.order if other != place] + [place]
        self.rows[place], self.rows[self.memory + place] = step.ravel(), change.ravel()
        column = self.rows @ self.rows[self.memory + place]
        self.products[:, self.memory + place] = column
        self.products[self.memory + place] = column
        return slope / column[self.memory + place]

    def direction(self, gradient, guess):
        """Return the step to where the gradient would vanish."""
        direction = -guess * gradient
        if not self.order:
            return direction
        steps = np.array(self.order)
        changes = self.memory + steps
        along = self.rows @ gradient.ravel()
        upper = np.triu(self.products[np.ix_(steps, changes)])
        middle = np.diag(np.diag(upper)) + guess * self.products[np.ix_(changes, changes)]
        solved = np.linalg.solve(upper, along[steps])
        weights = np.zeros(2 * self.memory)
        weights[changes] = guess * solved
        weights[steps] = np.linalg.solve(upper.T, guess * along[changes] - middle @ solved)
        return direction + (weights @ self.rows).reshape(direction.shape)


def summary(result):
    """Return the lines that tell of a result in short."""
    lines = []
    for name, case in result.items():
        line = "{evaluations:.2f} of the evaluations, {cpu_s:.2f} of the time"
        lines.append(f"{name}: {line.format(**case['ratio_to_kinetic'])}")
    return lines
