"""The crushing model along a strain path: loading, unloading, and the work that it takes."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.crushing.elasticity import Elasticity
from branchcrush.crushing.law import CrushingLaw

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(32)


@dataclass(frozen=True)
class CrushingPath:
    """History along a strain path; each array has the shape (states,) of the strain.

    `work` is integrated by quadrature, and so an independent check on `stored` + `dissipated`.
    """

    strain: NDArray  # eps [-]
    elastic_energy: NDArray  # Psi_0 [J/m3]
    crushing: NDArray  # C [-]
    stress: NDArray  # sigma [Pa]
    driving_force: NDArray  # E_C [J/m3]
    resistance: NDArray  # E_c(C) [J/m3]
    stored: NDArray  # Psi [J/m3]
    dissipated: NDArray  # integral of E_C over C [J/m3]
    work: NDArray  # integral of sigma over eps [J/m3]


def crushing_path(
    strain: ArrayLike,
    elasticity: Elasticity,
    theta: float,
    critical_energy: float,
    hardening_exponent: float,
) -> CrushingPath:
    """Return crushing, stress and energies along any strain path from the unloaded state.

    C follows the largest Psi_0 reached so far and is frozen below it; work is stored or dissipated.

    Parameters
    ----------
    strain : array_like, shape (states,)
        Compression positive, loading or unloading, the first state reached straight from the onset
        [-].
    elasticity : Elasticity
        Psi_0(eps).
    theta, critical_energy, hardening_exponent : float
        As for `CrushingLaw` [-], [J/m3], [-].

    Returns
    -------
    CrushingPath

    Raises
    ------
    AdmissibilityError
        As `CrushingLaw`.
    ValueError
        As `CrushingLaw`, and for a strain that is not one row of finite numbers.

    Examples
    --------
    >>> from branchcrush.crushing.elasticity import PowerLawElasticity
    >>> path = crushing_path([0.05, 0.1, 0.0], PowerLawElasticity(1.0, 1.0), 0.6, 1e-3, 2.0)
    >>> path.crushing.round(4).tolist(), np.allclose(path.work, path.stored + path.dissipated)
    ([0.0, 0.4226, 0.4226], True)
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
    """Return the integral of sigma over eps from the onset, by Gauss-Legendre on smooth pieces."""
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
