"""The figures of the crushing model, a function each: result files in, one picture out.

Each is as wide as one journal column, so that it can be read on a telephone and two stand beside
each other on a page.
"""

import os
import textwrap
from collections.abc import Mapping, Sequence

from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from branchcrush.branches.crushing_forms import FORM_LABELS
from branchcrush.files.tables import Table
from branchcrush.plotting import crushing, crushing_paths
from branchcrush.plotting.form_lines import (
    beside_the_paper,
    extrapolates,
    form_handles,
    plain_decades,
)
from branchcrush.plotting.form_words import (
    extrapolated,
    form_notes,
    never_yield,
    outside,
    same_yield,
    warnings,
    yield_beyond,
)
from branchcrush.plotting.style import SIZE, drawn, figure

Path = str | os.PathLike
_CHARACTERS = 70  # of a line of words under a figure


def draw_crushing_model(
    path: Path, dpi: int, forms: Table, curves: Table, model: Mapping
) -> Figure:
    """Draw the compression line and the jamming point along it, and return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    forms, curves : DataFrame
        `crushing_forms.csv` and `thermodynamics.csv`.
    model : mapping
        `thermodynamics.json`.

    Returns
    -------
    Figure
    """
    why = model.get("reason")
    with figure(path, dpi, (SIZE[0], 5.8), (2, 1)) as panels:
        drawn(crushing.plot_compression_line, why, forms, curves, model, ax=panels[0])
        drawn(crushing.plot_jamming, why, forms, model, ax=panels[1])
        if why is None:
            shown = beside_the_paper(model)
            beyond = extrapolates(panels)
            handles = [*form_handles(model, shown, beyond=beyond), panels[0].lines[-1]]
            notes = [*form_notes(model, shown), *extrapolated(forms, model), *warnings(model)]
            notes += outside({"of solid fraction": panels[1]})
            _explain(panels[0].figure, handles, notes)
    return panels[0].figure


def draw_crushing_energy(path: Path, dpi: int, forms: Table, model: Mapping) -> Figure:
    """Draw the elastic energy along C at what may be held equal, and return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    forms : DataFrame
        `crushing_forms.csv`.
    model : mapping
        `thermodynamics.json`.

    Returns
    -------
    Figure
    """
    why = model.get("reason")
    with figure(path, dpi, (SIZE[0], 5.8), (2, 2)) as panels:
        for ax, column in zip(panels.flat, crushing.COMPARED, strict=True):
            drawn(crushing.plot_energy, why, forms, model, column, ax=ax)
        if why is None:
            _one_axis(panels)
            panels[0, 0].figure.supylabel("elastic energy over that at C = 0 [-]", fontsize=8)
            for ax in panels[1]:  # of half a column's width
                ax.set_xlabel(crushing.CRUSHING.replace(" ", "\n", 1))
            shown = set(forms["form"])
            handles = form_handles(model, shown, snaps=False)
            notes = [*form_notes(model, shown), *warnings(model)]
            names = (title.replace("\n", " ") for title in crushing.COMPARED.values())
            of = dict(zip(names, panels.flat, strict=True))
            # The axis is that of these two, as far as it goes.
            notes += outside(of, {model["form"], "paper"})
            _explain(panels[0, 0].figure, handles, notes)
    return panels[0, 0].figure


def draw_crushing_yield(
    path: Path, dpi: int, forms: Table, curves: Table, model: Mapping
) -> Figure:
    """Draw driving force, yield stress and the growth of C, and return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    forms, curves : DataFrame
        `crushing_forms.csv` and `thermodynamics.csv`.
    model : mapping
        `thermodynamics.json`.

    Returns
    -------
    Figure
    """
    why = model.get("reason")
    with figure(path, dpi, (SIZE[0], 7.0), (3, 1)) as panels:
        drawn(crushing.plot_driving_force, why, forms, model, ax=panels[0])
        drawn(crushing.plot_yield_stress, why, forms, model, ax=panels[1])
        drawn(crushing_paths.plot_crushing, why, curves, model, ax=panels[2])
        if why is None:
            shown = set(forms["form"])
            handles = form_handles(model, shown, beyond=extrapolates(panels))
            notes = [*form_notes(model, shown), *extrapolated(forms, model), *never_yield(forms)]
            notes += yield_beyond(forms, curves)
            of = {"of driving force": panels[0], "of yield stress": panels[1]}
            _explain(panels[0].figure, handles, [*notes, *same_yield(forms), *outside(of)])
    return panels[0].figure


def draw_crushing_path(path: Path, dpi: int, curves: Table, model: Mapping) -> Figure:
    """Draw stress, resistance and energies along the strain, and return the figure.

    Parameters
    ----------
    path : path-like
        A PNG file.
    dpi : int
    curves : DataFrame
        `thermodynamics.csv`.
    model : mapping
        `thermodynamics.json`.

    Returns
    -------
    Figure
    """
    why = model.get("reason") or model.get("form_reason")
    with figure(path, dpi, (SIZE[0], 7.0), (3, 1)) as panels:
        drawn(crushing_paths.plot_stress, why, curves, model, ax=panels[0])
        drawn(crushing_paths.plot_resistance, why, curves, model, ax=panels[1])
        drawn(crushing_paths.plot_work, why, curves, model, ax=panels[2])
        if why is None:
            panels[0].figure.suptitle(f"form: {FORM_LABELS[model['form']]}", fontsize=8)
    return panels[0].figure


def _one_axis(panels) -> None:
    """Give all panels the limits that show all of them."""
    low, high = zip(*(ax.get_ylim() for ax in panels.flat), strict=True)
    for ax in panels.flat:
        ax.set_ylim(min(low), max(high))
        plain_decades(ax.yaxis)
        ax.label_outer()


def _explain(drawing: Figure, handles: Sequence[Line2D], notes: Sequence[str]) -> None:
    """Put one legend above all panels, and words below them."""
    close = {"columnspacing": 1.0, "handlelength": 1.6, "fontsize": 6}
    drawing.legend(handles=handles, loc="outside upper left", ncols=2, **close)
    if notes:
        text = "\n".join(textwrap.fill(note, _CHARACTERS) for note in notes)
        drawing.supxlabel(text, x=0.01, ha="left", fontsize=6)
        # Panels are no lower for many words.
        drawing.set_figheight(drawing.get_figheight() + (text.count("\n") + 1) * 7.2 / 72.0)
