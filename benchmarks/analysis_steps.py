"""The steps of `analysis`, each run in a process of its own: python analysis_steps.py STEP JSON.

Paths are relative to the working directory. A step imports what it needs itself, so that a rule is
charged for its own imports only.
"""

import json
import runpy
import sys
import time
from pathlib import Path
from types import SimpleNamespace

_SCRIPTS = Path(__file__).parents[1] / "workflow" / "scripts"
# The energies are drawn with the exponents from the first of these in the first loaded state to
# the second in the last.
_EXPONENTS = 2.5, 3.0
_JAMMING, _FIRST_LOADED, _LAST = 0.64, 0.645, 0.70
# E = 0.08 J (phi - phi_J)^2 (l / 2 R_M)^n: overlaps of a hundredth of the radius at the end.
_ENERGY = 0.08


class _Named(dict):
    """Files or parameters by name, as attributes, and by number, as Snakemake hands them over."""

    __getattr__ = dict.__getitem__

    def __getitem__(self, key):
        return list(self.values())[key] if isinstance(key, int) else super().__getitem__(key)


def run_rule(script, **job):
    """Run a script of the workflow with the object `snakemake` that its rule would give it."""
    parts = {part: _Named(values) for part, values in job.items()}
    snakemake = SimpleNamespace(**parts, log=[f"logs/{script}.log"])
    runpy.run_path(str(_SCRIPTS / f"{script}.py"), init_globals={"snakemake": snakemake})


