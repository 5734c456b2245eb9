"""Free energy, crushing and dissipation of a granular assembly: Eqs. 16 to 23, corrected.

All follows from theta, the share of the energy that crushing can release, and Psi_0(eps), the
elastic energy before crushing. Arguments of "any shape" are scalars or arrays that broadcast.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.crushing.elasticity import Elasticity
from branchcrush.errors import AdmissibilityError


@dataclass(frozen=True)
class CrushingLaw:
    r"""Energy that crushing releases, and the resistance to it, per unit of the parameter C.

    .. math:: \Psi = (1 - \theta C)\, \Psi_0, \qquad
        E_C = -\frac{\partial \Psi}{\partial C} \le \frac{E_{c0}}{(1 - C)^s}

    C grows where both sides are equal. The paper leaves the resistance open; a constant one, s = 0,
    is ill-posed: C jumps from 0 to 1. s = 2 is Einav's (1 - C)^2 E_C = E_c0.

    Parameters
    ----------
    theta : float
        Share of the elastic energy that complete crushing releases, from 0 to 1 [-].
    critical_energy : float
        E_c0 [J/m3].
    hardening_exponent : float
        s [-].

    Raises
    ------
    AdmissibilityError
        Unless theta is from 0 to 1.
    ValueError
        Unless E_c0 and s are positive and finite.

    Examples
    --------
    >>> law = CrushingLaw(theta=0.5, critical_energy=1.0, hardening_exponent=2.0)
    >>> law.yield_energy, law.equilibrium_crushing([1.0, 8.0]).tolist(), float(law.stress(0.5, 4.0))
    (2.0, [0.0, 0.5], 3.0)

    References
    ----------
    Paper, Eqs. 16 to 23; Eq. 16 lacks its brackets, Eqs. 17 and 23 lack 1/l_r^n.
    """

    theta: float
    critical_energy: float
    hardening_exponent: float

    def __post_init__(self) -> None:
        if not 0 <= self.theta <= 1:
            raise AdmissibilityError(f"theta = {self.theta:.6g} must lie between 0 and 1")
        if not (0 < self.critical_energy < np.inf and 0 < self.hardening_exponent < np.inf):
            raise ValueError(f"critical energy and hardening must be positive and finite: {self}")

    def free_energy(self, crushing: ArrayLike, elastic_energy: ArrayLike) -> NDArray:
        r"""Return the stored energy, Eq. 16.

        .. math:: \Psi = (1 - \theta C)\, \Psi_0

        Parameters
        ----------
        crushing : array_like
            C, any shape [-].
        elastic_energy : array_like
            Psi_0, any shape [J/m3].

        Returns
        -------
        ndarray
            [J/m3]
        """
        return (1 - np.multiply(self.theta, crushing)) * elastic_energy

    def stress(self, crushing: ArrayLike, elastic_pressure: ArrayLike) -> NDArray:
        r"""Return the mean stress, the first bracket of Eq. 23.

        .. math:: \sigma = \frac{\partial \Psi}{\partial \epsilon} = (1 - \theta C)\, p_0

        Parameters
        ----------
        crushing : array_like
            C, any shape [-].
        elastic_pressure : array_like
            p_0, any shape [Pa].

        Returns
        -------
        ndarray
            [Pa]
        """
        return (1 - np.multiply(self.theta, crushing)) * elastic_pressure

    def driving_force(self, elastic_energy: ArrayLike) -> NDArray:
        r"""Return the driving force of crushing, the second bracket of Eq. 23.

        .. math:: E_C = -\frac{\partial \Psi}{\partial C} = \theta\, \Psi_0

        Parameters
        ----------
        elastic_energy : array_like
            Psi_0, any shape [J/m3].

        Returns
        -------
        ndarray
            [J/m3]
        """
        return np.multiply(self.theta, elastic_energy)

    def resistance(self, crushing: ArrayLike) -> NDArray:
        r"""Return the resistance to more crushing.

        .. math:: E_c = \frac{E_{c0}}{(1 - C)^s}

        Parameters
        ----------
        crushing : array_like
            C, any shape, below 1 [-].

        Returns
        -------
        ndarray
            [J/m3]
        """
        return self.critical_energy / np.subtract(1, crushing) ** self.hardening_exponent

    @property
    def yield_energy(self) -> float:
        """The elastic energy at which crushing begins: Psi_y = E_c0 / theta [J/m3]."""
        return self.critical_energy / self.theta if self.theta > 0 else np.inf

    def yield_strain(self, elasticity: Elasticity) -> NDArray:
        r"""Return the strain at which crushing begins.

        .. math:: \Psi_0(\epsilon_y) = \Psi_y, \qquad
            \epsilon_y = \left[\frac{(m+1)\, E_{c0}}{\theta A}\right]^{1/(m+1)}

        The second is for a power law from 0 on.

        Parameters
        ----------
        elasticity : Elasticity

        Returns
        -------
        ndarray
            [-]; infinite when theta is 0.
        """
        return elasticity.strain_at_energy(self.yield_energy)

    def equilibrium_crushing(self, largest_energy: ArrayLike) -> NDArray:
        r"""Return how far crushing has come, from the largest elastic energy so far.

        .. math:: C = 1 - \left(\frac{\Psi_y}{\Psi_0}\right)^{1/s}, \qquad \Psi_0 \ge \Psi_y

        Parameters
        ----------
        largest_energy : array_like
            Psi_0, any shape [J/m3].

        Returns
        -------
        ndarray
            [-]; 0 up to the yield energy.
        """
        overload = np.maximum(self.driving_force(largest_energy) / self.critical_energy, 1)
        return -np.expm1(-np.log(overload) / self.hardening_exponent)

    def dissipated_energy(self, crushing: ArrayLike) -> NDArray:
        r"""Return the energy that crushing has dissipated, Eq. 20.

        .. math:: \int_0^C E_c\, dC = E_{c0}\, \frac{(1 - C)^{1-s} - 1}{s - 1}

        Parameters
        ----------
        crushing : array_like
            C, any shape [-].

        Returns
        -------
        ndarray
            [J/m3]; its limit -E_c0 ln(1 - C) where s is 1.
        """
        from scipy.special import boxcox1p  # slow to import, and the preview does without

        return -self.critical_energy * boxcox1p(np.negative(crushing), 1 - self.hardening_exponent)

    def least_hardening_exponent(self, elastic_exponent: float) -> float:
        r"""Return the least s with which the stress never falls as crushing begins.

        .. math:: s_{min} = \theta\, (1 + 1/m)

        Parameters
        ----------
        elastic_exponent : float
            m of p_0 = A eps^m [-].

        Returns
        -------
        float
            [-]
        """
        return self.theta * (1 + 1 / elastic_exponent)
