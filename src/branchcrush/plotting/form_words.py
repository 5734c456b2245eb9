"""What a figure of the crushing model says in words: what it does not show, and what to doubt."""

from collections.abc import Collection, Iterable, Mapping

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from branchcrush.branches.crushing_forms import FORM_LABELS
from branchcrush.files.tables import Table
from branchcrush.study.crushing_words import extrapolated_from

_SAME = 5e-3  # of lines that cannot be told apart


def form_notes(model: Mapping, shown: Collection[str]) -> list[str]:
    """Return in words by which forms crushing costs energy, and from where on.

    Parameters
    ----------
    model : mapping
        `thermodynamics.json`.
    shown : collection of str
        Names of forms.

    Returns
    -------
    list of str
        A sentence, or none.

    Examples
    --------
    >>> forms = {"moving_jamming": {"inadmissible_from": 0.549}}
    >>> form_notes({"forms": forms}, ["moving_jamming"])
    ['Crushing would cost elastic energy: moving jamming point, from C = 0.55.']
    """
    costly = []
    for name in (name for name in FORM_LABELS if name in shown):
        begin = model["forms"][name]["inadmissible_from"]
        if begin is not None:
            where = "at all C" if begin == 0.0 else f"from C = {begin:.2f}"
            costly.append(f"{FORM_LABELS[name]}, {where}")
    return [f"Crushing would cost elastic energy: {'; '.join(costly)}."] if costly else []


def warnings(model: Mapping) -> list[str]:
    """Return what of the model is not to be relied on, a sentence each.

    Parameters
    ----------
    model : mapping
        `thermodynamics.json`.

    Returns
    -------
    list of str

    Examples
    --------
    >>> warnings({"paper_degenerate": "It degenerates.", "untested": "A ratio of 200. At C = 0.5"})
    ['It degenerates.', 'A ratio of 200.']
    """
    said = (model.get(key) for key in ("form_reason", "paper_degenerate", "untested"))
    return [f"{sentence.split('. ')[0].rstrip('.')}." for sentence in said if sentence]


def extrapolated(forms: Table, model: Mapping) -> list[str]:
    """Return in words from which C on the form on the front yields beyond the measured strains.

    Parameters
    ----------
    forms : DataFrame
        `crushing_forms.csv`.
    model : mapping
        `thermodynamics.json`.

    Returns
    -------
    list of str
        A sentence, or none.

    Examples
    --------
    >>> import pandas as pd
    >>> strains = {"crushing": [0.0, 0.5], "yield_elastic_strain": [0.01, 0.2]}
    >>> forms = pd.DataFrame(strains).assign(form="paper")
    >>> print(*extrapolated(forms, {"form": "paper", "largest_strain": 0.1}))
    From C = 0.50 on the front form yields at elastic strains above 10 %, beyond the measured law.
    """
    begin = extrapolated_from(forms, model)
    if begin is None:
        return []
    return [
        f"From C = {begin:.2f} on the front form yields at elastic strains above "
        f"{100 * model['largest_strain']:.2g} %, beyond the measured law."
    ]


def outside(panels: Mapping[str, Axes], but: Collection[str] = ()) -> list[str]:
    """Return in words which forms lie outside of the panels, where they are admissible.

    Parameters
    ----------
    panels : mapping of str to Axes
        What each panel is of, as the sentence says it.
    but : collection of str
        Names of forms that are not told.

    Returns
    -------
    list of str
        A sentence for each panel that a form leaves.

    Examples
    --------
    >>> from branchcrush.plotting.style import axes
    >>> ax = axes()
    >>> _ = ax.plot([0, 1], [0.5, 3.0], gid="paper"), ax.plot([0, 1], [2.0, 3.0], gid="einav")
    >>> _ = ax.set_ylim(0.0, 1.0)
    >>> outside({"of the yield stress": ax})
    ['Outside the panel of the yield stress: paper, no branch density (in part); Einav, breakage.']
    """
    sentences = []
    for what, ax in panels.items():
        left = []
        for name in (name for name in FORM_LABELS if name not in but):
            points = [line.get_xydata() for line in ax.lines if line.get_gid() == name]
            if not points:
                continue
            known = (every := np.concatenate(points))[np.isfinite(every).all(axis=1)]
            ends = np.sort([ax.get_xlim(), ax.get_ylim()]).T
            inside = ((known >= ends[0]) & (known <= ends[1])).all(axis=1)
            if not inside.all():
                left.append(FORM_LABELS[name] + (" (in part)" if inside.any() else ""))
        if left:
            sentences.append(f"Outside the panel {what}: {'; '.join(left)}.")
    return sentences


