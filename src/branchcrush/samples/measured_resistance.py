"""Rule measured_resistance: the resistance to crushing from a laboratory's compression curve."""

from collections.abc import Mapping

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from branchcrush.branches.crushing_forms import crushing_forms
from branchcrush.branches.mixing import MixingPath, mixing_path
from branchcrush.crushing.compression_fit import (
    CONFIDENCE,
    FEWEST_CRUSHED,
    CompressionFit,
    Family,
    Parameter,
    critical_energy_family,
    elastic_strain_family,
    fit_resistance,
)
from branchcrush.crushing.compression_line import Line, compression_line
from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.resistance import LARGEST
from branchcrush.errors import FitError
from branchcrush.files.tables import no_data
from branchcrush.gradings.distribution import Grading
from branchcrush.packings.contact_laws import HertzContact, LinearContact

# The form of which phi_J moves; the others say nothing of a void ratio.
_FORM = "moving_jamming"
# Of the fitted lines.
_POINTS = 200
# Crushing is taken to begin between these times the smallest and the largest mean stress.
_BEGINS = (0.1, 2.0)
# Names of the resistances, and of the two parameters of each.
RESISTANCES = {
    "elastic_strain_limit": ("elastic_strain", "strength_exponent"),
    "critical_energy": ("critical_energy_J_per_m3", "hardening_exponent"),
}
_WORDS = {
    "elastic_strain": "the elastic strain at which the first grains crush",
    "strength_exponent": "the exponent with which strength falls with size",
    "critical_energy_J_per_m3": "the critical energy",
    "hardening_exponent": "the exponent of hardening",
}


def resistance_results(
    stress: ArrayLike,
    strain: ArrayLike,
    before: Grading,
    ultimate: Grading,
    *,
    law: LinearContact | HertzContact,
    lateral_stress_ratio: float,
    share_of_affine: float,
    initial_void_ratio: float | None = None,
) -> tuple[pd.DataFrame | dict, pd.DataFrame | dict, dict]:
    r"""Return a compression curve beside the line of the model, and the fitted resistance.

    .. math:: p = \frac{1 + 2 K_0}{3} \sigma_a, \qquad
        p_0(\epsilon_e) = s\, \frac{H}{3^a}\, \epsilon_e^{a-1}, \qquad
        e = (1 + e_0) \frac{1 - \epsilon_e}{j(C)} - 1

    H is the modulus of affine motion on the network at jamming before the test, s the share of its
    energy that real packings store, a the energy exponent, 2 or 5/2. What jams before the test
    is what the laboratory had: rods tell by what ratio j that moves.

    Parameters
    ----------
    stress, strain : array_like, shape (n,)
        Axial [Pa], and volumetric strain from the beginning [-].
    before, ultimate : Grading
    law : LinearContact or HertzContact
    lateral_stress_ratio : float
        K_0 [-].
    share_of_affine : float
        s [-].
    initial_void_ratio : float, optional
        e_0; without it there are strains alone [-].

    Returns
    -------
    curve : DataFrame
        The points, as `compression.csv` holds them, or why there are none.
    line : DataFrame
        The fitted lines at pressures of their own, or why there are none.
    summary : dict
    """
    stress, strain = np.asarray(stress, float), np.asarray(strain, float)
    pressure = (1.0 + 2.0 * lateral_stress_ratio) / 3.0 * stress
    energy_exponent = law.exponent + 1.0
    try:
        path = mixing_path(before, ultimate, law)
        form = crushing_forms(path, before, ultimate, exponent=3.0)[_FORM]
        modulus = share_of_affine * float(path.modulus[0]) / 3.0**energy_exponent
        elasticity = PowerLawElasticity(modulus, law.exponent)
        fits = {
            name: fit_resistance(pressure, strain, form, elasticity, family)
            for name, family in _families(path, law, form, elasticity, pressure).items()
        }
    except FitError as error:
        table, why = no_data(error)
        return table, table, why
    at_points = {name: fit.line for name, fit in fits.items()}
    curve = {"stress_Pa": stress} | _columns(pressure, initial_void_ratio, at_points, strain)
    between = np.geomspace(pressure[0], pressure[-1], _POINTS)
    lines = {
        name: compression_line(between, form, elasticity, fit.resistance)
        for name, fit in fits.items()
    }
    line = _columns(between, initial_void_ratio, lines)
    jamming = float(path.solid_fraction[0])
    summary = {
        "form": _FORM,
        "contact_law": law.name,
        "lateral_stress_ratio": lateral_stress_ratio,
        "share_of_affine": share_of_affine,
        "elastic_modulus_Pa": modulus,
        "elastic_exponent": law.exponent,
        "confidence": CONFIDENCE,
        "points": int(stress.size),
        "initial_void_ratio": initial_void_ratio,
        "void_ratio_at_jamming_by_rods": 1.0 / jamming - 1.0,
        "better_resistance": min(fits, key=lambda name: fits[name].residual),
    }
    for name, fit in fits.items():
        summary |= _named(name, fit)
    sentences = _of_fits(fits) + _of_the_test(summary)
    return pd.DataFrame(curve), pd.DataFrame(line), {**summary, "sentences": sentences}


