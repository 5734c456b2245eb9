"""Rule crushing_results: what every form of the crushing model says at the simulated densities."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from branchcrush.branches.crushing_forms import FORM_LABELS, crushing_forms
from branchcrush.branches.mixing import mixing_path
from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.crushing.evolution import evolve
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.resistance import CriticalEnergy
from branchcrush.errors import FitError
from branchcrush.gradings.distribution import Grading
from branchcrush.samples.crushed_sizes import Crushable

_TOLD = ("crushing", "stress_Pa", "dissipated_J_per_m3")
_COLUMNS = ("form", "state", "solid_fraction", "volumetric_strain", *_TOLD)
# So many loaded states a power law of the stress needs.
_STATES = 3


def fitted_law(strain: NDArray, stress: NDArray) -> PowerLawElasticity:
    r"""Return the power law of packings whose grains do not break.

    .. math:: p_0 = A\, \epsilon_e^m

    A straight line of ln p over ln eps_e.

    Parameters
    ----------
    strain, stress : ndarray, shape (n,)
        eps_e [-] and p [Pa], above 0.

    Returns
    -------
    PowerLawElasticity

    Raises
    ------
    FitError
        With fewer than 3 states, or a stress that does not rise.

    Examples
    --------
    >>> law = fitted_law(np.array([0.01, 0.02, 0.04]), 1e9 * np.array([0.01, 0.02, 0.04]) ** 1.5)
    >>> round(law.exponent, 9), round(law.modulus / 1e9, 9)
    (1.5, 1.0)
    """
    if len(strain) < _STATES:
        raise FitError(f"{len(strain)} loaded states of grains that do not break, and 3 are needed")
    power, constant = np.polyfit(np.log(strain), np.log(stress), 1)
    if not power > 0.0:
        raise FitError("the stress of grains that do not break does not rise with elastic strain")
    return PowerLawElasticity(float(np.exp(constant)), float(power))


def beside_forms(
    states: pd.DataFrame,
    first: Grading,
    law: PowerLawElasticity,
    onset: float,
    sample: Crushable,
    settings: Mapping[str, Any],
) -> tuple[pd.DataFrame, list[str]]:
    r"""Return C, stress and dissipation of each form at the solid fractions of states.

    .. math:: \epsilon = 1 - \phi_J(0)/\phi, \qquad
        E_{c0} = E_C(\epsilon_e = \epsilon_0, C = 0)

    The forms go toward the fractal grading down to the comminution limit. Each is given the
    critical energy by which it begins to crush at the elastic strain eps_0 of the simulation, and
    the configured hardening: one number from the simulation, the same for all.

    Parameters
    ----------
    states : DataFrame
        Columns state and solid_fraction, by rising solid fraction.
    first : Grading
        Of all seeds before crushing.
    law : PowerLawElasticity
        Of grains that do not break.
    onset : float
        eps_0 [-].
    sample : Crushable
    settings : mapping
        hardening_exponent, rod_gap, and exponent, n of the energy split.

    Returns
    -------
    table : DataFrame
        `crushing_beside_forms.csv`.
    sentences : list of str
        Which forms are left out, and why.
    """
    ultimate = sample.ultimate(first)
    if ultimate is None:
        return no_forms(), [
            "No grain is larger than the comminution limit: no form has a way to go."
        ]
    path = mixing_path(first, ultimate, sample.law, gap=settings["rod_gap"])
    density = states["solid_fraction"].to_numpy()
    strain = 1.0 - path.solid_fraction[0] / density
    parts, said = [], []
    for name, form in crushing_forms(path, first, ultimate, settings["exponent"]).items():
        try:
            told = _along(form, law, onset, strain, settings["hardening_exponent"])
        except ValueError as error:
            said.append(f"The form “{FORM_LABELS[name]}” is not drawn: {error}.")
            continue
        where = {"form": name, "state": states["state"].to_numpy(), "solid_fraction": density}
        parts.append(pd.DataFrame(where | {"volumetric_strain": strain} | told))
    return (pd.concat(parts, ignore_index=True) if parts else no_forms()), said


def no_forms() -> pd.DataFrame:
    """Return the table of `beside_forms` without a form.

    Returns
    -------
    DataFrame

    Examples
    --------
    >>> len(no_forms())
    0
    """
    return pd.DataFrame({column: [] for column in _COLUMNS})


def _along(
    form: ModelForm,
    law: PowerLawElasticity,
    onset: float,
    strain: NDArray,
    hardening: float,
) -> dict[str, NDArray]:
    """Return what a form says at total strains; nan where the grains are apart."""
    critical = float(form.driving_force(onset, 0.0, law))
    if not critical > 0.0:
        raise ValueError("by it crushing costs elastic energy from the beginning on")
    known = strain > 0.0
    told = {name: np.full(len(strain), np.nan) for name in _TOLD}
    if known.any():
        evolution = evolve(strain[known], form, law, CriticalEnergy(critical, hardening))
        told["crushing"][known] = evolution.crushing
        told["stress_Pa"][known] = form.stress(strain[known], evolution.crushing, law)
        told["dissipated_J_per_m3"][known] = evolution.dissipated
    return told


def pooled_law(laws: Sequence[tuple[NDArray, NDArray]]) -> PowerLawElasticity:
    """Return `fitted_law` of the loaded states of all seeds.

    Parameters
    ----------
    laws : sequence of (ndarray, ndarray)
        Of `crushed_path.control_law`.

    Returns
    -------
    PowerLawElasticity

    Raises
    ------
    FitError
        As `fitted_law`.
    """
    strain, stress = (np.concatenate(values) for values in zip(*laws, strict=True))
    return fitted_law(strain, stress)
