"""Small tables of the crushing model in which every number is known."""

import numpy as np
import pandas as pd

CRUSHING = np.array([0.0, 0.25, 0.5, 0.75, 1.0])
FORMS = ("moving_jamming", "paper", "density", "einav")
RATIOS = (
    "energy_at_equal_strain",
    "energy_at_equal_energy_over_pressure",
    "energy_at_equal_stress",
    "energy_at_equal_solid_fraction",
)
ENERGIES = (
    "free_energy",
    "driving_force",
    "resistance",
    "dissipated",
    "plastic_work",
    "work",
)
STRAIN = np.array([0.0, 0.1, 0.05])


def forms_table():
    """Each form is (1, 2, ...) times a curve of its own in each column."""
    parts = []
    for k, name in enumerate(FORMS, start=1):
        part = pd.DataFrame({"form": name, "crushing": CRUSHING})
        moves = name == "moving_jamming"
        part["jamming_solid_fraction"] = 0.6 + 0.1 * CRUSHING if moves else 0.6
        for column, ratio in enumerate(RATIOS, start=1):
            part[ratio] = 1.0 + k * column * CRUSHING
        part["driving_force_over_pressure"] = 0.3 * k * (0.6 - CRUSHING)
        part["yield_stress_Pa"] = k * 1e6 * 10.0**CRUSHING
        part["yield_elastic_strain"] = 0.01 * k
        part["void_ratio"] = 0.7 - 0.1 * k * CRUSHING
        parts.append(part)
    return pd.concat(parts, ignore_index=True)


def curves_table():
    """Every energy is a number of its own [MJ/m3], stress 2 MPa at the end; in 0.25 steps of C."""
    parts = []
    for k, name in enumerate(FORMS, start=1):
        path = pd.DataFrame({"form": name, "path": "crushing", "volumetric_strain": STRAIN})
        path["crushing"] = np.array([0.0, 0.1, 0.1]) * k
        path["stress_Pa"] = np.array([0.0, 2e6, 1e6]) * k
        for column, energy in enumerate(ENERGIES, start=1):
            path[f"{energy}_J_per_m3"] = np.array([0.0, column, column]) * 1e6 * k
        parts.append(path)
        for held in CRUSHING:
            fixed = path[["form", "volumetric_strain", "stress_Pa"]].iloc[:2].copy()
            fixed["path"], fixed["crushing"] = "fixed", held
            fixed["stress_Pa"] *= 1.0 + held
            parts.append(fixed)
    return pd.concat(parts, ignore_index=True)


def model(form="moving_jamming", **others):
    """`thermodynamics.json`: the front form costs energy from 0.6 on, one with density always."""
    forms = {
        name: {"inadmissible_from": None, "admissible": True, "snaps": [], "reason": None}
        for name in FORMS
    }
    forms["moving_jamming"] |= {"inadmissible_from": 0.6, "admissible": False}
    forms["density"] |= {"inadmissible_from": 0.0, "admissible": False}
    return {
        "form": form,
        "forms": forms,
        "jamming_solid_fraction": 0.6,
        "largest_strain": 0.1,
    } | others
