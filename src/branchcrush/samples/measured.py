"""Rule measured: breakage from the gradings that a laboratory found before and after a test."""

import numpy as np
from numpy.typing import NDArray

from branchcrush.branches.mixing import mixing_path
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
from branchcrush.packings.contact_laws import HertzContact, LinearContact

# n of the paper's cubic law.
EXPONENT = 3.0
# Their stiffness cancels in the ratio of two gradings.
_LAWS = {"linear": LinearContact(1.0), "hertz": HertzContact(1.0)}
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
    (0.179, 0.244)

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
        **_of_gradings(before, after, ultimate),
        "hardin_breakage": None,
        "einav_breakage": None,
        "einav_breakage_down_to_0": None,
        "crushing_parameter": None,
    }
    if after is not None:
        if largest > SILT:
            results["hardin_breakage"] = hardin_breakage(before, after)
        way = (before, after, ultimate_alpha, largest)
        results["einav_breakage"] = einav_breakage(*way, ultimate_smallest)
        results["einav_breakage_down_to_0"] = einav_breakage(*way)
        moments = [random_contact_moment(grading, EXPONENT) for grading in (before, after)]
        # Of a fractal grading down to nothing all grains, by number, are fines.
        last = 0.0 if ultimate is None else random_contact_moment(ultimate, EXPONENT)
        results["crushing_parameter"] = crushing_parameter(*moments, last)
    return {**results, "sentences": _sentences(results)}


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


def _of_gradings(
    before: Grading, after: Grading | None, ultimate: Grading | None
) -> dict[str, float | None]:
    """Return sizes, jamming point and network of each grading; None of one that is not known."""
    gradings = {"before": before, "after": after, "ultimate": ultimate}
    known: dict[str, float | None] = {}
    for name, grading in gradings.items():
        row: list[float | None] = [None] * 5
        ratios: list[float | None] = [None] * len(_LAWS)
        if grading is not None:
            ends = np.array([0.0, 1.0])
            paths = [mixing_path(before, grading, law, crushing=ends) for law in _LAWS.values()]
            row = [
                particle_diameter(grading, 50.0),
                2.0 * grading.support()[1],
                float(paths[0].solid_fraction[-1]),
                float(paths[0].bearing_mass[-1]),
                float(paths[0].finest[-1]),
            ]
            ratios = [float(path.modulus[-1] / path.modulus[0]) for path in paths]
        names = (
            f"D50_{name}_m",
            f"D_max_{name}_m",
            f"jamming_solid_fraction_{name}",
            f"load_bearing_mass_{name}",
            f"finest_load_bearing_{name}_m",
        )
        known |= dict(zip(names, row, strict=True))
        if name != "before":
            laws = [f"stiffness_ratio_{law}_{name}" for law in _LAWS]
            known |= dict(zip(laws, ratios, strict=True))
    return known


def _sentences(results: dict) -> list[str]:
    """Return what the numbers do not say of themselves."""
    said = []
    hardin, einav = results["hardin_breakage"], results["einav_breakage"]
    if einav is None:
        said.append("No grading after the test is given, so there is no breakage.")
    else:
        if hardin is None:
            said.append(
                "All grains before the test are finer than 0.074 mm, below which none breaks in "
                "Hardin's sense: there is no B_r."
            )
        if einav < 0.0:
            said.append(
                "The grading after the test is coarser than the one before, so breakage is below "
                "0: are they exchanged?"
            )
        if einav > 1.0:
            said.append(
                "The grading after the test is finer than the ultimate one: its smallest size is "
                "chosen too large, or alpha too small."
            )
        said.append(
            f"What the smallest size of the ultimate grading is decides B: {einav:.3f} with "
            f"{1e3 * results['ultimate_smallest_m']:.3g} mm, "
            f"{results['einav_breakage_down_to_0']:.3f} with 0."
        )
        if (crushed := results["crushing_parameter"]) > max(_SATURATED, einav):
            said.append(
                f"C is {crushed:.4f} where B is {einav:.3f}, since its moments (Eqs. 4 and 15) "
                "count grains by number: the few percent of the mass that became fines are nearly "
                "all of the grains, and their branches nearly all of the branches. It is saturated "
                "and tells little of how far crushing has come."
            )
    said.append(
        "Solid fractions at jamming are those of frictionless spheres: a sand with friction and "
        "angular grains jams looser; ratios between gradings are what carries over."
    )
    return said
