"""The forces of contacts in one sign: repulsion between grains, and of walls."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from branchcrush.errors import ReadingError
from branchcrush.readers.roles import Grains


def normal_forces(
    columns: Mapping[str, NDArray], vector: NDArray, length: NDArray
) -> tuple[NDArray, NDArray, float]:
    r"""Return the force on the second grain of each contact, and its normal part.

    .. math:: F = \mathbf{F} \cdot \mathbf{l} / l

    Codes differ in which of two grains a force acts on; one sign holds for the whole file.

    Parameters
    ----------
    columns : mapping of ndarray
        force, shape (M, 3), or normal_force, or both [N].
    vector : ndarray, shape (M, 3)
        Branch vector from the first grain to the second [m].
    length : ndarray, shape (M,)
        Of it [m].

    Returns
    -------
    force : ndarray, shape (M, 3)
        [N]
    normal : ndarray, shape (M,)
        Repulsion positive [N].
    tangential_share : float
        Tangential forces over normal ones, their sums [-].

    Examples
    --------
    >>> force = {"force": np.array([[-3.0, 4.0, 0.0]])}
    >>> _, normal, share = normal_forces(force, np.array([[2.0, 0.0, 0.0]]), np.array([2.0]))
    >>> normal.tolist(), round(share, 3)
    ([3.0], 1.333)
    """
    unit = vector / length[:, None]
    if "force" in columns:
        along = np.einsum("ij,ij->i", columns["force"], unit)
    else:
        along = columns["normal_force"]
    sign = 1.0 if along.sum() >= 0 else -1.0
    normal = sign * along
    if "normal_force" in columns and "force" in columns:
        scalar = columns["normal_force"]
        normal = scalar if scalar.sum() >= 0 else -scalar
    if "force" not in columns:
        return unit * normal[:, None], normal, 0.0
    force = sign * columns["force"]
    across = np.linalg.norm(force - unit * (sign * along)[:, None], axis=1).sum()
    return force, normal, float(across / max(np.abs(normal).sum(), np.finfo(float).tiny))


def attraction(grains: Grains, i: NDArray, j: NDArray, normal: NDArray) -> list[str]:
    """Return the problem of contacts that pull where most push, a line, or none.

    Parameters
    ----------
    grains : Grains
    i, j : ndarray of int, shape (M,)
        Of each contact, from 0.
    normal : ndarray, shape (M,)
        From `normal_forces` [N].

    Returns
    -------
    list of str
    """
    pulling = normal < 0
    if not pulling.any():
        return []
    worst = int(np.argmin(normal))
    return [
        f"{int(pulling.sum())} of {pulling.size} contacts pull, such as that of grains "
        f"{grains.ids[i[worst]]} and {grains.ids[j[worst]]} by {-normal[worst]:.3g} N, where most "
        "push: the energies of the contact laws here are of repulsion alone; damped or cohesive "
        "forces have to be gone"
    ]


def wall_forces(
    grains: Grains, columns: Mapping[str, NDArray], grain: NDArray
) -> tuple[NDArray, NDArray, NDArray]:
    """Return direction, overlap and normal force of contacts with walls.

    Parameters
    ----------
    grains : Grains
    columns : mapping of ndarray
        force or normal_force [N]; point, and overlap where there is one [m].
    grain : ndarray of int, shape (W,)
        The grain of each, from 0.

    Returns
    -------
    direction : ndarray, shape (W, 3)
        Of unit length, from the grain to the wall [-].
    overlap : ndarray, shape (W,)
        0 where the file does not tell it [m].
    normal : ndarray, shape (W,)
        [N]

    Raises
    ------
    ReadingError
        When no point tells where the wall is.
    """
    if not grain.size:
        return np.zeros((0, 3)), np.zeros(0), np.zeros(0)
    if "point" in columns:
        towards = columns["point"] - grains.positions[grain]
        direction = towards / np.linalg.norm(towards, axis=1)[:, None]
    else:  # the force alone may be that on the grain or that on the wall
        raise ReadingError(
            "contacts with walls need the point of contact, which tells where the wall is: give "
            "columns.point, or leave them out of the file"
        )
    if "force" in columns:
        normal = np.abs(np.einsum("ij,ij->i", columns["force"], direction))
    else:
        normal = np.abs(columns["normal_force"])
    return direction, columns.get("overlap", np.zeros(grain.size)), normal
