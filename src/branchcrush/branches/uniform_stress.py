"""Forces on the contacts of a grading whose grains that carry load all bear one mean stress."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import gammaln

from branchcrush.branches.coordination import Coordination
from branchcrush.packings.contact_laws import HertzContact, LinearContact, reduced_radius

# Shape of the gamma distribution of a force over its mean: (1 + 2x) exp(-2x) are above x.
FORCE_SHAPE = 2.0
# Of forces over their means, up to which their largest is sought, and how finely.
_LARGEST_RATIO, _RATIOS = 20.0, 101


@dataclass(frozen=True)
class ForceNetwork:
    r"""Mean forces on the contacts of grains of some radii, and how stiff the network is.

    .. math:: \bar F(R) = \frac{4 \pi R^2 p}{\phi\, m_b\, c(R)}, \qquad
        F_{ij} = \frac{\bar F(R_i) \bar F(R_j)}{\sum Q \bar F}\, \xi, \qquad
        P(\xi > x) = (1 + 2x) e^{-2x}

    All arrays of the radii that carry load.

    Parameters
    ----------
    touched : ndarray, shape (K,)
        Q, share of the ends of contacts [-].
    contacts : ndarray, shape (K,)
        c of the grains that carry load [-].
    bearing : ndarray, shape (K,)
        beta, share of the grains that carry load [-].
    force : ndarray, shape (K,)
        Mean force on a contact over the mean stress [m2].
    softness : float
        eps_e p^(-1/m) [Pa^(-1/m)]
    exponent : float
        m of the contact law, p ~ eps_e^m [-].
    """

    touched: NDArray
    contacts: NDArray
    bearing: NDArray
    force: NDArray
    softness: float
    exponent: float

    @cached_property
    def largest_force(self) -> NDArray:
        """Mean of the largest force on a grain that carries load, over the mean stress [m2]."""
        ratio = np.linspace(0.0, _LARGEST_RATIO, _RATIOS)
        above = self.overloaded(self.force[:, None] * ratio, 1.0)
        carrying = np.where(self.bearing > 0.0, self.bearing, 1.0)
        return self.force * np.trapezoid(above, ratio, axis=1) / carrying

    def stress(self, strain: ArrayLike) -> NDArray:
        """Return the mean stress p at elastic strains [Pa]."""
        return (np.asarray(strain, float) / self.softness) ** self.exponent

    def overloaded(self, largest: NDArray, stress: float) -> NDArray:
        r"""Return the share of the grains on which a contact bears more than they do.

        .. math:: P = \beta \left\{1 - \left[1 - \sum_j Q_j
            P\left(\xi > \frac{F_c}{F_{ij}}\right)\right]^{c}\right\}

        Parameters
        ----------
        largest : ndarray, shape (K, W)
            F_c, force that breaks a grain, of each radius and each strength [N].
        stress : float
            p [Pa].

        Returns
        -------
        ndarray, shape (K, W)
            [-]
        """
        if not stress > 0.0:
            return np.zeros(largest.shape)
        pair = stress * np.outer(self.force, self.force) / (self.touched @ self.force)
        over = np.zeros(largest.shape)
        for share, mean in zip(self.touched, pair.T, strict=True):
            if share > 0.0:
                with np.errstate(divide="ignore"):
                    over += share * _above(largest / mean[:, None])
        one = self.contacts[:, None] * np.log1p(-np.minimum(over, 1.0 - 1e-15))
        return -self.bearing[:, None] * np.expm1(one)


def force_network(
    radius: NDArray,
    share: NDArray,
    coordination: Coordination,
    solid_fraction: float,
    law: LinearContact | HertzContact,
) -> ForceNetwork:
    r"""Return the forces of a grading whose grains that carry load all bear the same stress.

    .. math:: \epsilon_e = \frac{3 \langle F \delta \rangle}{\langle F l \rangle}

    This is a Psi/p with p = n <F l>/3 and Psi = n <F delta>/a, so what the network stores and what
    it bears decide its stiffness, whatever moves. With F = K delta and equal spheres
    p = p_affine/<xi^2>.

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
    ForceNetwork

    Examples
    --------
    Equal spheres with six contacts bear 1/1.5 of what affine motion says, H/9 of 1.8335/9.

    >>> one, six = np.array([1.0]), Coordination(np.array([6.0]), np.array([1.0]))
    >>> network = force_network(one, one, six, 0.64, LinearContact(1.0))
    >>> round(float(network.stress(0.01)) / 0.01 * 1.5 * 9, 4)
    1.8335
    """
    bears = coordination.load_bearing > 1e-12
    bearing = np.where(bears, coordination.load_bearing, 0.0)
    contacts = np.divide(coordination.contacts, bearing, out=np.full(radius.size, 4.0), where=bears)
    touched = share * bearing * contacts
    touched = touched / touched.sum()
    mass = share * radius**3
    bearing_mass = float(mass @ bearing / mass.sum())
    force = 4.0 * np.pi * radius**2 / (solid_fraction * bearing_mass * contacts)
    pair = np.outer(force, force) / (touched @ force)
    reduced = reduced_radius(radius[:, None], radius[None, :])
    power = 1.0 / law.exponent
    # F delta of the mean force, times the moment of a force over its mean.
    stored = pair * (pair / law.force(np.ones_like(pair), reduced)) ** power
    moment = np.exp(gammaln(FORCE_SHAPE + 1.0 + power) - gammaln(FORCE_SHAPE))
    moment *= FORCE_SHAPE ** -(1.0 + power)
    borne = touched @ (pair * np.add.outer(radius, radius)) @ touched
    softness = 3.0 * moment * float(touched @ stored @ touched) / borne
    return ForceNetwork(touched, contacts, bearing, force, float(softness), law.exponent)


def _above(ratio: NDArray) -> NDArray:
    doubled = np.minimum(FORCE_SHAPE * ratio, 800.0)  # infinite of grains that never break
    return (1.0 + doubled) * np.exp(-doubled)
