"""A crushing whose every number is known: equal grains of 1 mm that break into eighths."""

import numpy as np
import pandas as pd

from branchcrush.packings.contact_laws import LinearContact
from branchcrush.samples.crushed_sizes import Crushable

SAMPLE = Crushable(limit=0.25e-3, size_exponent=1.0, ultimate_alpha=2.6, law=LinearContact(1e6))
RADIUS = 0.5e-3
GRAINS = 80
SOLID = GRAINS * 4.0 / 3.0 * np.pi * RADIUS**3
INTERVALS = {"confidence": 0.95, "resamples": 200}
# Grains of 80 that are broken in each state; the first is the loose packing.
BROKEN = (0, 0, 0, 8, 20, 40)
SOLID_FRACTION = (0.2, 0.64, 0.65, 0.66, 0.68, 0.70)
STRAIN = 0.0125  # elastic, where there is load


def control():
    """Return a path of grains that do not break: p = 1 GPa times the elastic strain."""
    strain = np.array([0.0, 0.0, 0.005, 0.02, 0.04, 0.08])
    path = of_path(np.array(SOLID_FRACTION), 1e9 * strain, strain)
    return path.assign(breakages=0)


def of_path(density, stress, strain):
    volume = SOLID / density
    return pd.DataFrame(
        {
            "state": range(len(density)),
            "leg": "loading",
            "solid_fraction": density,
            "void_ratio": 1.0 / density - 1.0,
            "volume_m3": volume,
            "mean_stress_Pa": stress,
            "carries_load": stress > 0.0,
            # E = p V eps / 2 with linear contacts.
            "elastic_energy_J": stress * volume * strain / 2.0,
            "stopped": np.nan,
        }
    )


def run(broken=BROKEN, slope=0.5, stopped=np.nan, lost=(0.5, 0.3, 0.2)):
    """Return path, grains and branches of a crushing on the line e ~ p^-slope.

    What is lost goes to parents, avalanches and rearrangement in the parts of `lost`.
    """
    density = np.array(SOLID_FRACTION)
    void = 1.0 / density - 1.0
    stress = 1e7 * (void / 0.5) ** (-1.0 / slope)
    stress[:2] = 0.0
    path = of_path(density, stress, np.full(6, STRAIN))
    path["stopped"] = pd.Series([np.nan] * 5 + [stopped], dtype=object)
    total = 1e-3 * np.maximum(np.arange(6) - 2.0, 0.0)
    rearranged = np.array([0.0, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3])  # before the first breakage
    path = path.assign(
        grains=[GRAINS + 7 * n for n in broken],
        breakages=broken,
        broken_mass_fraction=np.array(broken) / GRAINS,
        released_by_parents_J=lost[0] * total,
        dissipated_avalanches_J=lost[1] * total,
        dissipated_breakage_J=(lost[0] + lost[1]) * total,
        dissipated_rearrangement_J=rearranged + lost[2] * total,
        step_excess_J=0.25 * lost[2] * total,
    )
    path["work_J"] = (
        path["elastic_energy_J"]
        + path["dissipated_breakage_J"]
        + path["dissipated_rearrangement_J"]
    )
    grains, branches = [], []
    for state, n in enumerate(broken):
        radius = np.repeat([RADIUS, RADIUS / 2.0], [GRAINS - n, 8 * n])
        generation = np.repeat([0, 1], [GRAINS - n, 8 * n])
        path.loc[state, "grains"] = radius.size
        grains.append(pd.DataFrame({"state": state, "radius_m": radius, "generation": generation}))
        # As many branches between two fragments as between two first grains, per broken share.
        share = n / GRAINS
        length = np.repeat([2.0 * RADIUS, RADIUS], [round(80 * (1 - share)), round(80 * share)])
        if state >= 2:
            branches.append(pd.DataFrame({"state": state, "branch_length_m": length}))
    return path, pd.concat(grains, ignore_index=True), pd.concat(branches, ignore_index=True)