def never_yield(forms: Table) -> list[str]:
    """Return in words which forms never yield, if others do.

    Parameters
    ----------
    forms : DataFrame
        `crushing_forms.csv`.

    Returns
    -------
    list of str
        A sentence, or none.

    Examples
    --------
    >>> import pandas as pd
    >>> forms = pd.DataFrame({"form": ["paper", "einav"], "yield_stress_Pa": [1e6, np.nan]})
    >>> never_yield(forms)
    ['C never grows: Einav, breakage.']
    """
    yields = np.isfinite(forms["yield_stress_Pa"]).groupby(forms["form"]).any()
    never = [name for name in FORM_LABELS if not yields.get(name, True)]
    return [f"C never grows: {_names(never)}."] if never and yields.any() else []


def yield_beyond(forms: Table, curves: Table) -> list[str]:
    """Return in words which forms yield, but not within the loading: their C stays 0 along it.

    Parameters
    ----------
    forms, curves : DataFrame
        `crushing_forms.csv` and `thermodynamics.csv`.

    Returns
    -------
    list of str
        A sentence, or none.

    Examples
    --------
    >>> import pandas as pd
    >>> forms = pd.DataFrame({"form": ["paper", "einav"], "yield_stress_Pa": [1e6, 1e7]})
    >>> curves = pd.DataFrame({"form": ["paper", "einav"], "path": "crushing",
    ...                        "crushing": [0.2, 0.0]})
    >>> yield_beyond(forms, curves)
    ['C stays 0 along the loading, which ends before yield: Einav, breakage.']
    """
    yields = np.isfinite(forms["yield_stress_Pa"]).groupby(forms["form"]).any()
    along = curves[curves["path"] == "crushing"]
    largest = along["crushing"].groupby(along["form"]).max()
    beyond = [
        name for name in FORM_LABELS if yields.get(name, False) and largest.get(name, 1.0) <= 0.0
    ]
    if not beyond:
        return []
    return [f"C stays 0 along the loading, which ends before yield: {_names(beyond)}."]


def same_yield(forms: Table) -> list[str]:
    """Return in words which forms yield at the same stress at all C, so that one line is seen.

    Parameters
    ----------
    forms : DataFrame
        `crushing_forms.csv`, with the same C in each form.

    Returns
    -------
    list of str
        A sentence for each such line.

    Examples
    --------
    >>> import pandas as pd
    >>> forms = pd.DataFrame({"form": ["einav", "tengattini"], "yield_stress_Pa": [1e6, 1e6]})
    >>> same_yield(forms)
    ['One line of yield stress: Einav, breakage; Tengattini, limiting densities.']
    """
    stress = {name: rows["yield_stress_Pa"].to_numpy() for name, rows in forms.groupby("form")}
    lines: list[list[str]] = []
    for name in (
        name for name in FORM_LABELS if name in stress and np.isfinite(stress[name]).any()
    ):
        for line in lines:
            if _one_line(stress[line[0]], stress[name]):
                line.append(name)
                break
        else:
            lines.append([name])
    return [f"One line of yield stress: {_names(line)}." for line in lines if len(line) > 1]


def _one_line(one: NDArray, other: NDArray) -> bool:
    """Return whether two lines cannot be told apart."""
    same = {"rtol": _SAME, "atol": 0.0, "equal_nan": True}
    return one.shape == other.shape and np.allclose(one, other, **same)


def _names(forms: Iterable[str]) -> str:
    return "; ".join(FORM_LABELS[name] for name in forms)
