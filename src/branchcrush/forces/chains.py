"""Force chains: grains in a row that carry more than the others, and hand it on in line."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from branchcrush.packings.geometry import sphere_volume
from branchcrush.packings.network import Network

# Of a branch with the major principal stress of both of its grains [degree], and grains of a chain.
LARGEST_ANGLE = 45.0
FEWEST_GRAINS = 3


class ForceChains(NamedTuple):
    """The links of all force chains of a packing."""

    contacts: NDArray  # which contacts of the network are links, shape (K,)
    chain: NDArray  # the chain of each, from 0, shape (K,)
    grains: NDArray  # grains of that chain, shape (K,)


def grain_stress(network: Network, wall_directions: NDArray | None = None) -> NDArray:
    r"""Return the mean stress tensor of each grain.

    .. math:: \sigma_g = \frac{1}{V_g} \Bigl(\sum_{c \in g} F_c (R - \delta_c/2)\, n_c \otimes n_c
        + \sum_{w \in g} F_w (R - \delta_w)\, n_w \otimes n_w\Bigr)

    Parameters
    ----------
    network : Network
        With branch vectors.
    wall_directions : ndarray, shape (W, 3), optional
        From the grain to the wall, of unit length; needed where there are contacts with walls [-].

    Returns
    -------
    ndarray, shape (N, 3, 3)
        Compression positive [Pa].

    Raises
    ------
    ValueError
        When branch vectors or the directions of walls are missing.

    Examples
    --------
    Two grains that press each other along x feel no stress across it:

    >>> i, j, none = np.array([0]), np.array([1]), np.zeros(0)
    >>> columns = (np.array([value]) for value in (0.0, 4.0, 1.5))  # overlap, force, energy
    >>> vector = np.array([[2.0, 0.0, 0.0]])
    >>> pair = Network(np.ones(2), i, j, *columns, none.astype(int), none, none, vector)
    >>> (grain_stress(pair)[0] * 4.0 / 3.0 * np.pi).round(12).tolist()
    [[4.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]

    References
    ----------
    J. Christoffersen, M. M. Mehrabadi and S. Nemat-Nasser, J. Appl. Mech. 48, 339 (1981).
    """
    if network.vector is None or (network.wall_grain.size and wall_directions is None):
        raise ValueError("the stress of grains needs branch vectors, and the directions of walls")
    normal = network.vector / np.linalg.norm(network.vector, axis=1, keepdims=True)
    half = network.overlap / 2.0
    stress = np.zeros((network.radius.size, 3, 3))
    _add(stress, network.i, network.force * (network.radius_i - half), normal)
    _add(stress, network.j, network.force * (network.radius_j - half), normal)
    if wall_directions is not None and network.wall_grain.size:
        arm = network.radius[network.wall_grain] - network.wall_overlap
        _add(stress, network.wall_grain, network.wall_force * arm, wall_directions)
    return stress / sphere_volume(network.radius)[:, None, None]


def force_chains(network: Network, wall_directions: NDArray | None = None) -> ForceChains:
    """Return the force chains of a packing.

    A grain is highly stressed if its major principal stress is above the mean of that of all grains
    that carry load. A contact is a link if both its grains are, and the branch lies within 45
    degrees of the major principal direction of both. Links that share grains are one chain, if it
    has three grains or more.

    Parameters
    ----------
    network : Network
        With branch vectors.
    wall_directions : ndarray, shape (W, 3), optional
        As for `grain_stress` [-].

    Returns
    -------
    ForceChains
        Without links where no grain carries load. A chain may branch.

    Examples
    --------
    Three grains in a row are pressed together by walls; a fourth is only held in its place:

    >>> i, j = np.array([0, 1]), np.array([1, 2])
    >>> vectors = np.tile([2.0, 0.0, 0.0], (2, 1))
    >>> grains = np.r_[0, 2, np.repeat(np.arange(4), 4)]
    >>> forces = np.r_[np.full(2, 1.0), np.full(16, 0.1)]
    >>> directions = np.r_[[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]], np.tile([0.0, 1.0, 0.0], (16, 1))]
    >>> pushed = np.full(2, 1.0)
    >>> row = Network(np.ones(4), i, j, np.zeros(2), pushed, pushed, grains, np.zeros(18), forces,
    ...               vectors)
    >>> links = force_chains(row, directions)
    >>> links.contacts.tolist(), links.chain.tolist(), links.grains.tolist()
    ([0, 1], [0, 0], [3, 3])

    References
    ----------
    J. F. Peters, M. Muthuswamy, J. Wibowo and A. Tordesillas, Phys. Rev. E 72, 041307 (2005).
    """
    none = np.zeros(0, dtype=int)
    bearing = network.bearing
    if not bearing.any() or not network.i.size:
        return ForceChains(none, none, none)
    principal, directions = np.linalg.eigh(grain_stress(network, wall_directions))
    major, direction = principal[:, -1], directions[:, :, -1]
    stressed = bearing & (major > major[bearing].mean())
    vector = network.vector
    assert vector is not None  # grain_stress refuses a network without them
    normal = vector / np.linalg.norm(vector, axis=1, keepdims=True)
    least = np.cos(np.radians(LARGEST_ANGLE))
    along = [np.abs((normal * direction[k]).sum(axis=1)) >= least for k in (network.i, network.j)]
    links = np.flatnonzero(stressed[network.i] & stressed[network.j] & along[0] & along[1])
    i, j = network.i[links], network.j[links]
    shape = 2 * (network.radius.size,)
    _, chain = connected_components(coo_array((np.ones(i.size), (i, j)), shape), directed=False)
    grains = np.bincount(chain)[chain[i]]
    kept = grains >= FEWEST_GRAINS
    numbers = np.unique(chain[i][kept], return_inverse=True)[1]
    return ForceChains(links[kept], numbers, grains[kept])


def _add(stress: NDArray, grains: NDArray, moment: NDArray, normal: NDArray) -> None:
    """Add to the stress of grains, in place, a moment of each contact [N m] along its normal."""
    for row in range(3):
        for column in range(3):
            weight = moment * normal[:, row] * normal[:, column]
            stress[:, row, column] += np.bincount(grains, weight, len(stress))
