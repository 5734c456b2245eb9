"""Rule measured: breakage from the gradings that a laboratory found before and after a test."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from branchcrush.branches.affine import affine_modulus
from branchcrush.branches.load_bearing import rod_coordination
from branchcrush.branches.nodes import grading_nodes
from branchcrush.branches.random_contacts import random_contact_moment
from branchcrush.crushing.breakage import (
    SILT,
    crushing_parameter,
    einav_breakage,
    hardin_breakage,
)
from branchcrush.gradings.curves import particle_diameter
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.forms import fractal
from branchcrush.gradings.rods import rod_map
from branchcrush.packings.contact_laws import HertzContact, LinearContact

# n of the paper's cubic law.
EXPONENT = 3.0
# Their stiffness cancels in the ratio of two gradings.
_LAWS = {"linear": LinearContact(1.0), "hertz": HertzContact(1.0, 0.0)}
# Where the paper's C says little about the state of crushing.
_SATURATED = 0.9
_POINTS = 300


def breakage_results(
    before: Grading, after: Grading | None, *, ultimate_alpha: float, ultimate_smallest: float
) -> dict:
    r"""Return how far crushing has come by Hardin, Einav and the paper, and what both gradings are.

    .. math:: C = \frac{\langle l^3 \rangle_0 - \langle l^3 \rangle}
        {\langle l^3 \rangle_0 - \langle l^3 \rangle_u}, \qquad
        S = \frac{H_{\mathrm{after}}}{H_{\mathrm{before}}}

    The moments are those of Eq. 4. Solid fractions at jamming and the modulus H of affine motion
    are by rods, of frictionless spheres.

    Parameters
    ----------
    before, after : Grading
        No grading after the test (None) leaves all out that needs it.
    ultimate_alpha : float
        Fractal dimension of the ultimate grading [-].
    ultimate_smallest : float
        Its smallest radius, 0 or more [m]; its largest is that of the grading before.

    Returns
    -------
    dict
        As `breakage.json` holds it; None for what is not known.

    Examples
    --------
    >>> from branchcrush.gradings.forms import uniform
    >>> before, after = uniform(0.5e-3, 1e-3, "mass"), uniform(0.05e-3, 1e-3, "mass")
    >>> results = breakage_results(before, after, ultimate_alpha=2.6, ultimate_smallest=0.0)
    >>> round(results["hardin_breakage"], 3), round(results["einav_breakage"], 3)
    (0.152, 0.205)

    References
    ----------
    Hardin (1985), J. Geotech. Eng. 111, 1177-1192; Einav (2007), J. Mech. Phys. Solids 55,
    1274-1297; paper, Eqs. 4 and 15.
    """
    largest = before.support()[1]
    ultimate = ultimate_of(before, ultimate_alpha, ultimate_smallest)
    results = {
        "ultimate_alpha": ultimate_alpha,
        "ultimate_smallest_m": 2.0 * ultimate_smallest,
        "ultimate_largest_m": 2.0 * largest,
        "hardin_limit_m": 2.0 * SILT,
        "energy_exponent": EXPONENT,
        **_of_gradings({"before": before, "after": after, "ultimate": ultimate}),
        "hardin_breakage": None,
        "einav_breakage": None,
        "einav_breakage_down_to_0": None,
        "crushing_parameter": None,
    }
    if after is not None:
        if 2.0 * largest > 2.0 * SILT:
            results["hardin_breakage"] = hardin_breakage(before, after)
        way = (before, after, ultimate_alpha, largest)
        results["einav_breakage"] = einav_breakage(*way, ultimate_smallest)
        results["einav_breakage_down_to_0"] = einav_breakage(*way)
        moments = [random_contact_moment(grading, EXPONENT) for grading in (before, after)]
        # Of a fractal grading down to nothing all grains, by number, are fines.
        last = 0.0 if ultimate is None else random_contact_moment(ultimate, EXPONENT)
        results["crushing_parameter"] = crushing_parameter(*moments, last)
    return {**results, "sentences": _sentences(results, after is not None)}


def ultimate_of(before: Grading, alpha: float, smallest: float) -> Grading | None:
    """Return the grading that crushing ends in, or None where its smallest grain has no size.

    Parameters
    ----------
    before : Grading
    alpha : float
        Fractal dimension [-].
    smallest : float
        Radius [m].

    Returns
    -------
    Grading or None

    Examples
    --------
    >>> from branchcrush.gradings.forms import uniform
    >>> ultimate_of(uniform(0.5, 1.0), 2.6, 0.01).support()
    (0.01, 1.0)
    """
    return fractal(smallest, before.support()[1], alpha) if smallest > 0.0 else None


def grading_curves(gradings: dict[str, Grading | None]) -> dict[str, NDArray]:
    """Return the percent of the mass that is finer, of gradings side by side.

    Parameters
    ----------
    gradings : dict of Grading
        By name; None of one is left out.

    Returns
    -------
    dict of ndarray, shape (n,)
        diameter_m, even in its logarithm, and percent_finer_by_mass_<name>.

    Examples
    --------
    >>> from branchcrush.gradings.forms import uniform
    >>> table = grading_curves({"before": uniform(0.5, 1.0), "after": None})
    >>> list(table), float(table["percent_finer_by_mass_before"][-1])
    (['diameter_m', 'percent_finer_by_mass_before'], 100.0)
    """
    known = {name: grading for name, grading in gradings.items() if grading is not None}
    ends = np.array([grading.support() for grading in known.values()])
    start, end = ends.min(), ends.max()
    if not all(grading.has_density for grading in known.values()):
        # The steps at single sizes stand clear of the ends.
        start, end = 0.9 * start, 1.1 * end
    radius = np.geomspace(start, end, _POINTS)
    return {"diameter_m": 2.0 * radius} | {
        f"percent_finer_by_mass_{name}": 100.0 * grading.mass_cdf(radius)
        for name, grading in known.items()
    }


def _of_gradings(gradings: dict[str, Grading | None]) -> dict[str, float | None]:
    """Return sizes, jamming point and stiffness of each grading, None of one that is not known."""
    known: dict[str, float | None] = {}
    moduli: dict[str, dict[str, float]] = {}
    for name, grading in gradings.items():
        numbers = ("D10", "D50", "D_max", "jamming_solid_fraction", "stiffness")
        d10, d50, d_max, jamming, _ = (None,) * len(numbers) if grading is None else (0.0,) * 5
        if grading is not None:
            radius, share = grading_nodes(grading)
            rods = rod_map(radius, share)
            bearing = rod_coordination(radius, share, rods)
            jamming = rods.solid_fraction
            moduli[name] = {
                law_name: affine_modulus(radius, share, bearing, jamming, law)
                for law_name, law in _LAWS.items()
            }
            d10, d50 = (particle_diameter(grading, percent) for percent in (10.0, 50.0))
            d_max = 2.0 * grading.support()[1]
        known |= {f"D10_{name}_m": d10, f"D50_{name}_m": d50, f"D_max_{name}_m": d_max}
        known[f"jamming_solid_fraction_{name}"] = jamming
    for name in ("after", "ultimate"):
        for law in _LAWS:
            ratio = moduli[name][law] / moduli["before"][law] if name in moduli else None
            known[f"stiffness_ratio_{law}_{name}"] = ratio
    return known
