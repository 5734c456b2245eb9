"""The elastic law before crushing: pressure and energy of the strain, and its fit to a path."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import least_squares


class Elasticity(Protocol):
    """Elastic energy before crushing: zero up to an onset strain, growing beyond it."""

    def pressure(self, strain: ArrayLike) -> NDArray: ...  # p_0 = dPsi_0/deps [Pa]
    def energy(self, strain: ArrayLike) -> NDArray: ...  # Psi_0 [J/m3]
    def strain_at_energy(self, energy: ArrayLike) -> NDArray: ...  # [-]; the onset at zero energy


@dataclass(frozen=True)
class PowerLawElasticity:
    """Pressure that grows as a power of the strain beyond an onset: m = 1 linear, m = 3/2 Hertz.

    p_0 = A <eps - eps_J>^m,  Psi_0 = A <eps - eps_J>^(m+1) / (m+1),  <x> = max(x, 0)

    modulus: A, scalar [Pa]; exponent: m, scalar [-]; onset_strain: eps_J, scalar [-].
    Raises ValueError unless A and m are positive and finite.
    >>> law = PowerLawElasticity(modulus=2.0, exponent=1.0)
    >>> print(law.pressure(0.1), law.strain_at_energy(law.energy([0.25, 0.5])))
    0.2 [0.25 0.5 ]
    """

    modulus: float
    exponent: float
    onset_strain: float = 0.0

    def __post_init__(self) -> None:
        if not (0 < self.modulus < np.inf and 0 < self.exponent < np.inf):
            raise ValueError(f"modulus and exponent must be positive and finite: {self}")

    def pressure(self, strain: ArrayLike) -> NDArray:
        """Pressure p_0 [Pa] at a strain of any shape [-]."""
        return self.modulus * np.maximum(np.subtract(strain, self.onset_strain), 0) ** self.exponent

    def energy(self, strain: ArrayLike) -> NDArray:
        """Energy Psi_0 [J/m3] at a strain of any shape [-]."""
        beyond = np.maximum(np.subtract(strain, self.onset_strain), 0)
        return self.modulus * beyond ** (self.exponent + 1) / (self.exponent + 1)

    def strain_at_energy(self, energy: ArrayLike) -> NDArray:
        """Strain [-] at which an energy of any shape [J/m3] is stored, in closed form."""
        beyond = np.multiply(energy, (self.exponent + 1) / self.modulus)
        return self.onset_strain + beyond ** (1 / (self.exponent + 1))


def fit_elasticity(
    solid_fraction: ArrayLike, energy_density: ArrayLike
) -> tuple[PowerLawElasticity, float]:
    """Power law and jamming solid fraction phi_J that fit the energy stored along a loading path.

    energy / volume = (phi / phi_J) Psi_0(eps),  eps = 1 - phi_J / phi

    Psi_0 is per volume at jamming, which makes dPsi_0/deps the pressure. Least squares in the root
    of the energy, which vanishes near jamming; states without load count too: they bound phi_J.

    solid_fraction [-], energy_density: per current volume [J/m3]; shape (states,), any order.
    Raises ValueError for unusable arrays, fewer than four loaded states, or no power law in them.
    >>> phi = np.array([0.60, 0.66, 0.70, 0.75, 0.80])
    >>> law, jamming = fit_elasticity(phi, 50 * phi / 0.64 * np.maximum(1 - 0.64 / phi, 0) ** 2)
    >>> print(round(law.modulus, 6), round(law.exponent, 6), round(jamming, 6))
    100.0 1.0 0.64
    """
    phi, energy = np.asarray(solid_fraction, float), np.asarray(energy_density, float)
    usable = phi.ndim == 1 and phi.shape == energy.shape and np.isfinite([phi, energy]).all()
    if not (usable and (phi > 0).all() and (energy >= 0).all()):
        raise ValueError("each state needs a finite solid fraction > 0 and a finite energy >= 0")
    largest = energy.max(initial=0.0)
    loaded = np.unique(phi[energy > 1e-12 * largest])
    if loaded.size < 4:
        raise ValueError(f"{loaded.size} states carry load, the fit needs 4: compress or save more")
    root = np.sqrt(energy / largest)

    def shape(jamming, exponent):
        strain = np.maximum(1 - jamming / phi, 0)
        return np.sqrt(phi / jamming) * strain ** ((exponent + 1) / 2)

    def factor(curve):  # the root of the modulus has a closed form
        return (curve @ root) / (curve @ curve)

    # The four densest states stay above phi_J, else three parameters fit anything. Noise makes
    # side valleys: start from far and near, and keep the deepest.
    ceiling = loaded[-4]
    fits = [
        least_squares(
            lambda parameters: (curve := shape(*parameters)) * factor(curve) - root,
            x0=[start * ceiling, 1.5],
            bounds=([0.05 * ceiling, 0.05], [ceiling, 10.0]),
            **dict.fromkeys(("ftol", "xtol", "gtol"), 1e-15),
        )
        for start in (0.7, 0.9, 0.99)
    ]
    jamming, exponent = min(fits, key=lambda fit: fit.cost).x.tolist()
    if jamming < 0.06 * ceiling or not 0.06 < exponent < 9.9:  # the search ended at a bound
        raise ValueError(f"energies fit no power law: m = {exponent:.3g} at phi_J = {jamming:.3g}")
    modulus = (exponent + 1) * factor(shape(jamming, exponent)) ** 2 * largest
    return PowerLawElasticity(float(modulus), exponent), jamming
