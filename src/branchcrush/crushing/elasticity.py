"""The elastic law before crushing: what it must tell, and laws in closed form."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray


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

    @property
    def knots(self) -> NDArray:
        """Strains between which the pressure is smooth, the onset first [-]."""


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

    @property
    def knots(self) -> NDArray:
        """The onset."""
        return np.array([self.onset_strain])


def pressure_dependent(
    modulus: float, exponent: float, reference_pressure: float, onset_strain: float = 0.0
) -> PowerLawElasticity:
    r"""Return the law whose bulk modulus grows with the pressure, as is usual for soils.

    .. math:: K = \frac{dp}{d\epsilon} = K_r \left(\frac{p}{p_r}\right)^q \quad\Rightarrow\quad
        p = p_r \left[\frac{(1-q)\, K_r\, \langle\epsilon - \epsilon_J\rangle}{p_r}
        \right]^{1/(1-q)}

    From no pressure on that is a power law, m = 1/(1 - q): linear contacts' is q = 0, Hertz's
    q = 1/3, and a soil has about 1/2.

    Parameters
    ----------
    modulus : float
        K_r, at the reference pressure [Pa].
    exponent : float
        q, from 0 to below 1 [-].
    reference_pressure : float
        p_r [Pa].
    onset_strain : float
        eps_J [-].

    Returns
    -------
    PowerLawElasticity

    Raises
    ------
    ValueError
        For values outside of these.

    Examples
    --------
    >>> law = pressure_dependent(2e8, 0.5, 1e5)
    >>> law.exponent, round(float(law.stiffness(law.strain_at_pressure(4e5))) / 1e8, 9)
    (2.0, 4.0)

    References
    ----------
    Janbu (1963), Proc. European Conf. Soil Mech. Found. Eng. 1, 19-25, Wiesbaden.
    """
    usable = 0 < modulus < np.inf and 0 < reference_pressure < np.inf
    if not (usable and 0 <= exponent < 1):
        raise ValueError(
            "modulus and reference pressure must be positive and finite, the exponent from 0 to "
            f"below 1: {modulus:g} Pa, {reference_pressure:g} Pa, {exponent:g}"
        )
    power = 1.0 / (1.0 - exponent)
    factor = reference_pressure * (modulus / (power * reference_pressure)) ** power
    return PowerLawElasticity(factor, power, onset_strain)