def _columns(
    pressure: NDArray,
    initial: float | None,
    lines: Mapping[str, Line],
    measured: NDArray | None = None,
) -> dict[str, NDArray]:
    """Return the columns of a table of points or of lines: strains, void ratios and C."""
    strains = {} if measured is None else {"": measured}
    strains |= {f"_{name}": line.strain for name, line in lines.items()}
    columns = {"mean_stress_Pa": pressure}
    for name, strain in strains.items():
        columns[f"volumetric_strain{name}"] = strain
        if initial is not None:
            columns[f"void_ratio{name}"] = (1.0 + initial) * (1.0 - strain) - 1.0
    return columns | {f"crushing_{name}": line.crushing for name, line in lines.items()}


def _families(
    path: MixingPath,
    law: LinearContact | HertzContact,
    form: ModelForm,
    elasticity: PowerLawElasticity,
    pressure: NDArray,
) -> Mapping[str, Family]:
    """Return the resistances that may be fitted; the pressures tell where to look."""
    ends = np.multiply(_BEGINS, pressure[[0, -1]])
    strains = np.minimum(elasticity.strain_at_pressure(ends), LARGEST)
    linear = law.name == "linear"
    return {
        "elastic_strain_limit": elastic_strain_family(
            path.crushing,
            path.contact_diameter,
            (lambda b: 1.0 - b) if linear else (lambda b: -2.0 * b / 3.0),
            tuple(strains.tolist()),
        ),
        "critical_energy": critical_energy_family(
            *form.driving_force(strains, 0.0, elasticity).tolist()
        ),
    }


def _named(resistance: str, fit: CompressionFit) -> dict:
    """Return what a fit says, by the names of `compression.json`."""
    named: dict = {}
    for name, parameter in zip(RESISTANCES[resistance], (fit.scale, fit.exponent), strict=True):
        stem, unit = name.removesuffix("_J_per_m3"), name[len(name.removesuffix("_J_per_m3")) :]
        # Of an interval without an end there is none.
        finite = [value if np.isfinite(parameter).all() else None for value in parameter[:3]]
        finite[0] = parameter.estimate
        ends = ("", "_low", "_high")
        named |= {f"{stem}{end}{unit}": value for end, value in zip(ends, finite, strict=True)}
        named[f"{stem}_determined"] = parameter.determined
    correlation = fit.correlation if np.isfinite(fit.correlation) else None
    return named | {
        f"{resistance}_correlation": correlation,
        f"{resistance}_residual": fit.residual,
        f"{resistance}_crushing_at_end": float(fit.line.crushing[-1]),
        f"{resistance}_points_crushed": fit.crushed,
    }


def _of_fits(fits: Mapping[str, CompressionFit]) -> list[str]:
    """Return which parameters the curve does not determine, and what the fits leave over."""
    said = []
    for name, fit in fits.items():
        parameters = dict(zip(RESISTANCES[name], (fit.scale, fit.exponent), strict=True))
        unknown = [_WORDS[key] for key, one in parameters.items() if not one.determined]
        called = name.replace("_", " ")
        if fit.crushed < FEWEST_CRUSHED:
            said.append(
                f"By the {called} {fit.crushed or 'none'} of {fit.line.crushing.size} points "
                f"{'is' if fit.crushed < 2 else 'are'} beyond the beginning of crushing, and two "
                "parameters pass through any two points: they are not determined. Load further, "
                "or in smaller steps."
            )
        elif unknown:
            said.append(
                f"The curve does not determine {' nor '.join(unknown)}: {_ranges(parameters)}. "
                "More points beyond the beginning of crushing would."
            )
        if fit.locked is not None:
            said.append(
                f"By the {called} C stays at {fit.line.crushing[-1]:.2f} from a mean stress of "
                f"{fit.locked / 1e6:.3g} MPa on: there the mixture with the ultimate grading is "
                "nearly as dense as it gets, and more of it would cost energy. What a sand does "
                "beyond, making finer grains than these, the model does not know."
            )
    return said


def _ranges(parameters: Mapping[str, Parameter]) -> str:
    return "; ".join(
        f"{key.removesuffix('_J_per_m3')} is from {one.low:.3g} to {one.high:.3g}"
        for key, one in parameters.items()
        if not one.determined
    )


def _of_the_test(summary: Mapping) -> list[str]:
    """Return what the test has and the model has not."""
    said = []
    initial, by_rods = summary["initial_void_ratio"], summary["void_ratio_at_jamming_by_rods"]
    if initial is not None:
        said.append(
            f"Frictionless spheres of this grading jam at a void ratio of {by_rods:.3f}, the test "
            f"began at {initial:.3f}. Friction and the shape of grains hold a sand looser, so the "
            "rods give the ratio by which the jamming point moves, from the measured beginning on."
        )
    said.append(
        "What friction lets grains rearrange before they crush is not in the model, where all "
        "strain up to the beginning of crushing is elastic: a sand that compacts before it crushes "
        "leaves residuals below the knee of the curve, and draws the fit toward earlier crushing."
    )
    ratio = summary["lateral_stress_ratio"]
    if ratio < 1.0:
        said.append(
            f"The test was not isotropic: the mean stress is taken as (1 + 2 K0)/3 = "
            f"{(1 + 2 * ratio) / 3:.3f} of the axial one with K0 = {ratio:g}, held all along. The "
            "model knows no shear, which helps grains to rearrange and to crush."
        )
    said.append(
        "The stiffness of the contacts and the share of affine motion set the scale of stress at a "
        f"given elastic strain, and are taken as given: with a stiffness twice as large the same "
        f"curve would give {0.5 ** (1 / summary['elastic_exponent']):.2f} of the elastic strain."
    )
    return said
