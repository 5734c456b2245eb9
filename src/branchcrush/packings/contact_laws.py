"""Normal contacts: force and elastic energy, of two grains or of a grain and a rigid wall.

The reduced radius of two grains is R* = R_1 R_2/(R_1 + R_2); at a plane wall it is the radius.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from branchcrush.packings.geometry import Real

# Overlap over the smaller radius from which on a contact law of small overlaps is stretched [-].
OVERLAP_FLAG = 0.05


@dataclass(frozen=True)
class LinearContact:
    r"""Linear contact of one stiffness, the paper's.

    .. math:: F = k \delta, \quad E = F^2/(2 k)

    The paper's Eq. 24 leaves out the 1/2, which is right only when k is the stiffness of each of
    two equal balls. The factor cancels in f(l), not in the free energy.

    Parameters
    ----------
    stiffness : float
        k of the *contact*; two equal balls in series have 2k each [N/m].

    Examples
    --------
    >>> contact = LinearContact(4.0)
    >>> contact.force(0.5, 1.0), contact.energy(2.0, 1.0)
    (2.0, 0.5)
    """

    stiffness: float
    name = "linear"
    # F ~ overlap^m, and so the mean stress ~ (phi - phi_J)^m close to jamming.
    exponent = 1.0

    def force(self, overlap: Real, reduced_radius: Real) -> Real:
        """Return the repulsive force at an overlap.

        Parameters
        ----------
        overlap : float or ndarray, shape (M,)
            delta [m].
        reduced_radius : float or ndarray, shape (M,)
            R* [m]; it does not matter.

        Returns
        -------
        float or ndarray, shape (M,)
            F [N].
        """
        return self.stiffness * overlap

    def energy(self, force: Real, reduced_radius: Real) -> Real:
        """Return the elastic energy stored under a force.

        Parameters
        ----------
        force : float or ndarray, shape (M,)
            F, not negative [N].
        reduced_radius : float or ndarray, shape (M,)
            R* [m]; it does not matter.

        Returns
        -------
        float or ndarray, shape (M,)
            E [J].
        """
        return force**2 / (2.0 * self.stiffness)


@dataclass(frozen=True)
class HertzContact:
    r"""Hertz contact of elastic spheres.

    .. math:: F = K \sqrt{R^*}\, \delta^{3/2}, \quad E = \tfrac25 F \delta

    It holds for overlaps that are small beside the radii: `OVERLAP_FLAG`.

    Parameters
    ----------
    stiffness : float
        K = 4/3 E* of the contact [Pa].

    Examples
    --------
    >>> contact = HertzContact(2.0)
    >>> float(contact.force(1.0, 4.0)), float(contact.energy(4.0, 4.0))
    (4.0, 1.6)

    References
    ----------
    Johnson (1985), Contact Mechanics, section 4.2.
    """

    stiffness: float
    name = "hertz"
    exponent = 1.5

    @classmethod
    def of_material(cls, young_modulus: float, poisson_ratio: float) -> "HertzContact":
        r"""Return the contact of two grains of one material.

        .. math:: K = \tfrac43 E^* = \frac{2 E}{3 (1 - \nu^2)}

        Parameters
        ----------
        young_modulus : float
            E [Pa].
        poisson_ratio : float
            nu [-].

        Returns
        -------
        HertzContact

        Examples
        --------
        >>> HertzContact.of_material(3.0, 0.5).stiffness
        2.6666666666666665
        """
        return cls(2.0 * young_modulus / (3.0 * (1.0 - poisson_ratio**2)))

    def force(self, overlap: Real, reduced_radius: Real) -> Real:
        """Return the repulsive force at an overlap; without overlap it is 0.

        Parameters
        ----------
        overlap : float or ndarray, shape (M,)
            delta [m].
        reduced_radius : float or ndarray, shape (M,)
            R* [m]; of a grain at a wall its radius.

        Returns
        -------
        float or ndarray, shape (M,)
            F [N].
        """
        return self.stiffness * np.sqrt(reduced_radius) * np.maximum(overlap, 0.0) ** 1.5

    def energy(self, force: Real, reduced_radius: Real) -> Real:
        """Return the elastic energy stored under a force.

        Parameters
        ----------
        force : float or ndarray, shape (M,)
            F, not negative [N].
        reduced_radius : float or ndarray, shape (M,)
            R* [m]; of a grain at a wall its radius.

        Returns
        -------
        float or ndarray, shape (M,)
            E [J].
        """
        overlap = (force / (self.stiffness * np.sqrt(reduced_radius))) ** (2.0 / 3.0)
        return 0.4 * force * overlap


@dataclass(frozen=True)
class LawEntry:
    """What the registry knows of a contact law: how it is made, and what figures call it."""

    kind: type[LinearContact] | type[HertzContact]
    of_material: Callable[..., LinearContact | HertzContact]  # from the keys of its config section
    label: str


# A contact law is added here, in `config.schema` with its keys, and as lammps_inputs/mod.<name>.
CONTACT_LAWS = {
    "linear": LawEntry(
        LinearContact, lambda normal_stiffness: LinearContact(normal_stiffness), "linear contacts"
    ),
    "hertz": LawEntry(HertzContact, HertzContact.of_material, "Hertz contacts"),
}


def contact_law(law: str, **parameters: float) -> LinearContact | HertzContact:
    """Return the contact law that a config section names.

    Parameters
    ----------
    law : {"linear", "hertz"}
    **parameters
        normal_stiffness [N/m] of linear contacts; young_modulus [Pa] and poisson_ratio [-] of
        Hertz's.

    Returns
    -------
    LinearContact or HertzContact

    Examples
    --------
    >>> contact_law("linear", normal_stiffness=1e6)
    LinearContact(stiffness=1000000.0)
    """
    return CONTACT_LAWS[law].of_material(**parameters)


def reduced_radius(radius: Real, other: Real) -> Real:
    r"""Return R* of two grains.

    .. math:: R^* = \frac{R_1 R_2}{R_1 + R_2}

    Parameters
    ----------
    radius, other : float or ndarray, shape (M,)
        R_1 and R_2 [m].

    Returns
    -------
    float or ndarray, shape (M,)
        [m]

    Examples
    --------
    >>> reduced_radius(1.0, 1.0)
    0.5
    """
    return radius * other / (radius + other)
