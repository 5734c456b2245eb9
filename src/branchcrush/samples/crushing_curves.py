"""The tables of the crushing model: curves of a form along its paths, and over C."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from branchcrush.crushing.admissibility import force_over_stress, yielding_strain
from branchcrush.crushing.elasticity import Elasticity
from branchcrush.crushing.energy_ratios import (
    ratio_at_equal_strain,
    ratio_at_equal_stress,
    ratio_at_equal_total_strain,
)
from branchcrush.crushing.evolution import Evolution, evolve
from branchcrush.crushing.forms import ModelForm
from branchcrush.crushing.resistance import Resistance
from branchcrush.crushing.yield_line import (
    CompressionLine,
    Control,
    YieldLine,
    compression_line,
)

FIXED_CRUSHING = (0.0, 0.25, 0.5, 0.75, 1.0)
# States on the way in and back, at each fixed C, and places of C.
_IN, _BACK, _FIXED, _PLACES = 60, 10, 40, 51
# The unloading leg ends here, as a share of the largest elastic strain.
_UNLOADED_TO = 0.6
# So near to C = 1 crushing is complete; at it a limiting density may be reached with a jerk.
_COMPLETE = 1.0 - 1e-9
# Driving force over pressure that rounding leaves where nothing changes.
_NOTHING = 1e-9
# Beyond the last load that crushing goes on at, so that it does.
_BEYOND = 1.0 + 1e-9


def form_curves(
    form: ModelForm,
    elasticity: Elasticity,
    resistance: Resistance,
    largest: float,
    fixed: Sequence[float],
) -> tuple[pd.DataFrame, Evolution]:
    """Return the curves of a form, as far as it is admissible and its elastic law is known.

    Parameters
    ----------
    form : ModelForm
    elasticity : Elasticity
    resistance : Resistance
    largest : float
        The largest elastic strain that the law was measured to [-].
    fixed : sequence of float
        C that curves are held at [-].

    Returns
    -------
    curves : DataFrame
        Columns of `thermodynamics.csv` but form and reference energy. Column `path`: "crushing"
        is a loading and unloading with C evolving, "fixed" holds C.
    evolution : Evolution
        Of the first.
    """
    line = YieldLine(form, elasticity, resistance)
    end, crushing = _end(line, largest)
    loading = np.union1d(np.linspace(0.0, end, _IN + 1), np.minimum(line.loads[:1], end))
    elastic = form.elastic_strain(end, crushing) * np.linspace(1.0, _UNLOADED_TO, _BACK + 1)[1:]
    back = form.total_strain(elastic, crushing)
    evolution = evolve(np.append(loading, back), form, elasticity, resistance)
    curves = _evolved(form, elasticity, resistance, "crushing", evolution)
    parts = [curves]
    for crushing in fixed:
        strain = form.total_strain(np.linspace(0.0, largest, _FIXED + 1), crushing)
        parts.append(_states(form, elasticity, resistance, "fixed", strain, crushing))
    return pd.concat(parts, ignore_index=True), evolution


def history_curves(
    form: ModelForm,
    elasticity: Elasticity,
    resistance: Resistance,
    quantity: Control,
    loads: NDArray,
) -> tuple[pd.DataFrame, Evolution]:
    """Return what a form says along a history of the user's own, a row for each load.

    Parameters
    ----------
    form : ModelForm
    elasticity : Elasticity
    resistance : Resistance
    quantity : {"strain", "stress"}
    loads : ndarray, shape (loads,)
        Total strains [-] or mean stresses [Pa], in turn.

    Returns
    -------
    curves : DataFrame
        As `form_curves` has them, `path` "history".
    evolution : Evolution

    Raises
    ------
    ValueError
        For loads that the elastic law is not meant for, as `evolve`.
    """
    evolution = evolve(loads, form, elasticity, resistance, quantity)
    rows = _evolved(form, elasticity, resistance, "history", evolution)
    return rows, evolution


def events_table(form: ModelForm, elasticity: Elasticity, evolution: Evolution) -> pd.DataFrame:
    """Return the events of a history, with what each dissipates at once.

    Parameters
    ----------
    form : ModelForm
    elasticity : Elasticity
    evolution : Evolution

    Returns
    -------
    DataFrame
        Columns of `crushing_events.csv` but form and path.
    """
    events = evolution.events
    strain = np.array([event.strain for event in events])
    before = np.array([event.crushing for event in events])
    after = np.array([event.crushing_after for event in events])
    return pd.DataFrame(
        {
            "event": [event.kind for event in events],
            "load": np.array([event.load for event in events], int),
            "volumetric_strain": strain,
            "elastic_strain": form.elastic_strain(strain, before),
            "stress_Pa": form.stress(strain, before, elasticity),
            "crushing": complete_or(before),
            "crushing_after": complete_or(after),
            "dissipated_J_per_m3": np.array([event.dissipated for event in events]),
        }
    )


def complete_or(crushing: ArrayLike) -> NDArray:
    """Return C as it is, and 1 where it is complete but for the rounding of the yield line.

    Parameters
    ----------
    crushing : array_like
        C, any shape [-].

    Returns
    -------
    ndarray
        [-]

    Examples
    --------
    >>> complete_or([0.5, 1.0 - 2.0**-40]).tolist()
    [0.5, 1.0]
    """
    return np.where(np.asarray(crushing) > _COMPLETE, 1.0, crushing)


def _end(line: YieldLine, largest: float) -> tuple[float, float]:
    """Return the total strain at which C ends or the elastic strain is the largest, and about C."""
    elastic = line.resistance.yield_strain(line.looks, line.form, line.elasticity)
    beyond = np.flatnonzero(~(elastic <= largest))
    last = float(line.looks[max(beyond[0] - 1, 0)] if beyond.size else line.looks[-1])
    if beyond.size or last > _COMPLETE:
        return float(line.form.total_strain(largest, last)), last
    return float(line.loads.max()) * _BEYOND, last


def _evolved(
    form: ModelForm,
    elasticity: Elasticity,
    resistance: Resistance,
    path: str,
    evolution: Evolution,
) -> pd.DataFrame:
    """Return what a form says of the states of a history, and where the work went."""
    return _states(form, elasticity, resistance, path, evolution.strain, evolution.crushing).assign(
        dissipated_J_per_m3=evolution.dissipated,
        plastic_work_J_per_m3=evolution.compaction,
        work_J_per_m3=evolution.work,
    )


def _states(
    form: ModelForm,
    elasticity: Elasticity,
    resistance: Resistance,
    path: str,
    strain: NDArray,
    crushing: NDArray | float,
) -> pd.DataFrame:
    """Return what a form says of some states."""
    crushing = np.broadcast_to(crushing, strain.shape)
    elastic = form.elastic_strain(strain, crushing)
    critical = resistance.critical_force(crushing, form, elasticity)
    force = form.driving_force(strain, np.minimum(crushing, _COMPLETE), elasticity)
    return pd.DataFrame(
        {
            "path": path,
            "volumetric_strain": strain,
            "elastic_strain": elastic,
            "crushing": complete_or(crushing),
            "elastic_energy_J_per_m3": elasticity.energy(elastic),
            "free_energy_J_per_m3": form.free_energy(strain, crushing, elasticity),
            "stress_Pa": form.stress(strain, crushing, elasticity),
            "driving_force_J_per_m3": force,
            "resistance_J_per_m3": np.where(np.isfinite(critical), critical, np.nan),
            "tangent_stiffness_Pa": form.tangent_stiffness(strain, crushing, elasticity),
        }
    )


def form_table(
    form: ModelForm,
    elasticity: Elasticity,
    resistance: Resistance,
    jamming: float,
    largest: float,
) -> pd.DataFrame:
    """Return what a form says of energy, jamming point and yield at C from 0 to its last one.

    Parameters
    ----------
    form : ModelForm
    elasticity : Elasticity
    resistance : Resistance
    jamming : float
        phi_J before crushing [-].
    largest : float
        The largest elastic strain that the law was measured to [-]; energies are compared there.

    Returns
    -------
    DataFrame
        Columns of `crushing_forms.csv` but form.
    """
    crushing = np.linspace(0.0, form.knots[-1], _PLACES)
    below = np.minimum(crushing, _COMPLETE)
    line = compression_line(form, below, elasticity, resistance, jamming)
    strain = yielding_strain(form, elasticity, resistance, largest, below)
    ratio = ratio_at_equal_strain(form, crushing)
    stress = float(elasticity.pressure(largest))
    force = force_over_stress(form, elasticity, strain, below)
    # Where crushing would cost energy C does not grow, whatever resists.
    line = CompressionLine(*(np.where(force < -_NOTHING, np.nan, values) for values in line))
    return pd.DataFrame(
        {
            "crushing": crushing,
            "jamming_solid_fraction": jamming * form.jamming.value(crushing),
            "stiffness_ratio": form.factor.value(crushing),
            "energy_at_equal_strain": ratio,
            "energy_at_equal_energy_over_pressure": ratio,
            "energy_at_equal_stress": ratio_at_equal_stress(form, crushing, elasticity, stress),
            "energy_at_equal_solid_fraction": ratio_at_equal_total_strain(
                form, crushing, elasticity, largest
            ),
            "driving_force_over_pressure": force,
            "yield_elastic_strain": line.elastic_strain,
            "yield_stress_Pa": line.stress,
            "void_ratio": line.void_ratio,
        }
    )
