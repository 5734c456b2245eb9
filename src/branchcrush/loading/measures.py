"""What a saved state of a compression tells, measure by measure.

Names carry their units; strains and stress are positive in compression.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from branchcrush.loading.states import Columns
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.packings.contacts import (
    coordination_number,
    mean_stress,
    mechanical_coordination_number,
    rattlers,
    unbalanced_force_ratio,
)
from branchcrush.packings.geometry import cube


def cell_measures(edge: float, first_edge: float, solid_volume: float) -> dict[str, float]:
    r"""Return the strains of the cell and how full it is.

    .. math:: \epsilon_l = 1 - L/L_0, \quad \epsilon_v = 1 - V/V_0, \quad \phi = V_s/V, \quad
        e = V/V_s - 1

    Parameters
    ----------
    edge, first_edge : float
        L, and L_0 before loading [m].
    solid_volume : float
        V_s, of all grains together, overlaps counted twice [m3].

    Returns
    -------
    dict of float
        linear_strain, volumetric_strain, solid_fraction, void_ratio [-] and volume_m3.

    Examples
    --------
    >>> cell = cell_measures(2.0, 4.0, 5.0)
    >>> [cell[name] for name in ("linear_strain", "volumetric_strain", "solid_fraction")]
    [0.5, 0.875, 0.625]
    >>> round(cell["void_ratio"], 12)
    0.6
    """
    volume = cube(edge)
    return {
        "linear_strain": 1.0 - edge / first_edge,
        "volumetric_strain": 1.0 - volume / cube(first_edge),
        "solid_fraction": solid_volume / volume,
        "void_ratio": volume / solid_volume - 1.0,
        "volume_m3": volume,
    }


def stress_measures(
    contacts: Columns, walls: Columns, radii: NDArray, edge: float, pair_pressure: float | None
) -> dict[str, float]:
    r"""Return the mean stress of the branches, and that of the boundary, which is to be the same.

    .. math:: P = \frac{1}{3V} \left(\sum_c F_c l_c + \sum_w F_w d_w\right), \qquad
        P_b = \frac{\sum_w F_w}{6 L^2}

    Parameters
    ----------
    contacts, walls : mapping of columns
        Of them branch_length_m and normal_force_N; i, overlap_m and normal_force_N.
    radii : ndarray, shape (N,)
        [m]
    edge : float
        L of the cell [m].
    pair_pressure : float or None
        P_b of a periodic cell [Pa]; None between walls, where it is the force on all six over
        their area.

    Returns
    -------
    dict of float
        mean_stress_Pa and boundary_stress_Pa.

    Examples
    --------
    >>> none = {"branch_length_m": np.zeros(0), "normal_force_N": np.zeros(0)}
    >>> walls = {"i": np.array([0, 0]), "overlap_m": np.full(2, 0.5),
    ...          "normal_force_N": np.full(2, 6.0)}
    >>> stress_measures(none, walls, np.array([1.5]), 2.0, None)
    {'mean_stress_Pa': 0.5, 'boundary_stress_Pa': 0.5}
    """
    wall_force = walls["normal_force_N"]
    stress = mean_stress(
        contacts["branch_length_m"],
        contacts["normal_force_N"],
        cube(edge),
        radii[walls["i"]] - walls["overlap_m"],
        wall_force,
    )
    on_walls = wall_force.sum() / (6.0 * edge**2)
    return {
        "mean_stress_Pa": stress,
        "boundary_stress_Pa": float(on_walls) if pair_pressure is None else pair_pressure,
    }


def energy_measures(
    contacts: Columns,
    walls: Columns,
    radii: NDArray,
    law: LinearContact | HertzContact,
    work: float,
) -> dict[str, float]:
    r"""Return the elastic energy of all contacts, the work done, and what of it was dissipated.

    .. math:: E = \sum_c E(F_c, R^*_c) + \sum_w E(F_w, R_w), \qquad D = W - E

    At a plane wall the reduced radius is the grain's own.

    Parameters
    ----------
    contacts, walls : mapping of columns
        Of them energy_J; i and normal_force_N.
    radii : ndarray, shape (N,)
        [m]
    law : LinearContact or HertzContact
    work : float
        W [J].

    Returns
    -------
    dict of float
        elastic_energy_J, work_J and dissipated_J.

    Examples
    --------
    >>> walls = {"i": np.array([0]), "normal_force_N": np.array([4.0])}
    >>> energy = {"energy_J": np.array([1.0, 2.0])}
    >>> energy_measures(energy, walls, np.array([1.0]), LinearContact(2.0), 10.0)
    {'elastic_energy_J': 7.0, 'work_J': 10.0, 'dissipated_J': 3.0}
    """
    at_walls = law.energy(walls["normal_force_N"], radii[walls["i"]]).sum()
    energy = float(contacts["energy_J"].sum() + at_walls)
    return {"elastic_energy_J": energy, "work_J": work, "dissipated_J": work - energy}


def coordination_measures(contacts: Columns, walls: Columns, grains: int) -> dict[str, float]:
    """Return the coordination numbers and the share of rattlers; walls hold a grain as well.

    Parameters
    ----------
    contacts, walls : mapping of columns
        Of them i and j; i.
    grains : int
        N.

    Returns
    -------
    dict of float
        coordination_number, mechanical_coordination_number and rattler_fraction [-].

    Examples
    --------
    >>> contacts, walls = {"i": np.array([0]), "j": np.array([1])}, {"i": np.array([0, 0, 0])}
    >>> numbers = coordination_measures(contacts, walls, 2)
    >>> numbers["coordination_number"], numbers["rattler_fraction"]
    (1.0, 1.0)
    """
    i, j = contacts["i"], contacts["j"]
    at_wall = np.bincount(walls["i"], minlength=grains)
    loose = rattlers(i, j, grains, at_wall)
    return {
        "coordination_number": coordination_number(i.size, grains),
        "mechanical_coordination_number": mechanical_coordination_number(i, j, loose, at_wall),
        "rattler_fraction": float(loose.mean()),
    }


def rest_measures(
    normal_force: NDArray,
    net_force: NDArray,
    *,
    force_floor: float,
    kinetic_energy: float,
    solid_volume: float,
    stress: float,
) -> dict[str, Any]:
    r"""Return whether the packing carries load, and how near to rest it is.

    .. math:: I = v \sqrt{\rho_s/P} = \sqrt{\frac{2 E_k}{V_s P}}

    Parameters
    ----------
    normal_force : ndarray, shape (M,)
        Of the contacts between grains [N].
    net_force : ndarray, shape (N, 3)
        On each grain [N].
    force_floor : float
        Mean contact force up to which the packing carries no load [N].
    kinetic_energy : float
        E_k, of all grains [J].
    solid_volume : float
        V_s, of all grains [m3].
    stress : float
        P [Pa].

    Returns
    -------
    dict
        mean_normal_force_N, carries_load, unbalanced_force_ratio and inertial_number, which
        without load has no meaning and is nan.

    Examples
    --------
    >>> at_rest = rest_measures(np.array([2.0]), np.zeros((2, 3)), force_floor=1.0,
    ...                         kinetic_energy=1.0, solid_volume=2.0, stress=4.0)
    >>> at_rest["carries_load"], at_rest["unbalanced_force_ratio"], at_rest["inertial_number"]
    (True, 0.0, 0.5)
    """
    mean_force = float(normal_force.mean()) if normal_force.size else 0.0
    carries_load = mean_force > force_floor
    inertial = np.sqrt(2.0 * kinetic_energy / (solid_volume * stress)) if carries_load else np.nan
    return {
        "mean_normal_force_N": mean_force,
        "carries_load": carries_load,
        "unbalanced_force_ratio": unbalanced_force_ratio(net_force, normal_force, force_floor),
        "inertial_number": float(inertial),
    }


def overlap_measures(contacts: Columns) -> dict[str, float]:
    r"""Return how deep grains are pressed together, over the smaller radius of each contact.

    .. math:: \delta / \min(R_i, R_j)

    Parameters
    ----------
    contacts : mapping of columns
        Of them overlap_m, radius_i_m and radius_j_m.

    Returns
    -------
    dict of float
        median_overlap_ratio, overlap_ratio_95 (the 95 % quantile) and max_overlap_ratio [-]; 0
        without contacts.

    Examples
    --------
    >>> contacts = {"overlap_m": [0.1, 0.2], "radius_i_m": [1.0, 4.0], "radius_j_m": [2.0, 1.0]}
    >>> contacts = {name: np.array(column) for name, column in contacts.items()}
    >>> overlap_measures(contacts)["max_overlap_ratio"]
    0.2
    """
    ratio = contacts["overlap_m"] / np.minimum(contacts["radius_i_m"], contacts["radius_j_m"])
    median, most = np.quantile(ratio, (0.5, 0.95)) if ratio.size else (0.0, 0.0)
    return {
        "median_overlap_ratio": float(median),
        "overlap_ratio_95": float(most),
        "max_overlap_ratio": float(ratio.max(initial=0.0)),
    }
