"""Free energy, crushing and dissipation of a granular assembly: Eqs. 9 to 23, corrected.

All follows from theta, the share of the energy that crushing can release, and Psi_0(eps), the
elastic energy before crushing: another form of the model is another pair of moments for `theta`,
another material another `Elasticity`. Compression is positive, energies are per reference volume
[J/m3 = Pa]. Arguments of "any shape" are scalars or arrays that broadcast.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import boxcox1p

from branchcrush.crushing.elasticity import Elasticity
from branchcrush.errors import AdmissibilityError


def theta(moment_initial: float, moment_ultimate: float) -> float:
    """Share of the elastic energy that complete crushing releases: 1 - <l^n>_u / <l^n>_0.

    moment_initial, moment_ultimate: <l^n>_0 and <l^n>_u, scalars of one unit [m^n].
    Raises AdmissibilityError unless 0 < <l^n>_u <= <l^n>_0, both finite.  Source: Eqs. 15 and 22.
    >>> theta(moment_initial=1.0, moment_ultimate=0.25)
    0.75
    """
    if not 0 < moment_ultimate <= moment_initial < np.inf:
        raise AdmissibilityError(
            f"initial moment {moment_initial:.6g}, ultimate moment {moment_ultimate:.6g}: both must"
            " be positive and finite, and the ultimate not larger, else crushing would create"
            " energy. Choose an ultimate distribution of smaller moment, or another exponent"
        )
    return float(1 - moment_ultimate / moment_initial)


def reference_energy(elastic_energy: ArrayLike, moment: float, n: float, l_r: float) -> NDArray:
    """Energy of the reference branches: psi_r = Psi_0 / <f>_0 = Psi_0 l_r^n / <l^n>_0 [J/m3].

    elastic_energy: Psi_0, any shape [J/m3]; moment: <l^n>_0, scalar [m^n]; n: scalar [-];
    l_r: reference branch length, scalar [m].  Source: Eqs. 9 to 11.
    >>> print(reference_energy(2.0, moment=1.0, n=3.0, l_r=0.5))
    0.25
    """
    return np.multiply(elastic_energy, l_r**n / moment)


@dataclass(frozen=True)
class CrushingLaw:
    """Energy that crushing releases, and the resistance to it, per unit of the parameter C.

    Psi = (1 - theta C) Psi_0,  E_C = -dPsi/dC,  E_C <= E_c0 / (1 - C)^s where "=" lets C grow

    theta [-]; critical_energy: E_c0 [J/m3]; hardening_exponent: s [-]; all scalars. The paper
    leaves the resistance open; a constant one (s = 0) is ill-posed: C jumps from 0 to 1. s = 2 is
    Einav's (1 - C)^2 E_C = E_c0. Methods take any shape: crushing is C [-], energies in [J/m3].
    Raises AdmissibilityError unless 0 <= theta <= 1, ValueError unless E_c0 and s are positive.
    Source: Eqs. 16 to 23; Eq. 16 lacks its brackets, Eqs. 17 and 23 lack 1/l_r^n.
    >>> law = CrushingLaw(theta=0.5, critical_energy=1.0, hardening_exponent=2.0)
    >>> print(law.yield_energy, law.equilibrium_crushing([1.0, 8.0]), law.stress(0.5, 4.0))
    2.0 [0.  0.5] 3.0
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
        """Stored energy Psi = (1 - theta C) Psi_0 [J/m3] (Eq. 16)."""
        return (1 - np.multiply(self.theta, crushing)) * elastic_energy

    def stress(self, crushing: ArrayLike, elastic_pressure: ArrayLike) -> NDArray:
        """Mean stress sigma = dPsi/deps = (1 - theta C) p_0 [Pa] (Eq. 23, first bracket)."""
        return (1 - np.multiply(self.theta, crushing)) * elastic_pressure

    def driving_force(self, elastic_energy: ArrayLike) -> NDArray:
        """Driving force E_C = -dPsi/dC = theta Psi_0 [J/m3] (Eq. 23, second bracket)."""
        return np.multiply(self.theta, elastic_energy)

    def resistance(self, crushing: ArrayLike) -> NDArray:
        """Resistance E_c = E_c0 / (1 - C)^s [J/m3]."""
        return self.critical_energy / np.subtract(1, crushing) ** self.hardening_exponent

    @property
    def yield_energy(self) -> float:
        """Elastic energy at which crushing begins: Psi_y = E_c0 / theta [J/m3]."""
        return self.critical_energy / self.theta if self.theta > 0 else np.inf

    def yield_strain(self, elasticity: Elasticity) -> NDArray:
        """Strain at which crushing begins [-]: eps_y = [(m+1) E_c0 / (theta A)]^(1/(m+1))."""
        return elasticity.strain_at_energy(self.yield_energy)

    def equilibrium_crushing(self, largest_energy: ArrayLike) -> NDArray:
        """Crushing C = 1 - (Psi_y / Psi_0)^(1/s) [-] at the largest Psi_0 so far [J/m3]."""
        overload = np.maximum(self.driving_force(largest_energy) / self.critical_energy, 1)
        return -np.expm1(-np.log(overload) / self.hardening_exponent)

    def dissipated_energy(self, crushing: ArrayLike) -> NDArray:
        """Dissipation int E_c dC = E_c0 [(1 - C)^(1-s) - 1] / (s - 1) [J/m3] (Eq. 20)."""
        return -self.critical_energy * boxcox1p(np.negative(crushing), 1 - self.hardening_exponent)

    def least_hardening_exponent(self, elastic_exponent: float) -> float:
        """Least s with which stress ~ eps^m never falls as crushing begins: theta (1 + 1/m) [-]."""
        return self.theta * (1 + 1 / elastic_exponent)
