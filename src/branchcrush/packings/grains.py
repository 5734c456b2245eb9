"""What each grain of a packing carries: elastic energy, stress, and the neighbours it has."""

import numpy as np
from numpy.typing import NDArray

from branchcrush.packings.network import Network


def grain_energy(network: Network, contact_exponent: float) -> NDArray:
    r"""Return the elastic energy of each grain.

    .. math:: e_g = \tfrac{1}{2} \sum_{c \in g} E_c + \sum_{w \in g} \frac{F_w \delta_w}{m + 1}

    Two grains of one material share the energy of their contact in equal parts; a rigid wall takes
    none.

    Parameters
    ----------
    network : Network
    contact_exponent : float
        m of F ~ overlap^m: 1 for linear contacts, 3/2 for Hertz.

    Returns
    -------
    ndarray, shape (N,)
        [J]

    Examples
    --------
    >>> i, j, none = np.array([0]), np.array([1]), np.zeros(0)
    >>> columns = (np.array([value]) for value in (0.5, 6.0, 1.5))  # overlap, force, energy
    >>> pair = Network(np.array([1.0, 2.0]), i, j, *columns, none.astype(int), none, none)
    >>> grain_energy(pair, 1.0).tolist()
    [0.75, 0.75]
    """
    of_walls = network.wall_force * network.wall_overlap / (contact_exponent + 1.0)
    return _of_grains(network, network.energy / 2.0, network.energy / 2.0, of_walls)


def grain_stress_volume(network: Network) -> NDArray:
    r"""Return the mean stress of each grain times its volume.

    .. math:: p_g V_g = \tfrac{1}{3} \left(\sum_{c \in g} F_c (R - \delta_c/2)
        + \sum_{w \in g} F_w (R - \delta_w)\right)

    The distances are those from the centre to the contact: half of the overlap of two grains is
    each one's, all of that with a rigid wall the grain's. Summed over the grains it is the mean
    stress of the packing times the volume of its cell.

    Parameters
    ----------
    network : Network

    Returns
    -------
    ndarray, shape (N,)
        [J]

    Examples
    --------
    >>> i, j, none = np.array([0]), np.array([1]), np.zeros(0)
    >>> columns = (np.array([value]) for value in (0.5, 6.0, 1.5))  # overlap, force, energy
    >>> pair = Network(np.array([1.0, 2.0]), i, j, *columns, none.astype(int), none, none)
    >>> grain_stress_volume(pair).tolist()
    [1.5, 3.5]
    """
    half = network.overlap / 2.0
    return _of_grains(
        network,
        network.force * (network.radius_i - half) / 3.0,
        network.force * (network.radius_j - half) / 3.0,
        network.wall_force * (network.radius[network.wall_grain] - network.wall_overlap) / 3.0,
    )


def neighbour_ratio(network: Network) -> NDArray:
    r"""Return each grain's radius over the mean radius of the grains that it touches.

    .. math:: x_g = R_g / \langle R \rangle_{\text{neighbours}}

    Parameters
    ----------
    network : Network

    Returns
    -------
    ndarray, shape (N,)
        [-]; nan for a grain that touches no other.

    Examples
    --------
    >>> i, j, none = np.array([0]), np.array([1]), np.zeros(0)
    >>> columns = (np.array([value]) for value in (0.5, 6.0, 1.5))  # overlap, force, energy
    >>> pair = Network(np.array([1.0, 2.0]), i, j, *columns, none.astype(int), none, none)
    >>> neighbour_ratio(pair).tolist()
    [0.5, 2.0]
    """
    sums = _of_grains(network, network.radius_j, network.radius_i)
    with np.errstate(invalid="ignore", divide="ignore"):
        return network.radius * network.contacts / sums


def _of_grains(
    network: Network, to_i: NDArray, to_j: NDArray, of_walls: NDArray | None = None
) -> NDArray:
    """Return the sum over its contacts of each grain, of what they add to either and of walls."""
    grains = network.radius.size
    total = np.bincount(network.i, to_i, grains) + np.bincount(network.j, to_j, grains)
    if of_walls is not None:
        # Not in place: the counts of no contacts are integers.
        total = total + np.bincount(network.wall_grain, of_walls, grains)
    return total
