"""The crushing model along a strain path: loading, unloading, and the work that it takes."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.crushing.elasticity import Elasticity
from branchcrush.crushing.model import CrushingLaw

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(32)


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
    >>> from branchcrush.crushing.elasticity import PowerLawElasticity
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
