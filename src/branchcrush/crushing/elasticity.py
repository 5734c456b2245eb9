"""The elastic law before crushing: pressure and energy of the strain, and its fit to a path."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

# A state below this share of the largest energy carries nothing.
_LOADED = 1e-12
# Three parameters fit any fewer states.
FEWEST_STATES = 4
# Where the search begins, as shares of the largest phi_J: noise makes side valleys.
_STARTS = (0.7, 0.9, 0.99)


class Elasticity(Protocol):
    """Elastic energy before crushing: zero up to an onset strain, growing beyond it.

    Strains are of any shape [-], and so is what is returned.
    """

    def pressure(self, strain: ArrayLike) -> NDArray:
        """Return p_0 = dPsi_0/deps [Pa]."""

    def energy(self, strain: ArrayLike) -> NDArray:
        """Return Psi_0 [J/m3]."""

    def strain_at_energy(self, energy: ArrayLike) -> NDArray:
        """Return the strain at an energy [J/m3]; the onset at zero energy."""

    def strain_at_pressure(self, pressure: ArrayLike) -> NDArray:
        """Return the strain at a pressure [Pa]; the onset at none."""

    def stiffness(self, strain: ArrayLike) -> NDArray:
        """Return dp_0/deps [Pa]."""


@dataclass(frozen=True)
class PowerLawElasticity:
    r"""Pressure that grows as a power of the strain beyond an onset: m = 1 linear, m = 3/2 Hertz.

    .. math:: p_0 = A\, \langle \epsilon - \epsilon_J \rangle^m, \qquad
        \Psi_0 = \frac{A\, \langle \epsilon - \epsilon_J \rangle^{m+1}}{m+1}, \qquad
        \langle x \rangle = \max(x, 0)

    Parameters
    ----------
    modulus : float
        A [Pa].
    exponent : float
        m [-].
    onset_strain : float
        eps_J [-].

    Raises
    ------
    ValueError
        Unless A and m are positive and finite.

    Examples
    --------
    >>> law = PowerLawElasticity(modulus=2.0, exponent=1.0)
    >>> float(law.pressure(0.1)), law.strain_at_energy(law.energy([0.25, 0.5])).tolist()
    (0.2, [0.25, 0.5])
    """

    modulus: float
    exponent: float
    onset_strain: float = 0.0

    def __post_init__(self) -> None:
        if not (0 < self.modulus < np.inf and 0 < self.exponent < np.inf):
            raise ValueError(f"modulus and exponent must be positive and finite: {self}")

    def pressure(self, strain: ArrayLike) -> NDArray:
        """Return the pressure at a strain.

        Parameters
        ----------
        strain : array_like
            eps, any shape [-].

        Returns
        -------
        ndarray
            p_0 [Pa]; 0 up to the onset.
        """
        return self.modulus * np.maximum(np.subtract(strain, self.onset_strain), 0) ** self.exponent

    def energy(self, strain: ArrayLike) -> NDArray:
        """Return the elastic energy at a strain.

        Parameters
        ----------
        strain : array_like
            eps, any shape [-].

        Returns
        -------
        ndarray
            Psi_0 [J/m3]; 0 up to the onset.
        """
        beyond = np.maximum(np.subtract(strain, self.onset_strain), 0)
        return self.modulus * beyond ** (self.exponent + 1) / (self.exponent + 1)

    def strain_at_energy(self, energy: ArrayLike) -> NDArray:
        """Return the strain at which an energy is stored.

        Parameters
        ----------
        energy : array_like
            Psi_0, any shape [J/m3].

        Returns
        -------
        ndarray
            eps [-]; the onset at zero energy.
        """
        beyond = np.multiply(energy, (self.exponent + 1) / self.modulus)
        return self.onset_strain + beyond ** (1 / (self.exponent + 1))

    def strain_at_pressure(self, pressure: ArrayLike) -> NDArray:
        """Return the strain at a pressure.

        Parameters
        ----------
        pressure : array_like
            p_0, any shape, 0 or more [Pa].

        Returns
        -------
        ndarray
            eps [-]; the onset at none.
        """
        return self.onset_strain + np.divide(pressure, self.modulus) ** (1 / self.exponent)

    def stiffness(self, strain: ArrayLike) -> NDArray:
        r"""Return the stiffness at a strain.

        .. math:: m A\, \langle \epsilon - \epsilon_J \rangle^{m-1}

        Parameters
        ----------
        strain : array_like
            eps, any shape [-].

        Returns
        -------
        ndarray
            dp_0/deps [Pa]; 0 up to the onset.
        """
        beyond = np.subtract(strain, self.onset_strain)
        loaded = np.where(beyond > 0, beyond, 1.0) ** (self.exponent - 1)
        return np.where(beyond > 0, self.modulus * self.exponent * loaded, 0.0)


def fit_elasticity(
    solid_fraction: ArrayLike, energy_density: ArrayLike
) -> tuple[PowerLawElasticity, float]:
    r"""Return the power law and the jamming solid fraction that fit the energy along a path.

    .. math:: \frac{E}{V} = \frac{\phi}{\phi_J}\, \Psi_0(\epsilon), \qquad
        \epsilon = 1 - \frac{\phi_J}{\phi}

    Psi_0 is per volume at jamming, which makes dPsi_0/deps the pressure. Least squares in the root
    of the energy, which vanishes near jamming; states without load count too: they bound phi_J.

    Parameters
    ----------
    solid_fraction : array_like, shape (states,)
        phi, in any order [-].
    energy_density : array_like, shape (states,)
        E/V, per current volume [J/m3].

    Returns
    -------
    elasticity : PowerLawElasticity
        Its onset is at eps = 0.
    jamming : float
        phi_J [-].

    Raises
    ------
    ValueError
        For unusable arrays, fewer than four loaded states, or no power law in them.

    Examples
    --------
    >>> phi = np.array([0.60, 0.66, 0.70, 0.75, 0.80])
    >>> law, jamming = fit_elasticity(phi, 50 * phi / 0.64 * np.maximum(1 - 0.64 / phi, 0) ** 2)
    >>> round(law.modulus, 6), round(law.exponent, 6), round(jamming, 6)
    (100.0, 1.0, 0.64)
    """
    from scipy.optimize import least_squares  # slow to import, and few jobs need it

    phi, energy = _usable_states(solid_fraction, energy_density)
    largest = energy.max(initial=0.0)
    loaded = np.unique(phi[energy > _LOADED * largest])
    if loaded.size < FEWEST_STATES:
        raise ValueError(
            f"{loaded.size} states carry load, the fit needs {FEWEST_STATES}: compress or save more"
        )
    root = np.sqrt(energy / largest)

    def shape(jamming: float, exponent: float) -> NDArray:
        strain = np.maximum(1 - jamming / phi, 0)
        return np.sqrt(phi / jamming) * strain ** ((exponent + 1) / 2)

    def factor(curve: NDArray) -> float:  # the root of the modulus has a closed form
        return (curve @ root) / (curve @ curve)

    # The densest states that the fit needs stay above phi_J.
    ceiling = loaded[-FEWEST_STATES]
    fits = [
        least_squares(
            lambda parameters: (curve := shape(*parameters)) * factor(curve) - root,
            x0=[start * ceiling, 1.5],
            bounds=([0.05 * ceiling, 0.05], [ceiling, 10.0]),
            **dict.fromkeys(("ftol", "xtol", "gtol"), 1e-15),
        )
        for start in _STARTS
    ]
    jamming, exponent = min(fits, key=lambda fit: fit.cost).x.tolist()
    if jamming < 0.06 * ceiling or not 0.06 < exponent < 9.9:  # the search ended at a bound
        raise ValueError(f"energies fit no power law: m = {exponent:.3g} at phi_J = {jamming:.3g}")
    modulus = (exponent + 1) * factor(shape(jamming, exponent)) ** 2 * largest
    return PowerLawElasticity(float(modulus), exponent), jamming


def _usable_states(solid_fraction: ArrayLike, energy_density: ArrayLike) -> tuple[NDArray, NDArray]:
    phi, energy = np.asarray(solid_fraction, float), np.asarray(energy_density, float)
    usable = phi.ndim == 1 and phi.shape == energy.shape and np.isfinite([phi, energy]).all()
    if not (usable and (phi > 0).all() and (energy >= 0).all()):
        raise ValueError("each state needs a finite solid fraction > 0 and a finite energy >= 0")
    return phi, energy
