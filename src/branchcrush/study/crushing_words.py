"""What the page says of the crushing model: forms in words, and the front one in numbers."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy as np

from branchcrush.branches.crushing_forms import FORM_LABELS
from branchcrush.files.tables import Table

# What each form says, after its name.
FORM_WORDS: Mapping[str, str] = MappingProxyType(
    {
        "moving_jamming": "fines fill voids, so the jamming point moves; stiffness by affine "
        "motion of the grains that carry load",
        "paper": "energy of a branch as lⁿ, distributions of branch length mixed; jamming point "
        "and number of branches stay",
        "density": "energy of a branch as lⁿ times branches per volume, gradings mixed by mass",
        "measured_contacts": "the same, with grains meeting by the contact numbers of the packings",
        "einav": "energy per mass of a grain as D² (of a grain as D⁵), gradings mixed by mass",
        "tengattini": "Einav's energy, and a jamming porosity that falls with breakage",
    }
)
_MARKS = np.arange(11) / 10.0


def front_rows(forms: Table, model: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return the form on the front at every tenth of C at which it is admissible.

    Parameters
    ----------
    forms : DataFrame
        `crushing_forms.csv`.
    model : mapping
        `thermodynamics.json`.

    Returns
    -------
    list of dict
        Rows of the table, those nearest to these C; none where there is no such form.

    Examples
    --------
    >>> import pandas as pd
    >>> forms = pd.DataFrame({"form": "paper", "crushing": [0.0, 0.02, 0.1, 0.2]})
    >>> model = {"form": "paper", "forms": {"paper": {"inadmissible_from": 0.15}}}
    >>> [row["crushing"] for row in front_rows(forms, model)]
    [0.0, 0.1]
    """
    if model.get("reason") or model.get("form_reason"):
        return []
    name = model["form"]
    rows = forms[forms["form"] == name].sort_values("crushing")
    end = model["forms"][name]["inadmissible_from"]
    rows = rows if end is None else rows[rows["crushing"] < end]
    at = rows["crushing"].to_numpy()
    nearest = {int(np.abs(at - mark).argmin()) for mark in _MARKS if at.size}
    return [rows.iloc[number].to_dict() for number in sorted(nearest)]


def extrapolated_from(forms: Table, model: Mapping[str, Any]) -> float | None:
    """Return from which C on the form on the front yields beyond the measured elastic strains.

    Parameters
    ----------
    forms : DataFrame
        `crushing_forms.csv`.
    model : mapping
        `thermodynamics.json`.

    Returns
    -------
    float or None
        The least such C of the table [-]; None where there is none.

    Examples
    --------
    >>> import pandas as pd
    >>> strains = {"crushing": [0.0, 0.62, 0.64], "yield_elastic_strain": [0.01, 0.2, 0.3]}
    >>> forms = pd.DataFrame(strains).assign(form="paper")
    >>> extrapolated_from(forms, {"form": "paper", "largest_strain": 0.1})
    0.62
    """
    rows = forms[forms["form"] == model["form"]]
    beyond = rows.loc[rows["yield_elastic_strain"] > model["largest_strain"], "crushing"]
    return None if beyond.empty else float(beyond.min())


def share_text(share: float | None) -> str:
    """Return a share to three digits, and one that is nearly 1 as above the last number below it.

    Examples
    --------
    >>> share_text(0.891574), share_text(0.99998), share_text(-0.25), share_text(None)
    ('0.892', 'above 0.999', '-0.25', 'none')
    """
    if share is None or share != share:
        return "none"
    return "above 0.999" if 0.9995 <= share < 1.0 else f"{share:.3g}"


def form_rows(model: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return what the table of forms shows, a row a form, in the order in which they are shown.

    Parameters
    ----------
    model : mapping
        `thermodynamics.json`.

    Returns
    -------
    list of dict
        `name`, `label`, `words`, and what the model says of the form.

    Examples
    --------
    >>> form_rows({"forms": {"einav": {"theta": 0.6}}})[0]["label"]
    'Einav, breakage'
    """
    forms = model.get("forms", {})
    return [
        {"name": name, "label": FORM_LABELS[name], "words": FORM_WORDS[name], **forms[name]}
        for name in FORM_LABELS
        if name in forms
    ]


def yes_or_no(answer: bool | None) -> str:
    """Return an answer in words.

    Examples
    --------
    >>> yes_or_no(True), yes_or_no(None)
    ('yes', 'unknown')
    """
    return "unknown" if answer is None else "yes" if answer else "no"
