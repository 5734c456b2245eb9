"""Who touches whom: coordination, rattlers, stress and balance of a packing at rest."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

# A sphere in three dimensions is held in place by at least four contacts.
STABLE_CONTACTS = 4


def contact_number(i: ArrayLike, j: ArrayLike, grains: int) -> NDArray:
    r"""Return the number of contacts of each grain.

    .. math:: c_g = \sum_c (\delta_{g i_c} + \delta_{g j_c})

    Parameters
    ----------
    i, j : array_like of int, shape (M,)
        The two grains of each contact, from 0.
    grains : int
        N.

    Returns
    -------
    ndarray of int, shape (N,)

    Examples
    --------
    >>> contact_number([0, 1], [1, 2], 3).tolist()
    [1, 2, 1]
    """
    return np.bincount(i, minlength=grains) + np.bincount(j, minlength=grains)


def coordination_number(contacts: int, grains: int) -> float:
    r"""Return the mean coordination number over **all** grains, rattlers included.

    .. math:: \kappa = 2 M / N

    Parameters
    ----------
    contacts, grains : int
        M contacts between N grains. Contacts with walls are not branches and do not count.

    Returns
    -------
    float

    Examples
    --------
    >>> coordination_number(3000, 1000)
    6.0

    References
    ----------
    Paper, Eq. 3.
    """
    return 2.0 * contacts / grains


def rattlers(
    i: ArrayLike, j: ArrayLike, grains: int, wall_contacts: ArrayLike | None = None
) -> NDArray:
    """Return which grains carry no load: fewer than four contacts, removed until none is left.

    Parameters
    ----------
    i, j : array_like of int, shape (M,)
        The two grains of each contact, from 0.
    grains : int
        N.
    wall_contacts : array_like of int, shape (N,), optional
        Contacts of each grain with walls; they hold a grain as well.

    Returns
    -------
    ndarray of bool, shape (N,)

    Examples
    --------
    >>> rattlers([0], [1], 3).tolist()
    [True, True, True]
    """
    first, second = np.asarray(i, dtype=int), np.asarray(j, dtype=int)
    number = contact_number(first, second, grains)
    if wall_contacts is not None:
        number += np.asarray(wall_contacts)
    while True:
        loose = number < STABLE_CONTACTS
        lost = loose[first] | loose[second]
        if not lost.any():
            return loose
        number -= contact_number(first[lost], second[lost], grains)
        first, second = first[~lost], second[~lost]


def mechanical_coordination_number(
    i: ArrayLike, j: ArrayLike, loose: ArrayLike, wall_contacts: ArrayLike | None = None
) -> float:
    r"""Return the mean number of contacts of the grains that are not rattlers.

    .. math:: \kappa^* = (2 M^* + W^*) / N^*

    Stars count what is left when the rattlers are taken away; W* are contacts with walls.

    Parameters
    ----------
    i, j : array_like of int, shape (M,)
        The two grains of each contact, from 0.
    loose : array_like of bool, shape (N,)
        Which grains are rattlers: `rattlers` of the same contacts.
    wall_contacts : array_like of int, shape (N,), optional
        Contacts of each grain with walls.

    Returns
    -------
    float
        0 when every grain is a rattler.

    Examples
    --------
    >>> i, j = [0, 0, 0, 0, 1, 1, 1, 2, 2, 3], [1, 2, 3, 4, 2, 3, 4, 3, 4, 4]
    >>> mechanical_coordination_number(i, j, rattlers(i, j, 5))
    4.0
    """
    loose = np.asarray(loose, dtype=bool)
    if loose.all():
        return 0.0
    held = ~(loose[np.asarray(i, dtype=int)] | loose[np.asarray(j, dtype=int)])
    walls = 0 if wall_contacts is None else np.asarray(wall_contacts)[~loose].sum()
    return float((2 * held.sum() + walls) / (~loose).sum())


def mean_stress(
    branch_length: ArrayLike,
    normal_force: ArrayLike,
    volume: float,
    wall_distance: ArrayLike = (),
    wall_force: ArrayLike = (),
) -> float:
    r"""Return the mean stress, compression positive, from the branches of a packing at rest.

    .. math:: P = \frac{1}{3V} \left(\sum_c F_c l_c + \sum_w F_w d_w\right)

    Parameters
    ----------
    branch_length, normal_force : array_like, shape (M,)
        Distance of the two centres [m] and repulsive force [N] of each contact.
    volume : float
        V of the cell [m3].
    wall_distance, wall_force : array_like, shape (W,), optional
        Distance of the centre from the wall [m], and force [N], of each contact with a wall.

    Returns
    -------
    float
        [Pa]

    Examples
    --------
    >>> mean_stress([2.0], [3.0], 1.0)
    2.0
    """
    pairs = np.dot(branch_length, normal_force)
    return float((pairs + np.dot(wall_distance, wall_force)) / (3.0 * volume))


def unbalanced_force_ratio(
    net_force: ArrayLike, normal_force: ArrayLike, force_floor: float
) -> float:
    r"""Return the mean net force on the grains over the mean contact force.

    .. math:: \overline{|f_i|} \,/\, \max(\overline{F_c}, F_0)

    Parameters
    ----------
    net_force : array_like, shape (N, 3)
        [N]
    normal_force : array_like, shape (M,)
        [N]
    force_floor : float
        F_0, the mean contact force below which a packing carries no load and its own forces are
        no measure any more [N].

    Returns
    -------
    float

    Examples
    --------
    >>> unbalanced_force_ratio([[0.0, 3.0, 4.0]], [10.0], 1.0)
    0.5
    """
    normal_force = np.asarray(normal_force, dtype=float)
    contact = max(normal_force.mean() if normal_force.size else 0.0, force_floor)
    return float(np.linalg.norm(net_force, axis=1).mean() / contact)
