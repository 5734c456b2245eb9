"""The jamming point: the solid fraction at which the stress of a loaded packing vanishes."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.errors import FitError

# How far above the first loaded state the states of the fit reach, in solid fraction.
_WINDOW = 0.04
_FEWEST = 4
# Share of a normal distribution up to one standard deviation above its mean.
_ONE_DEVIATION = 0.841344746


class Jamming(NamedTuple):
    """The jamming point of a packing, and how well it is known."""

    solid_fraction: float  # phi_J [-]
    uncertainty: float  # one standard deviation [-]
    states: int  # how many gave it


def jamming_point(
    solid_fraction: ArrayLike, mean_stress: ArrayLike, contact_exponent: float, loaded: ArrayLike
) -> Jamming:
    r"""Return the jamming point of one packing, by extrapolating its stress to zero.

    .. math:: P^{1/m} = a\,(\phi - \phi_J) + b\,(\phi - \phi_J)^2

    m is the exponent of the contact force in the overlap: 1 for linear contacts, 3/2 for Hertz.
    The fit takes the states up to 0.04 above the first that is loaded for good; phi_J is not below
    the last state without load. The uncertainty holds the standard error times Student's t of one
    standard deviation, and half of what leaving out the second term would change, and is no more
    than lies between the last state without load and the first with.

    Parameters
    ----------
    solid_fraction, mean_stress : array_like, shape (n,)
        Along the loading, or along the unloading [-], [Pa].
    contact_exponent : float
        m [-].
    loaded : array_like of bool, shape (n,)
        Which of them carry load.

    Returns
    -------
    Jamming

    Raises
    ------
    FitError
        When fewer than four states carry load, or their stress does not rise.

    Examples
    --------
    >>> phi = np.array([0.60, 0.65, 0.66, 0.67, 0.68])
    >>> point = jamming_point(phi, 1e6 * np.maximum(phi - 0.64, 0.0), 1.0, phi > 0.64)
    >>> round(point.solid_fraction, 9), point.states
    (0.64, 4)

    References
    ----------
    O'Hern, Silbert, Liu and Nagel (2003), Phys. Rev. E 68, 011306.
    """
    order = np.argsort(solid_fraction)
    phi = np.asarray(solid_fraction, dtype=float)[order]
    stress = np.asarray(mean_stress, dtype=float)[order]
    # A packing may carry load, rearrange and be loose again: it jams after it was last loose.
    loose = phi[~np.asarray(loaded, dtype=bool)[order]].max(initial=0.0)
    above = phi > loose
    phi, root = phi[above], stress[above] ** (1.0 / contact_exponent)
    if phi.size < _FEWEST:
        carry = "state carries" if phi.size == 1 else "states carry"
        raise FitError(f"{phi.size} {carry} load; {_FEWEST} are needed for a jamming point")
    near = phi <= max(phi[0] + _WINDOW, phi[_FEWEST - 1])
    first, phi, root = phi[0], phi[near], root[near]
    lines = [_zero(phi, root, degree) for degree in ((1, 2) if phi.size > _FEWEST else (1,))]
    lines = [line for line in lines if 0.0 < line[0] <= first]
    if not lines and loose:  # the stress does not tell more than where it was last loose
        middle, half = (first + loose) / 2.0, (first - loose) / 2.0
        return Jamming(float(middle), float(half), int(phi.size))
    if not lines:
        raise FitError("the stress does not rise from zero along the path")
    value, error = lines[-1]
    spread = abs(lines[-1][0] - lines[0][0]) / 2.0
    # Whatever the extrapolation says, it jams between where it was last loose and first loaded.
    known, widest = max(value, loose), (first - loose if loose else np.inf)
    uncertainty = min(np.hypot(error, spread + known - value), widest)
    return Jamming(float(known), float(uncertainty), int(phi.size))


def _zero(phi: NDArray, root: NDArray, degree: int) -> tuple[float, float]:
    """Return where a polynomial fitted to root(phi) vanishes next to the first, and its error."""
    first, relative = phi[0], root / root.max()
    powers = np.vander(phi - first, degree + 1, increasing=True)
    weights, *_ = np.linalg.lstsq(powers, relative, rcond=None)
    # Not `numpy.polynomial`: its roots lose the near one where the curvature is but rounding.
    zeros = np.roots(weights[::-1])
    zeros = zeros[np.isreal(zeros)].real
    # The root that belongs to rising stress, nearest to the first loaded state.
    slopes = np.polyval(np.polyder(weights[::-1]), zeros)
    zeros = zeros[slopes > 0]
    if not zeros.size:
        return np.nan, np.nan
    zero = zeros[np.argmin(np.abs(zeros))]
    slope = np.polyval(np.polyder(weights[::-1]), zero)
    from scipy.special import stdtrit  # slow to import, and few jobs need it

    spare = phi.size - degree - 1
    variance = np.sum((powers @ weights - relative) ** 2) / max(spare, 1)
    covariance = variance * np.linalg.pinv(powers.T @ powers)
    at_zero = zero ** np.arange(degree + 1)
    error = np.sqrt(at_zero @ covariance @ at_zero) / slope
    # Few spare states tell little of their own scatter: Student's t makes up for it.
    return float(zero + first), float(error * stdtrit(max(spare, 1), _ONE_DEVIATION))
