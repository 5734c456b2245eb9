"""Elastic laws from the energies of a loading path: fits, and the law through every state."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.crushing.interpolated_elasticity import FEWEST_KNOTS, InterpolatedElasticity

# A state below this share of the largest energy carries nothing.
_LOADED = 1e-12
# Three parameters fit any fewer states.
FEWEST_STATES = 4
# Solid fractions nearer to each other are those of one state, in several packings [-].
_APART = 1e-3
# Where the search begins, as shares of the largest phi_J: noise makes side valleys.
_STARTS = (0.7, 0.9, 0.99)


def fit_elasticity(
    solid_fraction: ArrayLike,
    energy_density: ArrayLike,
    *,
    exponent: float | None = None,
    jamming: float | None = None,
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
    exponent : float, optional
        m, where the contact law fixes it: 1 linear, 3/2 Hertz [-]; fitted when left out.
    jamming : float, optional
        phi_J, where it is known from the stress [-]; fitted when left out.

    Returns
    -------
    elasticity : PowerLawElasticity
        Its onset is at eps = 0.
    jamming : float
        phi_J [-].

    Raises
    ------
    ValueError
        For unusable arrays, fewer than four loaded states above phi_J, or no power law in them.

    Examples
    --------
    >>> phi = np.array([0.60, 0.66, 0.70, 0.75, 0.80])
    >>> law, jamming = fit_elasticity(phi, 50 * phi / 0.64 * np.maximum(1 - 0.64 / phi, 0) ** 2)
    >>> round(law.modulus, 6), round(law.exponent, 6), round(jamming, 6)
    (100.0, 1.0, 0.64)
    """
    phi, energy = _usable_states(solid_fraction, energy_density)
    largest = energy.max(initial=0.0)
    loaded = np.unique(phi[(energy > _LOADED * largest) & (phi > (jamming or 0.0))])
    # One state of several packings is one point of the law, however their phi differ.
    if np.unique(np.round(loaded / _APART)).size < FEWEST_STATES:
        raise ValueError(
            f"of all packings {_states(loaded.size, 'carries', 'carry')} load, the fit needs "
            f"{FEWEST_STATES} at solid fractions {_APART:g} apart: compress or save more"
        )
    root = np.sqrt(energy / largest)

    def shape(jamming: float, exponent: float) -> NDArray:
        strain = np.maximum(1 - jamming / phi, 0)
        return np.sqrt(phi / jamming) * strain ** ((exponent + 1) / 2)

    def factor(curve: NDArray) -> float:  # the root of the modulus has a closed form
        return (curve @ root) / (curve @ curve)

    def misfit(at_jamming: float, at_exponent: float) -> NDArray:
        return (curve := shape(at_jamming, at_exponent)) * factor(curve) - root

    # The densest states that the fit needs stay above phi_J.
    jamming, exponent = _least_squares(misfit, loaded[-FEWEST_STATES], (jamming, exponent))
    modulus = (exponent + 1) * factor(shape(jamming, exponent)) ** 2 * largest
    return PowerLawElasticity(float(modulus), exponent), jamming


def _least_squares(
    misfit: Callable[[float, float], NDArray],
    ceiling: float,
    known: tuple[float | None, float | None],
) -> tuple[float, float]:
    """Return phi_J and the exponent of the best fit; None among those `known` is free."""
    free = np.array([value is None for value in known])
    if known[0] is not None and known[1] is not None:
        return known[0], known[1]

    from scipy.optimize import least_squares  # slow to import, and few jobs need it

    low, high = np.array([0.05 * ceiling, 0.05]), np.array([ceiling, 10.0])

    def both(values: NDArray) -> NDArray:
        parameters = np.array([0.0 if value is None else value for value in known])
        parameters[free] = values
        return parameters

    fits = [
        least_squares(
            lambda values: misfit(*both(values)),
            x0=np.array([start * ceiling, 1.5])[free],
            bounds=(low[free], high[free]),
            **dict.fromkeys(("ftol", "xtol", "gtol"), 1e-15),
        )
        for start in (_STARTS if free[0] else _STARTS[:1])
    ]
    jamming, exponent = both(min(fits, key=lambda fit: fit.cost).x).tolist()
    # The search ended at a bound.
    if (free[0] and jamming < 0.06 * ceiling) or (free[1] and not 0.06 < exponent < 9.9):
        raise ValueError(f"energies fit no power law: m = {exponent:.3g} at phi_J = {jamming:.3g}")
    return jamming, exponent


def interpolated_elasticity(
    solid_fraction: ArrayLike, energy_density: ArrayLike, jamming: float
) -> tuple[InterpolatedElasticity, int]:
    r"""Return the law that goes through the energies of states, and how many are left out.

    .. math:: \Psi_0 = \frac{\phi_J}{\phi}\, \frac{E}{V}, \qquad
        \epsilon = 1 - \frac{\phi_J}{\phi}

    Next to jamming a mean over packings holds some that carry nothing yet: states are left out,
    the loosest first, until the pressure rises through all that stay.

    Parameters
    ----------
    solid_fraction : array_like, shape (states,)
        phi, each once, in any order [-].
    energy_density : array_like, shape (states,)
        E/V, per current volume [J/m3].
    jamming : float
        phi_J [-].

    Returns
    -------
    elasticity : InterpolatedElasticity
    left_out : int
        States above phi_J that it does not go through.

    Raises
    ------
    ValueError
        For unusable arrays, or where no three states or more have a rising pressure.

    Examples
    --------
    >>> phi = np.array([0.60, 0.66, 0.70, 0.75, 0.80])
    >>> energy = 50 * phi / 0.64 * np.maximum(1 - 0.64 / phi, 0) ** 2
    >>> law, left_out = interpolated_elasticity(phi, energy, 0.64)
    >>> round(float(law.stiffness(0.1)), 6), left_out
    (100.0, 0)
    """
    phi, energy = _usable_states(solid_fraction, energy_density)
    order = np.argsort(phi)
    order = order[phi[order] > jamming]
    strain, density = 1 - jamming / phi[order], jamming / phi[order] * energy[order]
    lie = _states(strain.size, "lies", "lie")
    reason = f"{lie} above phi_J = {jamming:.4f}, it needs {FEWEST_KNOTS}"
    for left_out in range(strain.size - FEWEST_KNOTS + 1):
        try:
            states = tuple(strain[left_out:].tolist()), tuple(density[left_out:].tolist())
            return InterpolatedElasticity(*states), left_out
        except ValueError as error:
            reason = str(error)
    raise ValueError(f"energies give no law by interpolation: {reason}")


def _states(number: int, one: str, many: str) -> str:
    """Return a number of states with what one does or many do."""
    return f"1 state {one}" if number == 1 else f"{number} states {many}"


def _usable_states(solid_fraction: ArrayLike, energy_density: ArrayLike) -> tuple[NDArray, NDArray]:
    phi, energy = np.asarray(solid_fraction, float), np.asarray(energy_density, float)
    usable = phi.ndim == 1 and phi.shape == energy.shape and np.isfinite([phi, energy]).all()
    if not (usable and (phi > 0).all() and (energy >= 0).all()):
        raise ValueError("each state needs a finite solid fraction > 0 and a finite energy >= 0")
    return phi, energy
