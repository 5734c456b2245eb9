"""The elastic law of a sample before crushing, from its loading path."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from branchcrush.crushing.elastic_fits import fit_elasticity
from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.errors import FitError
from branchcrush.samples.ensemble import stacked


class MeasuredElasticity(NamedTuple):
    """The elastic law of a sample before crushing."""

    law: PowerLawElasticity
    jamming: float  # phi_J [-]
    r_squared: float  # of the energies [-]
    largest: float  # strain of the densest state, from jamming [-]
    on_path: bool  # whether jamming lies after the approach

    def summary(self) -> dict[str, Any]:
        """Return what `thermodynamics.json` tells of it."""
        return {
            "elastic_modulus_Pa": self.law.modulus,
            "elastic_exponent": self.law.exponent,
            "elastic_r_squared": self.r_squared,
            "jamming_solid_fraction": self.jamming,
            "jamming_on_path": self.on_path,
            "largest_strain": self.largest,
        }


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
    largest = 1.0 - jamming / max(path["solid_fraction"].max() for path in paths)
    on_path = bool(jamming > max(path["solid_fraction"][1] for path in paths))
    return MeasuredElasticity(elasticity, jamming, r_squared, float(largest), on_path)
