"""What crushing toward an ultimate grading does to the network: along mixtures by mass."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from branchcrush.branches.affine import affine_modulus
from branchcrush.branches.coordination import Coordination
from branchcrush.branches.load_bearing import rod_coordination
from branchcrush.branches.nodes import CELLS, grading_nodes
from branchcrush.branches.parking import parking_contacts
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.rods import GAP, RodMap, rod_map
from branchcrush.packings.contact_laws import HertzContact, LinearContact

Network = Literal["rods", "parking"]

# Even steps of C; with twice as many phi_J between them changes by 3e-5, and H by 0.3 % by rods.
_STEPS = 40
# Parking's time goes with pairs of radii: half of them take half of it, and H changes by 2e-4 at
# most. Its network may jump at one C, which is then known to a step, so all steps are kept.
_CELLS = {"rods": CELLS, "parking": CELLS // 2}
# A diameter of which fewer grains than this carry load counts as finer than those that do.
_SOME = 0.01


@dataclass(frozen=True)
class MixingPath:
    """The network at the jamming point of each mixture; arrays of the shape (C,).

    Parameters
    ----------
    crushing : ndarray
        C, share of the mass that is of the ultimate grading, from 0 to 1 [-].
    solid_fraction : ndarray
        phi_J by rods [-].
    modulus : ndarray
        H of affine motion, `affine.affine_modulus` [Pa].
    contact_diameter : ndarray
        d_Q, mean diameter of the grains at the ends of contacts [m].
    bearing_number, bearing_mass : ndarray
        Shares of the number and of the mass of the grains that carry load [-].
    finest : ndarray
        Diameter of the finest of which 1 % or more carry load [m].
    """

    crushing: NDArray
    solid_fraction: NDArray
    modulus: NDArray
    contact_diameter: NDArray
    bearing_number: NDArray
    bearing_mass: NDArray
    finest: NDArray


def mixing_path(
    initial: Grading,
    ultimate: Grading,
    law: LinearContact | HertzContact,
    *,
    network: Network = "rods",
    gap: float = GAP,
    crushing: NDArray | None = None,
) -> MixingPath:
    r"""Return what the mixtures of two gradings by mass are like at their jamming points.

    .. math:: P(R) \propto (1 - C) \frac{P_0(R)}{\langle R^3 \rangle_0}
        + C \frac{P_u(R)}{\langle R^3 \rangle_u}, \qquad
        d_Q = 2 \sum_i Q_i R_i, \quad Q_i = \frac{w_i c_i}{\kappa}

    Parameters
    ----------
    initial, ultimate : Grading
    law : LinearContact or HertzContact
    network : {"rods", "parking"}
        Who carries load, and with how many contacts: `load_bearing.rod_coordination`, or
        `parking.parking_contacts`.
    gap : float
        As for `gradings.rods.rod_map` [-].
    crushing : ndarray, shape (C,), optional
        C to look at, from 0 to 1; 41 even ones if left out [-].

    Returns
    -------
    MixingPath

    Raises
    ------
    FitError
        As the two networks.

    Examples
    --------
    >>> from branchcrush.gradings.forms import fractal, uniform
    >>> coarse, fine = uniform(0.5e-3, 1e-3), fractal(0.1e-3, 1e-3, 2.6)
    >>> path = mixing_path(coarse, fine, LinearContact(1e6), crushing=np.array([0.0, 0.5, 1.0]))
    >>> path.solid_fraction.round(3).tolist()
    [0.651, 0.765, 0.743]
    >>> (path.modulus / path.modulus[0]).round(1).tolist()
    [1.0, 3.8, 4.9]
    """
    if crushing is None:
        crushing = np.linspace(0.0, 1.0, _STEPS + 1)
    rows = []
    for radius, share in _mixtures(initial, ultimate, crushing, _CELLS[network]):
        rods = rod_map(radius, share, gap)
        coordination = _NETWORKS[network](radius, share, rods)
        touched, bearing = share * coordination.contacts, share * coordination.load_bearing
        rows.append(
            (
                rods.solid_fraction,
                affine_modulus(radius, share, coordination, rods.solid_fraction, law),
                2.0 * (touched @ radius) / touched.sum(),
                bearing.sum() / share.sum(),
                (bearing @ radius**3) / (share @ radius**3),
                2.0 * radius[coordination.load_bearing >= _SOME].min(initial=np.inf),
            )
        )
    return MixingPath(np.asarray(crushing, float), *np.transpose(rows))


def _by_rods(radius: NDArray, share: NDArray, rods: RodMap) -> Coordination:
    return rod_coordination(radius, share, rods)


def _by_parking(radius: NDArray, share: NDArray, rods: RodMap) -> Coordination:
    return parking_contacts(radius, share)


_NETWORKS: dict[str, Callable[[NDArray, NDArray, RodMap], Coordination]] = {
    "rods": _by_rods,
    "parking": _by_parking,
}


def _mixtures(
    initial: Grading, ultimate: Grading, crushing: NDArray, cells: int
) -> Iterator[tuple[NDArray, NDArray]]:
    """Yield radii of each mixture by mass, and their shares of the number of grains."""
    parts = [grading_nodes(grading, cells) for grading in (initial, ultimate)]
    by_mass = [share / (share @ radius**3) for radius, share in parts]
    for part in crushing:
        weights = [(1.0 - part) * by_mass[0], part * by_mass[1]]
        kept = [which for which in (0, 1) if weights[which].any()]
        share = np.concatenate([weights[which] for which in kept])
        yield np.concatenate([parts[which][0] for which in kept]), share / share.sum()
