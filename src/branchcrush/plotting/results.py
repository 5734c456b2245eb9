"""How each result of `results` is drawn: the one panel of the report's figures that shows it."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

import matplotlib
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from branchcrush.errors import ResultsError
from branchcrush.packings.contact_laws import CONTACT_LAWS
from branchcrush.plotting import (
    branches,
    certificate,
    crushed,
    crushing,
    crushing_paths,
    energy,
    forces,
    gradings,
    loading,
    predictors,
    shielding,
    study,
    study_networks,
)
from branchcrush.plotting.packings import plot_packing
from branchcrush.plotting.style import STYLE, axes, drawn
from branchcrush.results.packing import State
from branchcrush.results.result import Result
from branchcrush.results.sample import Sample
from branchcrush.results.study import Study
from branchcrush.study.kinds import SampleKind

Panel = Callable[[Result, Axes], Axes]


def plot(what: Result | State, ax: Axes | None = None) -> Axes:
    """Draw a result, or the grains of a state, and return the Axes.

    Parameters
    ----------
    what : Result or State
        Of `branchcrush.open_study`.
    ax : Axes, optional

    Returns
    -------
    Axes
        With the reason written on it where the result holds no data.

    Raises
    ------
    ResultsError
        When no single panel shows the result.
    """
    if isinstance(what, State):
        grains = what.grains
        centres = grains[["x_m", "y_m", "z_m"]].to_numpy()
        ax = plot_packing(centres, grains["radius_m"].to_numpy(), what.cell, ax=axes(ax))
        ax.set_title(what.title, fontsize=7)
        return ax
    panel = PANELS.get(what.name)
    if panel is None:
        shown = f"figures that show it: {', '.join(what.figures)}" if what.figures else "none does"
        raise ResultsError(f"no single panel shows {what.title}; {shown}. Draw its .data yourself")
    if what.missing:
        raise ResultsError(what.missing)
    try:
        with plt.rc_context(STYLE):
            ax = drawn(panel, what.reason, what, ax=axes(ax))
            shown = plt.isinteractive()
    except KeyError as error:
        raise ResultsError(
            f"{what.title} cannot be drawn: it lacks {error}, as results of another version may"
        ) from error
    # A notebook becomes interactive with its first figure, which the end of the style would undo.
    matplotlib.interactive(shown)
    return ax


def _table(plot: Callable[..., Axes]) -> Panel:
    """Draw the table alone."""
    return lambda result, ax: plot(result.data, ax=ax)


def _both(plot: Callable[..., Axes], summary: str | None = None) -> Panel:
    """Draw the table with the numbers of the sample that belong to it."""

    def panel(result: Result, ax: Axes) -> Axes:
        numbers = result if summary is None else result.place.results[summary]
        return plot(result.data, numbers.summary, ax=ax)

    return panel


def _with_radius(plot: Callable[..., Axes], summary: str | None = None) -> Panel:
    """Draw the table, with the numbers that belong to it, over the largest radius."""

    def panel(result: Result, ax: Axes) -> Axes:
        of_sample = result.place.results
        numbers = () if summary is None else (of_sample[summary].summary,)
        largest = of_sample["grading"].summary["target"]["D_max_m"] / 2.0
        return plot(result.data, *numbers, largest, ax=ax)

    return panel


def _with_fit(plot: Callable[..., Axes]) -> Panel:
    """Draw the table with the energy split of the sample."""
    return lambda result, ax: plot(result.data, _sample(result).fit, ax=ax)


def _sample(result: Result) -> Sample:
    assert isinstance(result.place, Sample)  # by the names in PANELS
    return result.place


def _styles(result: Result) -> dict[str, dict]:
    assert isinstance(result.place, Study)
    settings = {sample.name: sample.settings for sample in result.place}
    return study.sample_styles({name: SampleKind.of(of) for name, of in settings.items()})


def _coordination(result: Result, ax: Axes) -> Axes:
    """Draw the coordination numbers of a sample, or of all samples of a study."""
    if isinstance(result.place, Study):
        known = result.data[result.data["state"].notna()]
        return study_networks.plot_coordination(known, _styles(result), ax=ax)
    name = _sample(result).name
    styles = study.sample_styles({name: SampleKind.of(_sample(result).settings)})
    return study_networks.plot_coordination(result.data.assign(sample=name), styles, ax=ax)


def _exponents(result: Result, ax: Axes) -> Axes:
    """Draw n of all samples of the contact law that most have."""
    styles = _styles(result)
    laws = [style["law"] for style in styles.values()]
    law = max(CONTACT_LAWS, key=laws.count)
    known = result.data[result.data["solid_fraction_above_jamming"].notna()]
    return study.plot_exponents(dict(list(known.groupby("sample"))), styles, law, ax=ax)


def _crushing_line(result: Result, ax: Axes) -> Axes:
    sample = _sample(result)
    paths = [packing.path.data for packing in sample.seeds.values()]
    states, summary = sample.crushing_states.data, sample.crushing.summary
    return crushed.plot_line(states, result.data, paths, summary, ax=ax)


# By the name of the result. What is not here is numbers alone, or told by more than one panel.
PANELS: Mapping[str, Panel] = MappingProxyType(
    {
        "branch_lengths": _with_radius(branches.plot_branch_lengths, "branch_lengths"),
        "certificate": lambda result, ax: certificate.plot_rest(
            result.data, result.summary["limits"], ax=ax
        ),
        "contact_numbers": _with_radius(branches.plot_contact_numbers, "contact_numbers"),
        "contact_pairs": _with_radius(branches.plot_pairs, "contact_numbers"),
        "convergence": lambda result, ax: certificate.plot_convergence(
            _sample(result).certificate.summary["convergence"], ax=ax
        ),
        "coordination": _coordination,
        "crushing_forms": _both(crushing.plot_yield_stress, "thermodynamics"),
        "crushing_gradings": _both(crushed.plot_gradings, "crushing"),
        "crushing_line": _crushing_line,
        "crushing_means": _table(crushed.plot_energy),
        "energy_split": _with_fit(energy.plot_energy_split),
        "energy_split_path": _with_fit(energy.plot_exponent_path),
        "energy_split_ratio": _with_fit(predictors.plot_radius_ratio),
        "exponents": _exponents,
        "fabric": _both(forces.plot_fabric, "sharing"),
        "findings": lambda result, ax: study.plot_samples(result.data, "energies", ax=ax),
        "force_by_length": _with_radius(forces.plot_force_by_length, "sharing"),
        "force_distribution": _both(forces.plot_force_distribution, "sharing"),
        "grading": _table(gradings.plot_grading),
        "jamming": _table(certificate.plot_jamming),
        "length_predictions": _with_radius(branches.plot_mean_lengths),
        "path": lambda result, ax: loading.plot_mean_stress(
            result.data.assign(seed_number=0), ax=ax
        ),
        "shielding_branches": _both(shielding.plot_branch_shielding, "sharing"),
        "shielding_grains": _table(shielding.plot_grain_shielding),
        "stress_by_radius": _with_radius(forces.plot_stress_by_radius),
        "stress_sharing": _both(forces.plot_stress_sharing, "sharing"),
        "thermodynamics": _both(crushing_paths.plot_stress),
    }
)
