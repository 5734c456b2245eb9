"""The forms of the crushing model that a sample has, and what is to be known of them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from branchcrush.branches.crushing_forms import FORM_LABELS, TESTED_RATIO, crushing_forms
from branchcrush.branches.mixing import MixingPath, mixing_path
from branchcrush.branches.random_contacts import random_contact_moment
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.paper_form import DEGENERATE, admissibility_problem
from branchcrush.errors import FitError
from branchcrush.gradings.distribution import Grading
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.statistics.intervals import Interval

# Forms whose energy goes as the branch length to the power n.
_OF_AN_EXPONENT = ("paper", "density", "measured_contacts")
# Exponents among which one is sought that makes them admissible, and C that are looked at.
_LEAST, _MOST, _TRIALS = 0.5, 8.0, 16
_PLACES = np.append(0.0, np.geomspace(1e-6, 1.0, 121))
# Change with C that is rounding.
_ROUNDING = 1e-9
# So many times stiffer the fines are what carries load.
_STIFFER = 3.0


@dataclass(frozen=True)
class FormsOfSample:
    """The forms that were made, by name, why others were not, and what they are made of."""

    made: Mapping[str, ModelForm]
    missing: Mapping[str, str]  # why a form is not there
    sentences: Mapping[str, list[str]]  # what is to be known of a form
    path: MixingPath
    ratio: float  # of the largest to the smallest size [-]
    initial_moment: float  # <l^n>_0 by Eq. 4 [m^n]
    ultimate_moment: float  # <l^n>_u [m^n]

    @property
    def names(self) -> list[str]:
        """All forms in their order, made or not."""
        return list(FORM_LABELS)


def forms_of(
    initial: Grading,
    ultimate: Grading,
    exponent: float,
    law: LinearContact | HertzContact,
    numbers: pd.DataFrame,
    settings: Mapping[str, Any],
) -> FormsOfSample:
    """Return the forms of the crushing model that a sample has.

    Parameters
    ----------
    initial, ultimate : Grading
    exponent : float
        n of the energy split [-].
    law : LinearContact or HertzContact
    numbers : DataFrame
        `contact_numbers.csv`.
    settings : mapping
        The keys of the section thermodynamics.

    Returns
    -------
    FormsOfSample
    """
    missing = {}
    gap, network = settings["rod_gap"], settings["network"]
    try:
        path = mixing_path(initial, ultimate, law, network=network, gap=gap)
    except FitError as error:
        missing["moving_jamming"] = f"{error}; the other forms take what they need of it from rods"
        path = mixing_path(initial, ultimate, law, gap=gap)
    contacts = measured_contacts(numbers)
    if contacts is None:
        missing["measured_contacts"] = str(numbers["reason"].iloc[0])
    moments = [random_contact_moment(grading, exponent) for grading in (initial, ultimate)]
    problem = admissibility_problem(*moments)
    if problem is not None:
        missing["paper"] = problem
    made = crushing_forms(path, initial, ultimate, exponent, contacts)

    def of_exponent(name: str) -> Callable[[float], ModelForm]:
        return lambda n: crushing_forms(path, initial, ultimate, n, contacts)[name]

    if "tengattini" not in made:
        half = np.interp(0.5, path.crushing, path.solid_fraction)
        looser = half < path.solid_fraction[0] * (1.0 - _ROUNDING)
        missing["tengattini"] = (
            "mixtures with the ultimate grading jam looser, and its limiting densities only rise"
            if looser
            else "mixtures with the ultimate grading jam hardly denser up to C = 1/2, and its "
            "limiting densities would rise only at the end"
        )

    sentences = {
        name: [_exponent_sentence(made[name], of_exponent(name))]
        for name in _OF_AN_EXPONENT
        if name in made and name not in missing and _rises(made[name]) > _ROUNDING
    }
    (smallest, _), (_, largest) = initial.support(), ultimate.support()
    return FormsOfSample(
        made={name: form for name, form in made.items() if name not in missing},
        missing=missing,
        sentences=sentences,
        path=path,
        ratio=largest / smallest,
        initial_moment=moments[0],
        ultimate_moment=moments[1],
    )


def at_ends_of_exponent(
    name: str,
    path: MixingPath,
    initial: Grading,
    ultimate: Grading,
    exponent: Interval,
    numbers: pd.DataFrame,
) -> list[ModelForm]:
    """Return a form at both ends of the interval of n; none where n is not in it, or unknown.

    Parameters
    ----------
    name : str
        Of the form.
    path : MixingPath
    initial, ultimate : Grading
    exponent : Interval
        n of the energy split [-].
    numbers : DataFrame
        `contact_numbers.csv`.

    Returns
    -------
    list of ModelForm
    """
    if name not in _OF_AN_EXPONENT:
        return []
    ends = [end for end in (exponent.low, exponent.high) if np.isfinite(end)]
    contacts = measured_contacts(numbers)
    return [crushing_forms(path, initial, ultimate, end, contacts)[name] for end in ends]


def measured_contacts(numbers: pd.DataFrame) -> Callable[[NDArray], NDArray] | None:
    """Return the measured contact numbers at the end of the loading, as a function of radius.

    Parameters
    ----------
    numbers : DataFrame
        `contact_numbers.csv`.

    Returns
    -------
    callable or None
        c(R), between classes of radius in proportion; None where there is no data.

    Examples
    --------
    >>> table = {"state": [1, 2, 2], "mean_radius_m": [2.0, 1.0, 2.0], "contact_number": [5, 4, 6]}
    >>> measured_contacts(pd.DataFrame(table))(np.array([0.5, 1.5])).tolist()
    [4.0, 5.0]
    """
    if "reason" in numbers:
        return None
    last = numbers[numbers["state"] == numbers["state"].max()].dropna(subset=["contact_number"])
    radius, contacts = last["mean_radius_m"].to_numpy(), last["contact_number"].to_numpy(float)
    return lambda at: np.interp(at, radius, contacts)


def degenerate(theta: float) -> str | None:
    """Return what a share of almost 1 means, or None where it is less.

    Parameters
    ----------
    theta : float
        Of the paper's form [-].

    Returns
    -------
    str or None

    Examples
    --------
    >>> degenerate(0.9) is None, degenerate(0.99999).split(":")[0]
    (True, "The paper's form degenerates here")
    """
    if theta <= DEGENERATE:
        return None
    return (
        f"The paper's form degenerates here: by it complete crushing would release all but "
        f"{1.0 - theta:.1g} of the elastic energy, whatever the exponent, for it counts energy per "
        "branch and leaves out that finer grains have more branches in a volume."
    )


def untested(forms: FormsOfSample, law: LinearContact | HertzContact) -> str | None:
    """Return how far the moving jamming point is tested, or None where it is.

    Parameters
    ----------
    forms : FormsOfSample
    law : LinearContact or HertzContact

    Returns
    -------
    str or None
    """
    if forms.ratio <= TESTED_RATIO * (1.0 + 1e-9):
        return None
    told = (
        f"The largest grains are {forms.ratio:.4g} times the smallest; beyond {TESTED_RATIO:g} no "
        "form is tested against packings, and the moving jamming point is meant only up to where "
        "the fines begin to carry load."
    )
    stiffness = forms.path.modulus / forms.path.modulus[0]
    fines = np.flatnonzero(stiffness > _STIFFER)
    if not fines.size or fines[0] == 0:
        return told
    before = int(fines[0]) - 1
    told += (
        f" At equal strain it stores {stiffness[before]:.3g} times the energy at C = "
        f"{forms.path.crushing[before]:.3g}, and up to {stiffness.max():.3g} times beyond"
    )
    if isinstance(law, HertzContact):
        return f"{told}."
    return f"{told}: with one stiffness of all contacts, finer grains are stiffer."


def _rises(form: ModelForm) -> float:
    """Return the steepest rise of the energy with C; below 0 where it falls all along."""
    return float(form.factor.log_slope(_PLACES[:-1]).max())


def _exponent_sentence(form: ModelForm, of_exponent: Callable[[float], ModelForm]) -> str:
    """Return from which exponent on the energy would fall at every C."""
    from scipy.optimize import brentq  # slow to import, and few jobs need it

    trials = np.linspace(_LEAST, _MOST, _TRIALS)
    falls = [_rises(of_exponent(n)) <= _ROUNDING for n in trials]
    # From the highest exponent down, as far as all are admissible.
    first = len(falls) - int(np.argmin(falls[::-1])) if not all(falls) else 0
    if first == len(falls):
        return f"No exponent n of the energy split up to {_MOST:g} would make this form admissible."
    n = brentq(lambda n: _rises(of_exponent(n)), trials[first - 1], trials[first], xtol=1e-3)
    return f"This form would be admissible with an exponent n of the energy split from {n:.3g} on."
