"""Who carries load, and with how many contacts, by rods that push: from the grading alone."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from branchcrush.branches.coordination import ISOSTATIC, Coordination
from branchcrush.branches.coordination_laws import jamming_law
from branchcrush.errors import FitError
from branchcrush.gradings.rods import RodMap, gap_at, rod_map
from branchcrush.packings.contacts import STABLE_CONTACTS

# A diameter of which fewer grains than this carry load counts as finer than those that do.
_SOME = 0.01
# Rods that the gap beyond jamming is sought with; with all of them the same ones push.
_SEARCHED = 2_000


class LoadBearing(NamedTuple):
    """Which grains of a grading carry load where it jams, by rods that push."""

    solid_fraction: float  # phi_J [-]
    by_number: float  # share of the grains that carry load [-]
    by_mass: float  # and of their mass [-]
    finest: float  # radius of the finest of which 1 % or more carry load [unit of the radii]
    coordination_number: float  # kappa, rattlers counted [-]


def load_bearing(radius: NDArray, share: NDArray) -> LoadBearing:
    r"""Return which grains carry load at jamming, from the grading alone.

    .. math:: \sum_i w_i \beta_i, \qquad
        \frac{\sum_i w_i R_i^3 \beta_i}{\sum_i w_i R_i^3}, \qquad \kappa = \sum_i w_i c_i

    Parameters
    ----------
    radius, share : ndarray, shape (K,)
        Radii [any unit], and their shares of the number of grains [-].

    Returns
    -------
    LoadBearing

    Raises
    ------
    FitError, ValueError
        As `rod_coordination`, and as `gradings.rods.rod_map`.

    Examples
    --------
    A tenth of the mass ten times finer, in the pores of the coarse:

    >>> radius, mass = np.array([1.0, 0.1]), np.array([0.9, 0.1])
    >>> found = load_bearing(radius, mass / radius**3 / (mass / radius**3).sum())
    >>> round(found.solid_fraction, 2), round(found.by_number, 3), round(found.by_mass, 2)
    (0.71, 0.008, 0.86)
    >>> found.finest
    1.0
    """
    rods = rod_map(radius, share)
    contacts, bearing = rod_coordination(radius, share, rods)
    mass = share * radius**3
    return LoadBearing(
        rods.solid_fraction,
        float(share @ bearing / share.sum()),
        float(mass @ bearing / mass.sum()),
        float(radius[bearing >= _SOME].min(initial=np.inf)),
        float(share @ contacts / share.sum()),
    )


def rod_contacts(radius: NDArray, share: NDArray) -> Coordination:
    """Return contact numbers at jamming by rods that push, as `rod_coordination` at no strain.

    Parameters
    ----------
    radius, share : ndarray, shape (K,)
        Radii [any unit], and their shares of the number of grains [-].

    Returns
    -------
    Coordination

    Raises
    ------
    FitError
        As `rod_coordination`.

    Examples
    --------
    >>> single = rod_contacts(np.array([2.0]), np.array([1.0]))
    >>> round(float(single.contacts[0] / single.load_bearing[0]), 6)
    6.0
    """
    return rod_coordination(radius, share, rod_map(radius, share))


def rod_coordination(
    radius: NDArray, share: NDArray, rods: RodMap, mechanical: float = ISOSTATIC
) -> Coordination:
    r"""Return contact numbers of grains that carry load as rods of their chords push.

    .. math:: c(R) = \beta(R) \left[4 + (\kappa^* - 4)
        \frac{R^2}{\langle R^2 \rangle_{\mathrm{bearing}}}\right]

    beta is `RodMap.load_bearing`. A grain that carries load has the four contacts that it needs,
    and shares in the rest by its surface.

    Parameters
    ----------
    radius, share : ndarray, shape (K,)
        Radii [any unit], and their shares of the number of grains [-].
    rods : RodMap
        Of this grading, at jamming or beyond.
    mechanical : float
        kappa*, contacts of the grains that carry load, on average; 4 or more [-].

    Returns
    -------
    Coordination
        Contacts over all grains of the radius.

    Raises
    ------
    FitError
        When no grain carries load.

    Examples
    --------
    >>> radius, share = np.array([1.0, 0.01]), np.array([0.5, 0.5])
    >>> coordination = rod_coordination(radius, share, rod_map(radius, share))
    >>> coordination.load_bearing.round(2).tolist(), coordination.contacts.round(1).tolist()
    ([0.95, 0.0], [5.7, 0.0])
    """
    bearing = rods.load_bearing(radius)
    carrying = share * bearing
    if not carrying.sum() > 0.0:
        raise FitError("no rod of this grading pushes, so nothing carries load")
    surface = radius**2 / (carrying @ radius**2 / carrying.sum())
    contacts = STABLE_CONTACTS + (mechanical - STABLE_CONTACTS) * surface
    return Coordination(bearing * contacts, bearing)


def compressed_coordination(
    radius: NDArray, share: NDArray, strain: float
) -> tuple[Coordination, float]:
    r"""Return contact numbers at a strain beyond jamming, by rods that push.

    .. math:: \phi = \frac{\phi_J}{1 - \epsilon}, \qquad \phi_{\mathrm{map}}(f) = \phi, \qquad
        \kappa^* = 6 + 7.8 \sqrt{\phi - \phi_J}

    Parameters
    ----------
    radius, share
        As for `rod_contacts`.
    strain : float
        eps, volumetric from jamming, from 0 to below 1 - phi_J; tested up to 0.1 [-].

    Returns
    -------
    coordination : Coordination
    solid_fraction : float
        phi, of the map [-].

    Raises
    ------
    FitError
        As `rod_coordination`.
    ValueError
        As `rod_map`, and for a strain below 0 or so large that nothing but grains were left.

    Examples
    --------
    >>> coordination, phi = compressed_coordination(np.array([1.0]), np.array([1.0]), 0.05)
    >>> round(phi, 3), round(float(coordination.contacts[0]), 2)
    (0.674, 7.11)
    """
    jammed = rod_map(radius, share)
    if strain == 0.0:
        return rod_coordination(radius, share, jammed), jammed.solid_fraction
    if not 0.0 < strain < 1.0 - jammed.solid_fraction:
        limit = 1.0 - jammed.solid_fraction
        raise ValueError(f"a strain of {strain:g} beyond jamming; it must be from 0 to {limit:.3g}")
    phi = jammed.solid_fraction / (1.0 - strain)
    rods = rod_map(radius, share, gap_at(radius, share, phi, _SEARCHED))
    mechanical = float(jamming_law(phi - jammed.solid_fraction))
    return rod_coordination(radius, share, rods, mechanical), phi
