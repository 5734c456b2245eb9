"""The crushing model of the paper on the elastic energy that was measured."""

import numpy as np
import pandas as pd

from branchcrush.branches.lengths import random_contact_moment
from branchcrush.crushing.elasticity import fit_elasticity
from branchcrush.crushing.model import CrushingLaw, reference_energy, theta
from branchcrush.crushing.path import crushing_path
from branchcrush.errors import FitError
from branchcrush.samples.ensemble import stacked

_POINTS = 200
# The unloading leg ends here, as a share of the largest strain.
_UNLOADED_TO = 0.6
FIXED_CRUSHING = (0.0, 0.25, 0.5, 0.75, 1.0)


def measured_elasticity(paths):
    r"""Fit the elastic law to the energy per volume of all seeds along the loading path.

    .. math:: \Psi_0 = \frac{A}{m+1} \epsilon^{m+1}, \quad \epsilon = 1 - \phi_J/\phi

    Psi_0 is per volume at jamming and eps the volumetric strain from there, so dPsi_0/deps is
    the mean stress.

    Parameters
    ----------
    paths : list of DataFrame
        A `path.csv` for each seed.

    Returns
    -------
    elasticity : PowerLawElasticity
    jamming : float
        phi_J [-].
    r_squared : float
        Of the energies.

    Raises
    ------
    FitError
        When too few states carry load for the fit.
    """
    together = stacked(paths)
    phi = together["solid_fraction"].to_numpy()
    density = (together["elastic_energy_J"] / together["volume_m3"]).to_numpy()
    try:
        elasticity, jamming = fit_elasticity(phi, density)
    except ValueError as error:
        raise FitError(f"no elastic law in the loading path: {error}") from error
    fitted = phi / jamming * elasticity.energy(1.0 - jamming / phi)
    residual = np.sum((density - fitted) ** 2)
    return elasticity, jamming, float(1.0 - residual / np.sum((density - density.mean()) ** 2))


def crushing_curves(
    paths, exponent, initial, ultimate, reference_length, critical_energy, hardening_exponent
):
    """Return the curves of the crushing model without branch density, and their summary.

    Parameters
    ----------
    paths : list of DataFrame
        A `path.csv` for each seed.
    exponent : intervals.Interval
        n of the energy split.
    initial, ultimate : Grading
        Gradings on a common support; no ultimate one (None) for a single size.
    reference_length : float
        l_r [m]; it cancels in all but psi_r.
    critical_energy : float
        E_c0 [J/m3].
    hardening_exponent : float
        s [-].

    Returns
    -------
    curves : DataFrame
        Column `path`: "crushing" is a loading and unloading with C evolving, "fixed" holds C.
    summary : dict

    Raises
    ------
    FitError
        When too few states carry load.
    AdmissibilityError
        When the ultimate grading has the larger moment <l^n>.
    """
    if ultimate is None:
        raise FitError("grains of a single size have no finer grading of their range to crush to")
    elasticity, jamming, r_squared = measured_elasticity(paths)
    n = exponent.estimate
    moments = [random_contact_moment(grading, n) for grading in (initial, ultimate)]
    share = theta(*moments)
    law = CrushingLaw(share, critical_energy, hardening_exponent)
    largest = 1.0 - jamming / max(path["solid_fraction"].max() for path in paths)
    loading = np.linspace(0.0, largest, _POINTS + 1)
    strain = np.append(loading, np.linspace(largest, _UNLOADED_TO * largest, _POINTS // 4)[1:])
    path = crushing_path(strain, elasticity, share, critical_energy, hardening_exponent)
    curves = [
        _curve(
            "crushing",
            path,
            reference_energy(path.elastic_energy, moments[0], n, reference_length),
        )
    ]
    for crushing in FIXED_CRUSHING:
        energy = elasticity.energy(loading)
        curves.append(
            pd.DataFrame(
                {
                    "path": "fixed",
                    "volumetric_strain": loading,
                    "crushing": crushing,
                    "elastic_energy_J_per_m3": energy,
                    "reference_energy_J_per_m3": reference_energy(
                        energy, moments[0], n, reference_length
                    ),
                    "free_energy_J_per_m3": law.free_energy(crushing, energy),
                    "stress_Pa": law.stress(crushing, elasticity.pressure(loading)),
                    "driving_force_J_per_m3": law.driving_force(energy),
                }
            )
        )
    bound = law.least_hardening_exponent(elasticity.exponent)
    yield_strain = float(law.yield_strain(elasticity))
    summary = {
        "form": "paper, without branch density",
        **exponent.named("exponent"),
        "theta": share,
        "initial_moment": moments[0],
        "ultimate_moment": moments[1],
        "admissible": True,
        "reference_length_m": reference_length,
        "elastic_modulus_Pa": elasticity.modulus,
        "elastic_exponent": elasticity.exponent,
        "elastic_r_squared": r_squared,
        "jamming_solid_fraction": jamming,
        "jamming_on_path": bool(jamming > max(path["solid_fraction"][1] for path in paths)),
        "largest_strain": largest,
        "critical_energy_J_per_m3": critical_energy,
        "hardening_exponent": hardening_exponent,
        "least_hardening_exponent": bound,
        "hardens_at_onset": bool(hardening_exponent >= bound),
        "yield_strain": yield_strain,
        "yield_stress_Pa": float(elasticity.pressure(yield_strain)),
        "yields_on_path": bool(yield_strain < largest),
        "crushing_at_end": float(path.crushing[_POINTS]),
    }
    return pd.concat(curves, ignore_index=True), summary


def _curve(name, path, reference):
    return pd.DataFrame(
        {
            "path": name,
            "volumetric_strain": path.strain,
            "crushing": path.crushing,
            "elastic_energy_J_per_m3": path.elastic_energy,
            "reference_energy_J_per_m3": reference,
            "free_energy_J_per_m3": path.stored,
            "stress_Pa": path.stress,
            "driving_force_J_per_m3": path.driving_force,
            "resistance_J_per_m3": path.resistance,
            "dissipated_J_per_m3": path.dissipated,
            "work_J_per_m3": path.work,
        }
    )
