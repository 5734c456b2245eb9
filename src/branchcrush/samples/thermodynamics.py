"""Rule thermodynamics: the crushing model of the paper on the elastic energy that was measured."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from branchcrush.branches.random_contacts import random_contact_moment
from branchcrush.crushing.elastic_fits import fit_elasticity
from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.crushing.law import CrushingLaw
from branchcrush.crushing.model import reference_energy, theta
from branchcrush.crushing.path import crushing_path
from branchcrush.energy.fit import EnergySplitFit
from branchcrush.errors import AdmissibilityError, FitError
from branchcrush.files.tables import no_data
from branchcrush.gradings.curves import ultimate_grading
from branchcrush.gradings.distribution import Grading
from branchcrush.samples.ensemble import certified_loading, on_the_way_in, stacked
from branchcrush.statistics.intervals import Interval

_POINTS = 200
# The unloading leg ends here, as a share of the largest strain.
_UNLOADED_TO = 0.6
FIXED_CRUSHING = (0.0, 0.25, 0.5, 0.75, 1.0)


class MeasuredElasticity(NamedTuple):
    """The elastic law of a sample before crushing."""

    law: PowerLawElasticity
    jamming: float  # phi_J [-]
    r_squared: float  # of the energies [-]


def crushing_results(
    fit: EnergySplitFit,
    certificate: pd.DataFrame,
    paths: Sequence[pd.DataFrame],
    initial: Grading,
    *,
    ultimate_alpha: float,
    critical_energy: float,
    hardening_exponent: float,
) -> tuple[pd.DataFrame | dict, dict]:
    """Return the curves of the crushing model with the measured exponent and elastic energy.

    Parameters
    ----------
    fit : EnergySplitFit
    certificate : DataFrame
        `certificate.csv`.
    paths : list of DataFrame
        The `path.csv` of each seed.
    initial : Grading
        Target.
    ultimate_alpha : float
        Of the fractal grading that crushing leads to [-].
    critical_energy, hardening_exponent : float
        As for `crushing_curves`.

    Returns
    -------
    curves : DataFrame
        From `crushing_curves`, or why there are none.
    summary : dict
    """
    try:
        if fit.reason is not None:
            raise FitError(fit.reason)
        used, _ = certified_loading(certificate, paths)
        return crushing_curves(
            on_the_way_in(paths, used),
            fit.exponent,
            initial,
            ultimate_grading(initial, ultimate_alpha),
            fit.reference_length,
            critical_energy,
            hardening_exponent,
        )
    except (FitError, AdmissibilityError) as error:
        return no_data(error)


def measured_elasticity(paths: Sequence[pd.DataFrame]) -> MeasuredElasticity:
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
    MeasuredElasticity

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
    r_squared = float(1.0 - residual / np.sum((density - density.mean()) ** 2))
    return MeasuredElasticity(elasticity, jamming, r_squared)


def crushing_curves(
    paths: Sequence[pd.DataFrame],
    exponent: Interval,
    initial: Grading,
    ultimate: Grading | None,
    reference_length: float,
    critical_energy: float,
    hardening_exponent: float,
) -> tuple[pd.DataFrame, dict]:
    r"""Return the curves of the crushing model without branch density, and their summary.

    .. math:: \psi_r = \Psi_0\, l_r^n / \langle l^n \rangle_0

    Parameters
    ----------
    paths : list of DataFrame
        A `path.csv` for each seed.
    exponent : Interval
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
    measured = measured_elasticity(paths)
    n = exponent.estimate
    moments = [random_contact_moment(grading, n) for grading in (initial, ultimate)]
    law = CrushingLaw(theta(*moments), critical_energy, hardening_exponent)
    largest = 1.0 - measured.jamming / max(path["solid_fraction"].max() for path in paths)

    def reference(energy):
        return reference_energy(energy, moments[0], n, reference_length)

    crushing = _crushing_curve(measured.law, law, largest, reference)
    fixed = _fixed_curves(measured.law, law, largest, reference)
    summary = {
        "form": "paper, without branch density",
        **exponent.named("exponent"),
        "theta": law.theta,
        "initial_moment": moments[0],
        "ultimate_moment": moments[1],
        "admissible": True,
        "reference_length_m": reference_length,
        "elastic_modulus_Pa": measured.law.modulus,
        "elastic_exponent": measured.law.exponent,
        "elastic_r_squared": measured.r_squared,
        "jamming_solid_fraction": measured.jamming,
        "jamming_on_path": bool(
            measured.jamming > max(path["solid_fraction"][1] for path in paths)
        ),
        **_yield(measured.law, law, largest),
        "crushing_at_end": float(crushing["crushing"][_POINTS]),
    }
    return pd.concat([crushing, *fixed], ignore_index=True), summary


def _crushing_curve(
    elasticity: PowerLawElasticity,
    law: CrushingLaw,
    largest: float,
    reference: Callable[[NDArray], NDArray],
) -> pd.DataFrame:
    """Return the way to the largest strain and some of the way back, with C evolving."""
    loading = np.linspace(0.0, largest, _POINTS + 1)
    back = np.linspace(largest, _UNLOADED_TO * largest, _POINTS // 4)[1:]
    path = crushing_path(
        np.append(loading, back), elasticity, law.theta, law.critical_energy, law.hardening_exponent
    )
    return pd.DataFrame(
        {
            "path": "crushing",
            "volumetric_strain": path.strain,
            "crushing": path.crushing,
            "elastic_energy_J_per_m3": path.elastic_energy,
            "reference_energy_J_per_m3": reference(path.elastic_energy),
            "free_energy_J_per_m3": path.stored,
            "stress_Pa": path.stress,
            "driving_force_J_per_m3": path.driving_force,
            "resistance_J_per_m3": path.resistance,
            "dissipated_J_per_m3": path.dissipated,
            "work_J_per_m3": path.work,
        }
    )


def _fixed_curves(
    elasticity: PowerLawElasticity,
    law: CrushingLaw,
    largest: float,
    reference: Callable[[NDArray], NDArray],
) -> list[pd.DataFrame]:
    """Return the way to the largest strain at each of `FIXED_CRUSHING`."""
    strain = np.linspace(0.0, largest, _POINTS + 1)
    energy = elasticity.energy(strain)
    return [
        pd.DataFrame(
            {
                "path": "fixed",
                "volumetric_strain": strain,
                "crushing": crushing,
                "elastic_energy_J_per_m3": energy,
                "reference_energy_J_per_m3": reference(energy),
                "free_energy_J_per_m3": law.free_energy(crushing, energy),
                "stress_Pa": law.stress(crushing, elasticity.pressure(strain)),
                "driving_force_J_per_m3": law.driving_force(energy),
            }
        )
        for crushing in FIXED_CRUSHING
    ]


def _yield(elasticity, law, largest):
    """Return where crushing begins, and whether it hardens there and does so on the path."""
    bound = law.least_hardening_exponent(elasticity.exponent)
    strain = float(law.yield_strain(elasticity))
    return {
        "largest_strain": largest,
        "critical_energy_J_per_m3": law.critical_energy,
        "hardening_exponent": law.hardening_exponent,
        "least_hardening_exponent": bound,
        "hardens_at_onset": bool(law.hardening_exponent >= bound),
        "yield_strain": strain,
        "yield_stress_Pa": float(elasticity.pressure(strain)),
        "yields_on_path": bool(strain < largest),
    }
