"""How a grading goes while its grains break, from strengths and contacts alone: no simulation."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from branchcrush.branches.coordination import Coordination
from branchcrush.branches.coordination_laws import jamming_law
from branchcrush.branches.load_bearing import rod_coordination
from branchcrush.branches.nodes import grading_nodes
from branchcrush.branches.uniform_stress import ForceNetwork, force_network
from branchcrush.breakage.rules import Breakage
from branchcrush.breakage.shares import fragment_shares, split_by_size, weibull_bins
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.rods import gap_at, rod_map
from branchcrush.packings.contact_laws import HertzContact, LinearContact

# Classes of size to a factor e, bins of strength in each, and the step of ln(phi).
CLASSES, STRENGTHS, STEP = 20, 50, 1e-3
# Rods that the gap beyond jamming is sought with, and that tell who pushes there.
_SEARCHED, _PUSHING = 1_000, 2_000
# Levels to a factor 2 of the forces where a grain broke, and the largest: grains that break under
# forces that many times the usual ones have next to no mass.
_LEVELS, _MOST = 2, 64.0


@dataclass(frozen=True)
class CrushingGradings:
    """A grading along its crushing, S states of K classes of size.

    Parameters
    ----------
    diameter : ndarray, shape (K,)
        Of the classes, rising [m].
    mass : ndarray, shape (S, K)
        Share of each class [-].
    solid_fraction, jamming : ndarray, shape (S,)
        phi, and phi_J of the grading there is [-].
    elastic_strain : ndarray, shape (S,)
        eps_e = 1 - phi_J/phi [-].
    mean_stress : ndarray, shape (S,)
        p [Pa].
    coordination_number : ndarray, shape (S,)
        kappa, rattlers counted [-].
    broken_mass : ndarray, shape (S,)
        Share of the mass that is fragments [-].
    dissipated : ndarray, shape (S,)
        Of the volume at jamming before crushing [J/m3].
    """

    diameter: NDArray
    mass: NDArray
    solid_fraction: NDArray
    jamming: NDArray
    elastic_strain: NDArray
    mean_stress: NDArray
    coordination_number: NDArray
    broken_mass: NDArray
    dissipated: NDArray

    @property
    def void_ratio(self) -> NDArray:
        """Pores over grains, e [-]."""
        return 1.0 / self.solid_fraction - 1.0

    @property
    def grains(self) -> NDArray:
        """Grains over those before crushing [-]."""
        number = (self.mass / self.diameter**3).sum(axis=1)
        return number / number[0]

    def grading(self, state: int) -> Grading:
        """Return the grading of a state, of single radii."""
        held = self.mass[state] > 0.0
        radius = self.diameter[held] / 2.0
        return Grading(radii=radius, weights=self.mass[state][held] / radius**3)


class _State(NamedTuple):
    """A row of the result, in the order of its columns."""

    mass: NDArray
    solid_fraction: float
    jamming: float
    elastic_strain: float
    mean_stress: float
    coordination_number: float
    broken_mass: float


def crushing_gradings(
    grading: Grading,
    law: LinearContact | HertzContact,
    rules: Breakage,
    solid_fraction: float,
    *,
    classes: int = CLASSES,
    strengths: int = STRENGTHS,
    step: float = STEP,
    renewals: float | None = None,
) -> CrushingGradings:
    r"""Return how a grading is crushed under compression, from its grains' strengths.

    .. math:: \epsilon_e = 1 - \frac{\phi_J}{\phi}, \quad
        d\nu = \frac{p\, d\ln\phi}{\Psi} = a \frac{d\ln\phi}{\epsilon_e}, \quad
        d \ln N(d, w) = \ln\left[1 - P(d, w)\right] d\nu

    phi_J is that of rods, p and the forces are those of `uniform_stress`, and P is the share of
    the grains of a diameter and a Weibull factor that a force breaks. The forces are drawn anew
    each time as much work is done as is stored. Fragments are those of
    `breakage.fragments.packed_spheres`, with strengths of their own. They are where the force was
    large enough to break their parent: at first they are drawn forces that are larger by
    F_c over the mean largest force on grains of the parent's size, where this is above 1.

    Parameters
    ----------
    grading : Grading
        Before crushing.
    law : LinearContact or HertzContact
    rules : Breakage
        Of it the strength, the smallest diameter that breaks and the number of fragments.
    solid_fraction : float
        phi that the compression goes to [-].
    classes, strengths : int
        Classes of size to a factor e, and bins of equal numbers of Weibull's w in each.
    step : float
        Of ln(phi) [-].
    renewals : float, optional
        In the place of a, the exponent of energy: 2 with linear contacts, 5/2 with Hertz's [-].

    Returns
    -------
    CrushingGradings
        From the jamming point on.

    Raises
    ------
    ValueError
        When grains break by another criterion than the largest force, or the packing is to go no
        farther than where it jams.
    FitError
        As `load_bearing.rod_coordination`.

    Examples
    --------
    >>> from branchcrush.breakage.strength import Strength
    >>> from branchcrush.gradings.forms import uniform
    >>> sand = Strength(strength=2e7, weibull_modulus=3.0, reference_diameter=1e-3,
    ...                 size_exponent=1.0)
    >>> rules = Breakage(strength=sand, smallest_diameter=2.5e-4)
    >>> path = crushing_gradings(uniform(0.4e-3, 0.6e-3), LinearContact(1e6), rules, 0.68,
    ...                          classes=8, strengths=10, step=4e-3)
    >>> bool(path.grains[-1] > 2.0), round(float(path.mass[-1].sum()), 12)
    (True, 1.0)
    """
    if rules.criterion != "largest_force":
        raise ValueError(
            f"breakage.criterion is {rules.criterion}; gradings are predicted for largest_force "
            "alone, since the model knows the size of forces and not their directions"
        )
    nodes, share = grading_nodes(grading)
    diameter = _classes(2.0 * nodes, rules, classes)
    mass = split_by_size(2.0 * nodes, share * nodes**3, diameter)
    strength = rules.strength.of(diameter[:, None], weibull_bins(rules.strength, strengths))
    largest = strength * diameter[:, None] ** 2
    largest[diameter <= rules.smallest_diameter] = np.inf
    turns = law.exponent + 1.0 if renewals is None else renewals
    states = list(
        _states(
            diameter,
            mass / mass.sum(),
            largest,
            fragment_shares(diameter, rules),
            law,
            (solid_fraction, step, turns),
        )
    )
    columns = [np.array(column) for column in zip(*states, strict=True)]
    mass, phi, jamming, strain, stress, kappa, broken = columns
    lost = _dissipated(jamming, stress)
    return CrushingGradings(diameter, mass, phi, jamming, strain, stress, kappa, broken, lost)


def _states(
    diameter: NDArray,
    mass: NDArray,
    largest: NDArray,
    shares: NDArray,
    law: LinearContact | HertzContact,
    march: tuple[float, float, float],
) -> Iterator[_State]:
    """Yield a state after each step; whole grains and fragments are kept by class and strength."""
    target, step, turns = march
    first = np.repeat(mass[:, None] / largest.shape[1], largest.shape[1], axis=1)
    later = np.zeros_like(first)
    phi = 0.0
    while True:
        mass = (first + later).sum(axis=1)
        held = mass > 0.0
        radius, number = diameter[held] / 2.0, mass[held] / diameter[held] ** 3
        number = number / number.sum()
        jamming = rod_map(radius, number).solid_fraction
        if not phi:
            phi = jamming
            if not phi < target < 1.0:
                raise ValueError(
                    f"the solid fraction must be above {phi:.4g}, where this grading jams, and "
                    f"below 1: {target:g}"
                )
        strain = max(1.0 - jamming / phi, 0.0)
        coordination = _coordination(radius, number, jamming, phi)
        network = force_network(radius, number, coordination, phi, law)
        stress = float(network.stress(strain))
        kappa = float(number @ coordination.contacts)
        yield _State(mass, phi, jamming, strain, stress, kappa, float(later.sum()))
        if phi >= target:
            return
        after = min(phi * np.exp(step), target)
        # Half way through the step, before anything breaks.
        middle = 0.5 * (strain + 1.0 - jamming / after)
        if middle > 0.0:
            stress = float(network.stress(middle))
            broken, born = np.zeros_like(first), np.zeros_like(first)
            share = network.overloaded(largest[held], stress)
            turned = turns * np.log(after / phi) / middle
            broken[held] = -np.expm1(turned * np.log1p(-np.minimum(share, 1.0 - 1e-15)))
            gone = broken * (first + later)
            for local, mass in _places(gone[held], largest[held], network, stress):
                there = np.zeros_like(first)
                there[held] = network.overloaded(largest[held], local * stress)
                born += _fragments(_spread(mass, held), shares, there)
            first = first - broken * first
            later = later - broken * later + born
        phi = after


def _places(
    gone: NDArray, largest: NDArray, network: ForceNetwork, stress: float
) -> Iterator[tuple[float, NDArray]]:
    """Yield by how much forces are larger where grains broke, and the mass there by class."""
    usual = stress * network.largest_force[:, None]
    # What never breaks has an infinite strength and no mass here.
    over = np.where(gone > 0.0, largest, usual) / np.maximum(usual, 1e-300)
    level = np.round(_LEVELS * np.log2(np.clip(over, 1.0, _MOST))).astype(int)
    for place in np.unique(level):
        yield 2.0 ** (place / _LEVELS), np.where(level == place, gone, 0.0).sum(axis=1)


def _fragments(mass: NDArray, shares: NDArray, overloaded: NDArray) -> NDArray:
    """Return by class and strength what grains break into; what is overloaded breaks at once."""
    whole = np.zeros_like(overloaded)
    born = mass @ shares
    while born.any():  # every fragment is finer, and the finest never break
        fresh = np.repeat(born[:, None] / whole.shape[1], whole.shape[1], axis=1)
        whole += fresh * (1.0 - overloaded)
        born = (fresh * overloaded).sum(axis=1) @ shares
    return whole


def _spread(values: NDArray, held: NDArray) -> NDArray:
    """Return the values of the classes that hold grains among all classes."""
    every = np.zeros(held.size)
    every[held] = values
    return every


def _coordination(radius: NDArray, number: NDArray, jamming: float, phi: float) -> Coordination:
    """Return contact numbers by rods that push, beyond jamming or at it."""
    # Where the packing is a hair looser than its grading jams, it is taken where it jams.
    gap = gap_at(radius, number, max(phi, jamming), _SEARCHED)
    rods = rod_map(radius, number, gap, _PUSHING)
    return rod_coordination(radius, number, rods, float(jamming_law(max(phi - jamming, 0.0))))


def _classes(diameter: NDArray, rules: Breakage, classes: int) -> NDArray:
    """Return even classes in ln(d), from the finest there can be to the largest there is."""
    least = min(rules.finest_diameter, float(diameter.min()))
    largest = float(diameter.max())
    return np.geomspace(least, largest, int(np.ceil(np.log(largest / least) * classes)) + 2)


def _dissipated(jamming: NDArray, stress: NDArray) -> NDArray:
    """Return the integral of p (phi_J0/phi_J) dln(phi_J), by the middles of the steps."""
    middle = 0.5 * (stress[1:] / jamming[1:] + stress[:-1] / jamming[:-1]) * jamming[0]
    return np.append(0.0, np.cumsum(middle * np.diff(np.log(jamming))))
