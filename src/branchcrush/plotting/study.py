"""All samples of a study in one figure: a colour for each grading, a line for each boundary."""

from collections.abc import Mapping
from itertools import takewhile

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from branchcrush.branches.predictions import PREDICTIONS
from branchcrush.energy.predictors import PREDICTORS
from branchcrush.energy.split import PAPER_EXPONENT
from branchcrush.files.tables import Table
from branchcrush.packings.contact_laws import CONTACT_LAWS
from branchcrush.plotting.intervals import draw_band
from branchcrush.plotting.style import FAINT, axes, widen
from branchcrush.study.kinds import SampleKind
from branchcrush.study.results import NOT_CERTIFIED
from branchcrush.study.verdicts import GOOD_DISTANCE

_COLOURS = ("#1f4e79", "#c1440e", "#3a7d44", "#8a5aa5", "#c99a1a", "#5b8a9a", "#7a4b2a", "#d46a9a")

# Of `findings.csv`, by what `plot_samples` draws of each prediction or predictor.
COLUMNS = {"lengths": "ks_{}_near", "energies": "explained_{}_end"}


def sample_styles(samples: Mapping[str, SampleKind]) -> dict[str, dict]:
    """Return how each sample is drawn: one colour a grading, dashed between walls, open for Hertz.

    Parameters
    ----------
    samples : dict of study.kinds.SampleKind
        By name.

    Returns
    -------
    dict of dict
        grading (what the names of all samples of the grading have in common), colour, line and
        filled, by name.
    """
    gradings = []
    for sample in samples.values():
        if sample.grading not in gradings:
            gradings.append(sample.grading)
    styles = {}
    for name, sample in samples.items():
        described = sample.grading
        number = gradings.index(described)
        names = [n for n, other in samples.items() if other.grading == described]
        words = zip(*(n.split("-") for n in names), strict=False)
        common = "-".join(word[0] for word in takewhile(lambda word: len(set(word)) == 1, words))
        styles[name] = {
            "grading": common or name,
            "color": _COLOURS[number % len(_COLOURS)],
            "line": "--" if sample.boundary == "walls" else "-",
            "filled": sample.law == "linear",
            "law": sample.law,
        }
    return styles


def plot_exponents(
    paths: Mapping[str, Table], styles: Mapping[str, Mapping], law: str, ax: Axes | None = None
) -> Axes:
    """Draw the exponent against the distance from jamming, of all samples of one contact law.

    Parameters
    ----------
    paths : dict of DataFrame
        `energy_split_path.csv` by sample.
    styles : dict
        From `sample_styles`.
    law : str
        linear or hertz.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    top = PAPER_EXPONENT
    for name, path in paths.items():
        style = styles[name]
        if style["law"] != law:
            continue
        # Where hardly a contact is, the interval says nothing and would hide the others.
        if len(path) > 1:
            path = path[(path["exponent_high"] - path["exponent_low"]).fillna(0.0) < 2.0]
        x = path["solid_fraction_above_jamming"]
        top = max(top, path["exponent"].max())
        # One state is a point, and its interval a bar.
        line = style["line"] if len(path) > 1 else "o"
        ax.plot(x, path["exponent"], line, color=style["color"])
        draw_band(ax, x, path, "exponent", style["color"], alpha=0.12)
    ax.axhline(PAPER_EXPONENT, color="black", ls=":", lw=1.0)
    ax.set(xlabel=r"solid fraction above jamming $\phi - \phi_J$ [-]", ylabel="exponent n [-]")
    ax.set(title=CONTACT_LAWS[law].label, ylim=(0, 1.45 * top))
    shown = {n: s for n, s in styles.items() if n in paths and s["law"] == law}
    paper = Line2D([], [], color="black", ls=":", label="the paper's n = 3")
    ax.legend(
        handles=[*legend_handles(shown, lines=True), paper],
        loc="upper center",
        ncols=3,
        handlelength=1.5,
        columnspacing=1.0,
    )
    return widen(ax)


def plot_samples(rows: Table, kind: str, ax: Axes | None = None) -> Axes:
    """Draw one number of every prediction, a row a sample.

    Parameters
    ----------
    rows : DataFrame
        `findings.csv`.
    kind : str
        lengths: distance of the predicted branch lengths near jamming; energies: deviance that
        the predictors explain at the end, on seeds left out.
    ax : Axes, optional

    Returns
    -------
    Axes
    """
    ax = axes(ax)
    column, looks = COLUMNS[kind], {"lengths": PREDICTIONS, "energies": PREDICTORS}[kind]
    places = np.arange(len(rows))
    for name, look in looks.items():
        if column.format(name) in rows:
            ax.plot(
                rows[column.format(name)],
                places,
                look.marker,
                ls="",
                color=look.color,
                label=look.label,
                ms=4,
            )
    marks = np.where(rows["verdict"] == NOT_CERTIFIED, f" ({NOT_CERTIFIED})", "")
    ax.set_yticks(places, rows["sample"] + marks)
    ax.invert_yaxis()
    ax.grid(axis="y", color="#eeeeee")
    if kind == "lengths":
        ax.axvline(GOOD_DISTANCE, color=FAINT, lw=0.8, ls="--", label=f"{GOOD_DISTANCE:g}")
        ax.set(xscale="log", xlabel="Kolmogorov-Smirnov distance near jamming [-]")
    else:
        ax.set(xlabel="deviance explained on seeds left out, at the end [-]")
    ax.legend(loc="lower center", bbox_to_anchor=(0.4, 1.0), ncols=2)
    return ax


def legend_handles(styles: Mapping[str, Mapping], lines: bool = False) -> list[Line2D]:
    """Return what a legend shows: a colour for each grading, and the boundaries where they vary.

    Parameters
    ----------
    styles : dict
        From `sample_styles`.
    lines : bool
        Whether the boundaries are to be told.

    Returns
    -------
    list of Line2D
    """
    colours = {style["grading"]: style["color"] for style in styles.values()}
    marks = [Line2D([], [], color=color, label=name) for name, color in colours.items()]
    kinds = {style["line"] for style in styles.values()}
    if lines and len(kinds) > 1:
        marks.append(Line2D([], [], color="black", ls="-", label="periodic"))
        marks.append(Line2D([], [], color="black", ls="--", label="walls"))
    return marks