def make_sample(name, seeds, grains, states, contacts, resamples):
    """Write the tables of an invented sample, and return the jobs of the rules on them."""
    import numpy as np

    from branchcrush.config.schema import checked_config

    config = {
        "grading": {"form": "uniform", "basis": "number", "size": "radius", "unit": "m"}
        | {"min": 5e-6, "max": 1e-3},
        "grains": grains,
        "boundary": "periodic",
        "initial_solid_fraction": 0.16,
        "contact": {"law": "linear", "normal_stiffness": 1e6},
        "loading": {"edge_reduction": 0.4, "states": states},
        "seeds": seeds,
        "refined_seeds": min(seeds, 2),
    }
    study = checked_config({"samples": {name: config}})
    settings = study.samples[name].settings()
    each = -(-contacts // (seeds * states))
    # The runs with twice the strain steps come on top of the contacts asked for.
    runs = [(name, settings["seeds"]), (f"{name}-refined", settings["seeds"][:2])]
    error = []
    for sample, numbers in runs:
        for seed in numbers:
            rng = np.random.default_rng([seed, len(sample)])
            error.append(_write_seed(sample, seed, grains, states, each, settings, rng))
    Path(f"results/{name}/grading.json").write_text('{"representativity": {"warnings": []}}')
    return {
        "rules": _rules(runs, settings, study, resamples),
        "fit": f"results/{name}/energy_split.json",
        "largest_table": f"results/{name}/seed_1/contacts.parquet",
        "exponent": _EXPONENTS[1],
        # Of exponential energies, whose coefficient of variation is 1.
        "standard_error": error[0] / np.sqrt(seeds),
    }


def _write_seed(sample, seed, grains, states, contacts, settings, rng):
    """Write the files of a seed; return the standard error of the exponent of its last state."""
    import numpy as np
    import pandas as pd

    from branchcrush.files.tables import provenance, write_packing, write_table
    from branchcrush.loading.path import path_row
    from branchcrush.loading.states import state_contacts, wall_contacts
    from branchcrush.packings.contact_laws import contact_law
    from branchcrush.packings.geometry import cube_edge

    folder, law = Path(f"results/{sample}/seed_{seed}"), contact_law(**settings["contact"])
    origin = provenance(sample=sample, seed=seed, config=settings)
    low, high = settings["grading"]["min"], settings["grading"]["max"]
    radii = rng.uniform(low, high, grains)
    write_packing(
        folder / "packing.npz", np.zeros((grains, 3)), radii, cube_edge(radii, 0.16), origin
    )
    particles = _at_rest(radii)
    fractions = [0.16, 0.55, *np.linspace(_FIRST_LOADED, _LAST, states)]
    exponents = [0.0, 0.0, *np.linspace(*_EXPONENTS, states)]
    path, tables = [], []
    for state, (phi, exponent) in enumerate(zip(fractions, exponents, strict=True)):
        pairs = _pairs(radii, contacts if state > 1 else 0, phi, exponent, 2 * high, law, rng)
        touching = state_contacts(pairs, radii, law)
        edge = cube_edge(radii, phi)
        scalars = dict.fromkeys(("kinetic_energy", "escaped", "lost"), 0.0)
        scalars |= {"state": state, "edge": edge, "evaluations": 1000 * state}
        # Of a periodic cell at rest: its pressure is the stress of the branches.
        force = touching["branch_length_m"] @ touching["normal_force_N"]
        scalars |= {"pair_pressure": force / (3 * edge**3)}
        scalars |= {"work": 1.01 * touching["energy_J"].sum()}
        row = path_row(
            scalars,
            particles,
            touching,
            wall_contacts(particles, edge),
            first_edge=cube_edge(radii, fractions[0]),
            law=law,
            periodic=True,
        )
        path.append({**row, "leg": "loading", "stopped": ""})
        tables.append(pd.DataFrame({"state": state, **touching}))
    write_table(folder / "contacts.parquet", pd.concat(tables, ignore_index=True), origin)
    names = ("state", "i", "wall", "overlap_m", "normal_force_N")
    write_table(folder / "wall_contacts.parquet", {name: np.empty(0) for name in names}, origin)
    write_table(folder / "path.csv", path, origin)
    phi = np.linspace(0.55, _LAST, 200)
    stress = path[-1]["mean_stress_Pa"] / (_LAST - _JAMMING) * np.maximum(phi - _JAMMING, 0.0)
    steps = {"step": np.arange(200), "solid_fraction": phi, "mean_stress_Pa": stress}
    steps["unbalanced_force_ratio"] = np.full(200, 1e-2)
    write_table(folder / "steps.csv", steps, origin)
    last = tables[-1]
    return 1.0 / (np.log(last["radius_i_m"] + last["radius_j_m"]).std() * np.sqrt(len(last)))


def _pairs(radii, contacts, phi, exponent, longest, law, rng):
    """Return a frame of the pair dump: any two grains touch, no two of them twice."""
    import numpy as np
    import pandas as pd

    grains = radii.size
    first, second = np.sort(rng.integers(0, grains, (2, contacts + contacts // 10)), axis=0)
    keys = np.unique((first * grains + second)[first < second])
    keys = rng.choice(keys, contacts, replace=False)
    i, j = np.divmod(keys, grains)
    length = radii[i] + radii[j]
    mean = _ENERGY * (phi - _JAMMING) ** 2 * (length / longest) ** exponent
    force = np.sqrt(2.0 * law.stiffness * mean * rng.standard_exponential(contacts))
    branch = length - force / law.stiffness
    columns = {"id1": i + 1, "id2": j + 1, "branch": branch, "force": force}
    # Unit vectors, even on the sphere, times the length.
    z, turn = rng.uniform(-1.0, 1.0, contacts), rng.uniform(0.0, 2.0 * np.pi, contacts)
    flat = np.sqrt(1.0 - z**2)
    for axis, part in (("x", flat * np.cos(turn)), ("y", flat * np.sin(turn)), ("z", z)):
        columns[f"branch_{axis}"] = branch * part
    return pd.DataFrame(columns).astype(float)


def _at_rest(radii):
    """Return a frame of the particle dump of grains on which no net force and no wall acts."""
    import pandas as pd

    names = [f"{name}{axis}" for name in ("", "f", "v_wall_f") for axis in "xyz"]
    return pd.DataFrame({"radius": radii, **dict.fromkeys(names, 0.0)})


def _rules(runs, settings, study, resamples):
    """Return the jobs of the rules, in their order, as `workflow/rules` states them."""
    (name, seeds), (refined, refined_seeds) = runs

    def files(of, kind, numbers):
        return [f"results/{of}/seed_{seed}/{kind}" for seed in numbers]

    contacts = {"contacts": files(name, "contacts.parquet", seeds)}
    paths = {"paths": files(name, "path.csv", seeds)}
    packings = {"packings": files(name, "packing.npz", seeds)}
    certified = {"certificate": f"results/{name}/certificate.csv"}
    jamming = {"jamming": f"results/{name}/jamming.csv"}
    fit = {"fit": f"results/{name}/energy_split.json"}
    bins, both = study.energy_split.bins, {"wildcards": {"sample": name}}
    jobs = {}
    for sample, numbers in runs:
        jobs[f"certificate of {sample}"] = {
            "script": "certificate",
            "input": {
                "packings": files(name, "packing.npz", numbers),
                "paths": files(sample, "path.csv", numbers),
                "steps": files(sample, "steps.csv", numbers),
            },
            "output": {
                "states": f"results/{sample}/certificate.csv",
                "jamming": f"results/{sample}/jamming.csv",
            },
            "params": {"sample": {**settings, "seeds": numbers}},
            **both,
        }
    jobs["energy_split"] = {
        "input": {**paths, **contacts, **certified, **jamming},
        "output": {
            "table": f"results/{name}/energy_split.csv",
            "path": f"results/{name}/energy_split_path.csv",
            **fit,
        },
        "params": {
            "sample": settings,
            "energy_split": study.energy_split.model_dump() | {"resamples": resamples},
        },
    }
    walls = {"walls": files(name, "wall_contacts.parquet", seeds)}
    intervals = {"confidence": 0.95, "resamples": resamples}
    jobs["branch_lengths"] = {
        "input": {**packings, **paths, **contacts, **walls, **certified, **jamming},
        "output": {
            "table": f"results/{name}/branch_lengths.csv",
            "statistics": f"results/{name}/branch_lengths.json",
            "predictions": f"results/{name}/length_predictions.csv",
            "numbers": f"results/{name}/contact_numbers.csv",
            "pairs": f"results/{name}/contact_pairs.csv",
            "coordination": f"results/{name}/coordination.csv",
            "contact_numbers": f"results/{name}/contact_numbers.json",
        },
        "params": {"sample": settings, "bins": bins, "intervals": intervals},
    }
    tables = (
        "shielding_branches",
        "shielding_grains",
        "force_distribution",
        "force_by_length",
        "fabric",
        "stress_by_radius",
        "stress_sharing",
    )
    jobs["sharing"] = {
        "input": {**packings, **paths, **contacts, **walls, **certified},
        "output": {
            "summary": f"results/{name}/sharing.json",
            **{table: f"results/{name}/{table}.csv" for table in tables},
        },
        "params": {"sample": settings, "bins": bins, "intervals": intervals},
    }
    jobs["verdict"] = {
        "input": {
            "states": certified["certificate"],
            "refined_states": [f"results/{sample}/certificate.csv" for sample, _ in runs[1:]],
            "grading": f"results/{name}/grading.json",
            **fit,
            **jamming,
            "all_paths": paths["paths"],
            "paths": files(name, "path.csv", refined_seeds),
            "contacts": files(name, "contacts.parquet", refined_seeds),
            "refined_paths": files(refined, "path.csv", refined_seeds),
            "refined_contacts": files(refined, "contacts.parquet", refined_seeds),
        },
        "output": {
            "convergence": f"results/{name}/convergence.csv",
            "certificate": f"results/{name}/certificate.json",
        },
        "params": {"sample": settings, "bins": bins},
    }
    jobs["thermodynamics"] = {
        "input": {
            **paths,
            **fit,
            **certified,
            "numbers": f"results/{name}/contact_numbers.csv",
        },
        "output": {
            "curves": f"results/{name}/thermodynamics.csv",
            "forms": f"results/{name}/crushing_forms.csv",
            "summary": f"results/{name}/thermodynamics.json",
        },
        "params": {"sample": settings, "thermodynamics": study.thermodynamics.model_dump()},
    }
    return {label: {"script": label, **both, **job} for label, job in jobs.items()}


def read_contacts(path):
    """Read a contacts table with all its columns."""
    from branchcrush.files.tables import read_table

    read_table(path)


def judge_state(path, grains):
    """Return the CPU time of each function on the last state of a table [s]."""
    import numpy as np
    import pandas as pd

    from branchcrush.files.tables import read_packing, read_table
    from branchcrush.loading.path import path_row
    from branchcrush.loading.states import law_error, state_contacts, wall_contacts
    from branchcrush.packings.contact_laws import LinearContact
    from branchcrush.packings.contacts import mechanical_coordination_number, rattlers
    from branchcrush.packings.geometry import cube_edge
    from branchcrush.statistics.bins import bin_edges, binned_sums
    from branchcrush.statistics.power_law import power_law_fit

    table = read_table(path)
    table = table[table["state"] == table["state"].iloc[-1]]
    radii, law = read_packing(Path(path).with_name("packing.npz"))[1], LinearContact(1e6)
    shuffled = table.sample(frac=1.0, random_state=0)
    i, j = (shuffled[name].to_numpy() for name in "ij")
    branch = shuffled["branch_length_m"].to_numpy()
    columns = {"id1": i + 1, "id2": j + 1, "branch": branch, "force": shuffled["normal_force_N"]}
    columns |= {"branch_x": branch, "branch_y": 0.0, "branch_z": 0.0}
    pairs = pd.DataFrame(columns).astype(float)
    particles = _at_rest(radii)
    edge = cube_edge(radii, 0.7)
    scalars = {"state": 0, "edge": edge, "work": 1.0, "kinetic_energy": 0.0, "pair_pressure": 1.0}
    scalars |= {"escaped": 0, "lost": 0, "evaluations": 0}
    seconds = {"contacts": len(table), "grains": grains}

    def timed(function, *arguments, **options):
        start = time.process_time()
        result = function(*arguments, **options)
        seconds[f"{function.__name__}_seconds"] = round(time.process_time() - start, 3)
        return result

    touching = timed(state_contacts, pairs, radii, law)
    walls = timed(wall_contacts, particles, edge)
    timed(path_row, scalars, particles, touching, walls, first_edge=edge, law=law, periodic=True)
    timed(law_error, touching, walls, radii, law)
    at_wall = np.zeros(grains, dtype=int)
    i, j = touching["i"], touching["j"]
    loose = timed(rattlers, i, j, grains, at_wall)
    timed(mechanical_coordination_number, i, j, loose, at_wall)
    length = touching["radius_i_m"] + touching["radius_j_m"]
    timed(binned_sums, length, touching["energy_J"], bin_edges(5e-6, 1e-3))
    timed(power_law_fit, length, touching["energy_J"])
    return seconds


if __name__ == "__main__":
    print(json.dumps(globals()[sys.argv[1]](**json.loads(sys.argv[2]))))
