"""The stiffness of a network of contacts under affine motion, from contact numbers alone."""

import numpy as np
from numpy.typing import NDArray

from branchcrush.branches.coordination import Coordination
from branchcrush.packings.contact_laws import HertzContact, LinearContact, reduced_radius


def affine_modulus(
    radius: NDArray,
    share: NDArray,
    coordination: Coordination,
    solid_fraction: float,
    law: LinearContact | HertzContact,
) -> float:
    r"""Return the modulus H of the elastic energy that affine motion stores in a network.

    .. math:: H = \frac{\phi \kappa}{2 \langle V \rangle} \sum_{ij} Q_i Q_j K_{ij} (R_i + R_j)^a,
        \qquad Q_i = \frac{w_i c_i}{\kappa}, \qquad
        \Psi_{\mathrm{affine}} = \frac{H}{a} \left(\frac{\epsilon}{3}\right)^a

    With linear contacts the energy exponent a is 2 and K the stiffness, with Hertz's 5/2 and
    4/3 E* sqrt(R*). Neighbours are drawn by their own contacts. Real packings store 0.33 to 0.56
    of it, since they do not move so; its ratio between two gradings is what is of use.

    Parameters
    ----------
    radius, share : ndarray, shape (K,)
        Radii [m], and their shares of the number of grains [-].
    coordination : Coordination
        Contacts of the grains of each radius.
    solid_fraction : float
        phi [-].
    law : LinearContact or HertzContact

    Returns
    -------
    float
        [Pa]

    Examples
    --------
    Equal spheres with six contacts and k = 1: 0.64 * 6 / (2 * 4/3 pi) * 2^2.

    >>> one, six = np.array([1.0]), Coordination(np.array([6.0]), np.array([1.0]))
    >>> round(affine_modulus(one, one, six, 0.64, LinearContact(1.0)), 4)
    1.8335
    """
    contacts = share * coordination.contacts
    kappa = contacts.sum()
    touched = contacts / kappa
    pair = radius[:, None], radius[None, :]
    # The force of a contact is K delta^(a-1), so its force at an overlap of 1 is K.
    stiffness = law.force(np.ones((radius.size, radius.size)), reduced_radius(*pair))
    lengths = (pair[0] + pair[1]) ** (law.exponent + 1.0)
    mean = touched @ (stiffness * lengths) @ touched
    volume = 4.0 / 3.0 * np.pi * (share @ radius**3) / share.sum()
    return float(solid_fraction * kappa / share.sum() / (2.0 * volume) * mean)
