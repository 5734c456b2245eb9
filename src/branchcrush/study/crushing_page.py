"""The page of grains that break: what each figure says in a sentence, of the run's own numbers."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from jinja2 import Template

from branchcrush import __version__
from branchcrush.branches.crushing_forms import FORM_LABELS
from branchcrush.files.tables import Table
from branchcrush.statistics.intervals import interval_names


@dataclass(frozen=True)
class CrushingPage:
    """What the page shows of a sample.

    Parameters
    ----------
    name : str
    summary : mapping
        `crushing.json`.
    figures : mapping of str to path-like
        By name of the figure, in the order of the page; of those that are not known to `leads` the
        page shows the figure alone.
    means, beside : DataFrame
        `crushing_means.csv` and `crushing_beside_forms.csv`.
    grains : sequence of str
        Sentences of `crushed_grains.json`, on who breaks and how energy is split meanwhile.
    predicted : mapping
        `crushing_predicted.json`.
    view : mapping
        `crushed_view.json`.
    """

    name: str
    summary: Mapping[str, Any]
    figures: Mapping[str, Any]
    means: Table
    beside: Table
    grains: Sequence[str] = ()
    predicted: Mapping[str, Any] = field(default_factory=dict)
    view: Mapping[str, Any] = field(default_factory=dict)

    @property
    def leads(self) -> dict[str, str]:
        """One plain sentence for each figure, by its name."""
        return {
            **leads(self.summary),
            "crushed_predicted": " ".join(self.predicted.get("sentences", ())),
        }

    @property
    def forms(self) -> list[dict[str, Any]]:
        """Each form at the last state, over what was simulated there."""
        return form_rows(self.means, self.beside)

    @property
    def footing(self) -> str:
        """What every number rests on: limit, seeds, halved step."""
        s = self.summary
        seeds, halved = len(s["seeds"]), len(s["halved_seeds"])
        return (
            f"Comminution limit {1e3 * s['comminution_limit_m']:.3g} mm; "
            f"{seeds} seed{'s' if seeds > 1 else ''}, {halved or 'none'} of them also with half "
            "the strain step."
        )


def leads(summary: Mapping[str, Any]) -> dict[str, str]:
    """Return what each figure says, in a sentence of the run's own numbers.

    Parameters
    ----------
    summary : mapping
        `crushing.json`.

    Returns
    -------
    dict of str to str
        By name of the figure.
    """
    s = summary
    if not s["breakages"]:
        none = "No grain broke."
        return dict.fromkeys(
            ("crushed_line", "crushed_gradings", "crushed_lengths", "crushed_energy"), none
        ) | {"crushed_measures": none, "crushed_forms": none, "crushed_packing": none}
    b = s["size_exponent"]
    by_alpha = (
        ""
        if _missing(s["number_exponent"])
        else f", and (3 − α)/b with this run's own α = {s['number_exponent']:.2f} says "
        f"{s['slope_by_number_exponent']:.2f}"
    )
    return {
        "crushed_line": (
            "There is no compression line yet."
            if _missing(s["slope"])
            else f"Beyond yield −d ln e/d ln p is {_told(s, 'slope')}; the "
            f"strength's fall with size, b = {b:g}, says 1/(2b) = {s['slope_by_strength']:.2f}"
            f"{by_alpha}."
        ),
        "crushed_gradings": (
            f"At the end {_told(s, 'final_broken_mass_fraction', 100, '%.0f')} % of the mass is "
            f"in fragments, and {_told(s, 'final_grains', 1, '%.0f')} grains are in the cell"
            + (
                "."
                if _missing(s["number_exponent"])
                else f"; the number of those larger than d falls as a power of d, with "
                f"α = {_told(s, 'number_exponent')}; the limiting grading has "
                f"{s['ultimate_alpha']:g}."
            )
        ),
        "crushed_lengths": (
            f"At the end a branch is {_told(s, 'final_branch_over_diameter')} times as long as the "
            "mean grain diameter, where Eq. 4, any two grains alike, says 1 of every grading"
            + (
                "."
                if _missing(s["final_branch_over_diameter_by_rods"])
                else f", and rods that push say {s['final_branch_over_diameter_by_rods']:.2f}."
            )
        ),
        "crushed_energy": (
            "Of the work since the first breakage "
            f"{_told(s, 'avalanches_share', 100, '%.0f')} % is lost in avalanches, "
            f"{_told(s, 'rearrangement_share', 100, '%.0f')} % in rearrangement while straining "
            f"({_told(s, 'step_excess_share', 100, '%.0f')} % only because strain steps have a "
            "size: that part vanishes with them), "
            f"{_told(s, 'released_by_parents_share', 100, '%.0f')} % was stored in the contacts "
            f"of the grains that broke, and {_told(s, 'stored_share', 100, '%.0f')} % is stored "
            "at the end."
        ),
        "crushed_measures": (
            f"At the end Einav's B is {_told(s, 'final_einav_breakage')} on the way to the "
            f"limit, {_told(s, 'final_einav_breakage_down_to_0')} on the way to grains of no "
            f"size; the paper's C is {_told(s, 'final_crushing_by_contacts')} by the measured "
            f"contacts and {_told(s, 'final_crushing_by_random_contacts')} by Eq. 4."
        ),
        "crushed_forms": (
            "At equal solid fraction the crushed packing carries "
            f"{_told(s, 'final_stress_over_control', 100, '%.1f')} % of the stress and holds "
            f"{_told(s, 'final_energy_over_control', 100, '%.1f')} % of the energy of grains "
            "that do not break; moving the jamming point of its gradings takes "
            f"{_told(s, 'compaction_over_dissipated', 100, '%.0f')} % of what is lost."
        ),
        "crushed_packing": (
            f"The cell fills with fragments, to {_told(s, 'final_grains', 1, '%.0f')} grains; "
            f"{100 - 100 * s['final_broken_mass_fraction']:.0f} % of the mass is still in first "
            "grains."
        ),
    }


def form_rows(means: Table, beside: Table) -> list[dict[str, Any]]:
    """Return C, stress and dissipation of each form over those simulated, at the last state.

    Parameters
    ----------
    means, beside : DataFrame
        `crushing_means.csv` and `crushing_beside_forms.csv`.

    Returns
    -------
    list of dict
        Keys label, crushing, stress and dissipated; the last two are ratios. Forms that say nothing
        of that state are left out.
    """
    if not len(beside):
        return []
    last = beside["state"].max()
    here = means[(means["state"] == last) & ~means["halved_step"]].iloc[0]
    of_state = beside[beside["state"] == last].set_index("form")
    told = of_state.dropna(how="all", subset=["crushing", "stress_Pa", "dissipated_J_per_m3"])
    return [
        {
            "label": FORM_LABELS[name],
            "crushing": told.loc[name, "crushing"],
            "stress": told.loc[name, "stress_Pa"] / here["mean_stress_Pa"],
            "dissipated": told.loc[name, "dissipated_J_per_m3"] / here["dissipated_J_per_m3"],
        }
        for name in FORM_LABELS
        if name in told.index
    ]


def render_crushing(template: Template, samples: Sequence[CrushingPage]) -> str:
    """Return the page of grains that break as one HTML page with its figures inside.

    Parameters
    ----------
    template : Template
        From `study.templates.page_template`.
    samples : list of CrushingPage

    Returns
    -------
    str

    Examples
    --------
    >>> render_crushing(Template("{{ samples | length }} samples"), [])
    '0 samples'
    """
    return template.render(samples=samples, version=__version__)


def _missing(value: float | None) -> bool:
    return value is None or value != value


def _told(summary: Mapping[str, Any], name: str, scale: float = 1.0, form: str = "%.2f") -> str:
    """Format a number of the summary, with its interval unless that rounds to the number."""
    values = [summary[key] for key in interval_names(name)]
    if _missing(values[0]):
        return "an unknown part of 100" if scale == 100 else "unknown"
    estimate, *ends = (
        None if _missing(value) else _number(scale * value, form) for value in values
    )
    if None in ends or ends == [estimate, estimate]:
        return f"{estimate}"
    return f"{estimate} ({ends[0]} to {ends[1]})"


def _number(value: float, form: str) -> str:
    """Format a number; one that rounds to 0 has no sign."""
    text = form % value
    return text.removeprefix("-") if float(text) == 0.0 else text
