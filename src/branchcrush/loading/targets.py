"""What a compression is asked for: where its states lie, and in how small steps it goes there."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.packings.geometry import cube_edge

# By quality, the largest linear strain of a step [-], and the largest mean net force over mean
# contact force of a saved state [-]. docs/quality.md tells what each is good for, measured.
STRAIN_STEPS = {"draft": 6.8e-3, "standard": 1.7e-3, "fine": 4.25e-4}
STATE_TOLERANCES = {"draft": 1.0e-6, "standard": 1.0e-6, "fine": 1.0e-7}
# Of a saved state that carries load, whatever the quality [-].
INERTIAL_TOLERANCE = 1.0e-4
# Mean net force over mean contact force [-], whatever the quality, of a strain step on the way to
# an edge, or to a stress, which must be told from the next step's.
STEP_UNBALANCED_FORCE_RATIO = {"edge": 3.0e-2, "stress": 5.0e-3}
# A step to an edge that does not get there in so many force evaluations goes on as it is. Close to
# jamming most do not: the packing moves on before it has come to rest.
STEP_FORCE_EVALUATIONS = 200
# Of a packing loaded to a stress, whose solid fraction nobody knows beforehand.
_LOADED = 0.64
STRAIN_TARGETS = ("edge_reduction", "volume_reduction", "solid_fraction")


@dataclass(frozen=True)
class Loading:
    """What a compression is asked for: a target, the states on the way, and whether it goes back.

    Examples
    --------
    >>> Loading("edge_reduction", 0.4).states
    15
    """

    target: str  # one of `STRAIN_TARGETS`, or mean_stress
    value: float | Sequence[float]  # [-]; the increasing mean stresses of the states [Pa]
    states: int = 15  # on the way to a strain; to stresses there is one at each
    approach_solid_fraction: float = 0.55  # where strain steps begin, before grains carry load [-]
    unloading: bool = False

    @property
    def stresses(self) -> list[float]:
        """Mean stresses at which states are saved [Pa]; none on the way to a strain."""
        if self.target != "mean_stress":
            return []
        return [float(value) for value in np.atleast_1d(self.value)]

    def end(self, initial_solid_fraction: float) -> float:
        """Return the solid fraction at the end, or about what a stress leads to.

        Parameters
        ----------
        initial_solid_fraction : float
            Of the loose packing [-].

        Returns
        -------
        float
            [-]

        Examples
        --------
        >>> Loading("mean_stress", [1e6]).end(0.16)
        0.64
        """
        if self.stresses:
            return _LOADED
        value = np.asarray(self.value, dtype=float).item()
        return final_solid_fraction(initial_solid_fraction, self.target, value)


def final_solid_fraction(initial_solid_fraction: float, target: str, value: float) -> float:
    r"""Return the solid fraction at the end of a path to a strain or to a solid fraction.

    .. math:: \phi = \phi_0/(1-\epsilon_l)^3 = \phi_0/(1-\epsilon_v)

    Parameters
    ----------
    initial_solid_fraction : float
        phi_0 [-].
    target : {"edge_reduction", "volume_reduction", "solid_fraction"}
    value : float
        epsilon_l of the edge, epsilon_v of the volume, or phi itself [-].

    Returns
    -------
    float
        phi [-]. Grains keep their volume: overlaps are counted twice.

    Examples
    --------
    >>> round(final_solid_fraction(0.16, "edge_reduction", 0.4), 6)
    0.740741
    """
    if target == "edge_reduction":
        return initial_solid_fraction / (1.0 - value) ** 3
    if target == "volume_reduction":
        return initial_solid_fraction / (1.0 - value)
    return value


def loading_targets(
    radii: ArrayLike, initial_solid_fraction: float, loading: Loading
) -> tuple[Literal["edge", "stress"], list[float]]:
    r"""Return what the states of a path are reached by, edges of the cell or mean stresses.

    .. math:: L_k = L_a + \frac{k}{n} (L_e - L_a), \quad k = 1 \ldots n

    L_a and L_e are the edges at the solid fractions of the approach and of the end.

    Parameters
    ----------
    radii : array_like, shape (N,)
        [m]
    initial_solid_fraction : float
        Of the loose packing [-].
    loading : Loading

    Returns
    -------
    control : {"edge", "stress"}
    targets : list of float
        In the order of the path [m] or [Pa]; with unloading the same ones back, but for the last.

    Examples
    --------
    >>> loading = Loading("solid_fraction", 0.7, 2, approach_solid_fraction=0.5, unloading=True)
    >>> control, edges = loading_targets([1.0], 0.1, loading)
    >>> control, [round(edge, 4) for edge in edges]
    ('edge', [1.9232, 1.8155, 1.9232])
    """
    control: Literal["edge", "stress"] = "stress"
    targets = loading.stresses
    if not targets:
        first = cube_edge(radii, loading.approach_solid_fraction)
        last, states = cube_edge(radii, loading.end(initial_solid_fraction)), loading.states
        control = "edge"
        targets = [first + (last - first) * k / states for k in range(1, states + 1)]
    return control, targets + (targets[-2::-1] if loading.unloading else [])


def strain_step(quality: str, refinement: float = 1) -> float:
    """Return the largest linear strain of a step.

    Parameters
    ----------
    quality : {"draft", "standard", "fine"}
    refinement : float
        By how much smaller the steps are than those of the quality [-].

    Returns
    -------
    float
        [-]

    Examples
    --------
    >>> strain_step("draft", 2)
    0.0034
    """
    return STRAIN_STEPS[quality] / refinement


def expected_overlap_ratio(
    mean_stress: float, radius: float, law: LinearContact | HertzContact
) -> float:
    r"""Return about how deep grains of one radius are pressed together under a mean stress.

    .. math:: \frac{\delta}{R} = \left(\frac{F}{F(R, R/2)}\right)^{1/m}, \quad
        F = \frac{4 \pi P R^2}{\phi \kappa}, \quad \phi = 0.64,\ \kappa = 6

    F(R, R/2) is the law at an overlap of R and the reduced radius of two such grains, m its
    exponent. It is an estimate, for overlaps that are small.

    Parameters
    ----------
    mean_stress : float
        [Pa]
    radius : float
        [m]
    law : LinearContact or HertzContact

    Returns
    -------
    float
        Overlap over radius [-].

    Examples
    --------
    >>> from branchcrush.packings.contact_laws import LinearContact
    >>> round(expected_overlap_ratio(1e6, 1e-3, LinearContact(1e6)), 5)
    0.00327
    """
    force = 4.0 * np.pi * mean_stress * radius**2 / (0.64 * 6.0)
    at_one_radius = law.force(radius, radius / 2.0)
    return float((force / at_one_radius) ** (1.0 / law.exponent))


def planned_steps(
    loading: Loading, initial_solid_fraction: float, strain_step: float, overlap: float = 0.0
) -> tuple[int, int]:
    r"""Return how many strain steps a loading takes, and how many states it saves.

    .. math:: n \left\lceil \frac{\ln(\phi_e/\phi_a)}{3 n\, s} \right\rceil, \qquad
        \left\lceil \frac{\ln(\phi_e/\phi_a)}{3 s} + \frac{\delta}{s R} \right\rceil + 4 n

    The first to n states at strains, the second to n stresses; s is the strain of a step, phi_a
    and phi_e the solid fractions of the approach and of the end.

    To strains both are known. To stresses it is an estimate: as far as grains of an overlap
    ratio would go, and some steps more to meet each stress.

    Parameters
    ----------
    loading : Loading
    initial_solid_fraction : float
        [-]
    strain_step : float
        Largest linear strain of a step [-].
    overlap : float
        Expected at the largest stress, over the radius [-].

    Returns
    -------
    steps, states : int

    Examples
    --------
    >>> planned_steps(Loading("edge_reduction", 0.4), 0.16, 1.7e-3)
    (60, 15)
    """
    strain = np.log(loading.end(initial_solid_fraction) / loading.approach_solid_fraction) / 3.0
    if loading.stresses:
        states = len(loading.stresses)
        steps = int(np.ceil(max(strain, 0.0) / strain_step + overlap / strain_step)) + 4 * states
    else:
        states = loading.states
        steps = int(np.ceil(strain / states / strain_step - 1e-6)) * states
    if loading.unloading:
        steps, states = 2 * steps, 2 * states - 1
    return steps, states
