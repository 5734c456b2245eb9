"""Einav's energy split: how the elastic energy of a grain goes with its own radius."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from branchcrush.packings.grains import grain_energy
from branchcrush.packings.network import Network
from branchcrush.statistics.gamma_regression import gamma_fit, parameter_intervals

# Of Einav's split: energy per unit mass as the square of the diameter, so per grain as its fifth
# power.
EINAV = 5.0


def grain_energy_exponents(
    networks: Sequence[Network],
    contact_exponent: float,
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> dict[str, float]:
    r"""Return the exponent of the energy of a grain in its radius.

    .. math:: \langle e \rangle(R) \sim R^a

    Einav's split of the specific energy, as D^2, is a = 5; energy in proportion to volume is 3.

    Parameters
    ----------
    networks : list of Network
        One a seed.
    contact_exponent : float
        1 for linear contacts, 3/2 for Hertz.
    confidence, resamples, rng
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    dict
        exponent_all_grains, rattlers counted with the little or nothing they hold, and
        exponent_load_bearing, each with _low and _high.

    Raises
    ------
    FitError
        As `statistics.gamma_regression.gamma_fit`; all grains of one radius have no exponent.

    References
    ----------
    Einav (2007), J. Mech. Phys. Solids 55, 1274.
    """
    radius_max = max(network.radius.max() for network in networks)
    exponents: dict[str, float] = {}
    for name in ("all_grains", "load_bearing"):
        seeds = []
        for network in networks:
            kept = network.bearing if name == "load_bearing" else slice(None)
            energy = grain_energy(network, contact_exponent)[kept]
            seeds.append((np.log(network.radius[kept] / radius_max), energy))
        fit = gamma_fit(seeds, _power)
        limits = parameter_intervals(fit, confidence=confidence, resamples=resamples, rng=rng)
        exponents |= limits.part(1).named(f"exponent_{name}")
    return exponents


def _power(theta: NDArray | None, log_radius: NDArray | None = None) -> Any:
    if theta is None or log_radius is None:
        return [0.0, 3.0]
    slope = np.stack([np.ones_like(log_radius), log_radius], axis=1)
    return slope @ theta, slope
