"""Free energy, crushing and dissipation of a granular assembly: Eqs. 9 to 23, corrected.

All follows from theta, the share of the energy that crushing can release, and Psi_0(eps), the
elastic energy before crushing: another form of the model is another pair of moments for `theta`,
another material another `Elasticity`. Compression is positive, energies are per reference volume
[J/m3 = Pa]. Arguments of "any shape" are scalars or arrays that broadcast.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import least_squares
from scipy.special import boxcox1p

from branchcrush.errors import AdmissibilityError

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(32)


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


def branch_energy(
    crushing: ArrayLike, psi_r: ArrayLike, moments: tuple[float, float], n: float, l_r: float
) -> NDArray:
    """Free energy summed over the branches: Psi = psi_r <l^n> / l_r^n [J/m3]; l_r cancels.

    <l^n> = (1 - C) <l^n>_0 + C <l^n>_u defines C, as Eq. 7 is 0/0 where B_0(l) = B_u(l).
    crushing: C, any shape [-]; psi_r: `reference_energy`, any shape [J/m3]; moments: <l^n>_0 and
    <l^n>_u, scalars [m^n]; n, l_r: as in `reference_energy`.  Source: Eqs. 14 and 15.
    >>> print(branch_energy(0.5, psi_r=0.25, moments=(1.0, 0.5), n=3.0, l_r=0.5))
    1.5
    """
    moment = np.subtract(1, crushing) * moments[0] + np.multiply(crushing, moments[1])
    return np.multiply(psi_r, moment) / l_r**n


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

    def yield_function(self, crushing: ArrayLike, elastic_energy: ArrayLike) -> NDArray:
        """Yield function y = E_C - E_c [J/m3]: negative inside the elastic domain, else zero."""
        return self.driving_force(elastic_energy) - self.resistance(crushing)

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


@dataclass(frozen=True)
class CrushingPath:
    """History along a strain path; each array has the shape (states,) of the strain."""

    strain: NDArray  # [-]
    elastic_energy: NDArray  # Psi_0 [J/m3]
    crushing: NDArray  # C [-]
    stress: NDArray  # sigma [Pa]
    driving_force: NDArray  # E_C [J/m3]
    resistance: NDArray  # E_c(C) [J/m3]
    stored: NDArray  # Psi [J/m3]
    dissipated: NDArray  # int E_C dC [J/m3]
    work: NDArray  # int sigma deps [J/m3], by quadrature: an independent check on the sum of both


def crushing_path(
    strain: ArrayLike,
    elasticity: Elasticity,
    theta: float,
    critical_energy: float,
    hardening_exponent: float,
) -> CrushingPath:
    """Crushing, stress and energies along any strain path that starts from the unloaded state.

    C follows the largest Psi_0 reached so far and is frozen below it; work = stored + dissipated.
    strain: shape (states,), compression positive, loading or unloading, the first state reached
    straight from the onset [-]; elasticity: Psi_0(eps); the others as in `CrushingLaw`.
    Raises what `CrushingLaw` raises, and ValueError for a strain that is not a finite 1-D array.
    >>> path = crushing_path([0.05, 0.1, 0.0], PowerLawElasticity(1.0, 1.0), 0.6, 1e-3, 2.0)
    >>> print(path.crushing.round(4), np.allclose(path.work, path.stored + path.dissipated))
    [0.     0.4226 0.4226] True
    """
    law = CrushingLaw(theta, critical_energy, hardening_exponent)
    strain = np.asarray(strain, float)
    if strain.ndim != 1 or not strain.size or not np.isfinite(strain).all():
        raise ValueError("the strain path must be one row of finite numbers")
    energy = elasticity.energy(strain)
    largest = np.maximum.accumulate(energy)
    crushing = law.equilibrium_crushing(largest)
    return CrushingPath(
        strain=strain,
        elastic_energy=energy,
        crushing=crushing,
        stress=law.stress(crushing, elasticity.pressure(strain)),
        driving_force=law.driving_force(energy),
        resistance=law.resistance(crushing),
        stored=law.free_energy(crushing, energy),
        dissipated=law.dissipated_energy(crushing),
        work=_work(strain, largest, elasticity, law),
    )


def _work(strain: NDArray, largest: NDArray, elasticity: Elasticity, law: CrushingLaw) -> NDArray:
    """Cumulative integral of sigma deps from the onset, by Gauss-Legendre on smooth pieces."""
    onset = elasticity.strain_at_energy(0.0)
    before = np.append(0.0, largest[:-1])
    start = np.append(onset, strain[:-1])
    low, high = np.minimum(start, strain), np.maximum(start, strain)
    # An increment is smooth but at the onset and where crushing sets in or goes on.
    kink = elasticity.strain_at_energy(np.maximum(before, law.yield_energy))
    edges = np.array([low, np.clip(onset, low, high), np.clip(kink, low, high), high])
    # Nodes crowd at both ends as t^3, which makes a power law of any exponent smooth there.
    t = (1 + _NODES) / 2
    x, weights = t**3 * (10 - 15 * t + 6 * t**2), 15 * _WEIGHTS * (t * (1 - t)) ** 2
    width = np.diff(edges, axis=0)
    nodes = edges[:-1, :, None] + width[..., None] * x
    crushing = law.equilibrium_crushing(np.maximum(elasticity.energy(nodes), before[:, None]))
    pieces = law.stress(crushing, elasticity.pressure(nodes)) @ weights * width
    return np.cumsum(np.sign(strain - start) * pieces.sum(axis=0))
