"""What rearrangement takes: the stress of the packings beside the slope of what they store."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from branchcrush.samples.elastic_law import MeasuredElasticity
from branchcrush.samples.ensemble import stacked

# So many states with a loaded neighbour on either side, for the slope of their energies to be told.
_FEWEST_SLOPES = 3
# States up to this strain are told apart from the others: next to jamming more is dissipated.
_NEAR = 0.08


def elastic_law_table(paths: Sequence[pd.DataFrame], measured: MeasuredElasticity) -> pd.DataFrame:
    r"""Return the stress of the packings and what of it the elastic law gives back, state by state.

    .. math:: \sigma = -\frac{dE}{dV} + \sigma_r
        = \frac{d\Psi_0}{d\epsilon} + \sigma_m + \sigma_r, \qquad W = \frac{E}{V_J} + D

    sigma_r is what rearrangement takes, sigma_m by how much the law misses the states' own slope.
    Volumes at jamming are V_J = V phi/phi_J.

    Parameters
    ----------
    paths : list of DataFrame
        A `path.csv` for each seed, its states on the way in.
    measured : MeasuredElasticity

    Returns
    -------
    DataFrame
        Means over the packings, a row for each state above phi_J.
    """
    columns = ["solid_fraction", "volume_m3", "mean_stress_Pa", "elastic_energy_J", "work_J"]
    means = stacked(paths).groupby("state")[columns].mean().reset_index()
    phi, volume = means["solid_fraction"], means["volume_m3"]
    # Central differences; the first states carry nothing, which is what they begin from.
    slope = -np.gradient(means["elastic_energy_J"], volume, edge_order=min(2, len(means) - 1))
    strain = 1.0 - measured.jamming / phi
    at_jamming = volume * phi / measured.jamming
    stored, work = means["elastic_energy_J"] / at_jamming, means["work_J"] / at_jamming
    pressure = measured.law.pressure(strain)
    table = pd.DataFrame(
        {
            "state": means["state"],
            "solid_fraction": phi,
            "volumetric_strain": strain,
            "mean_stress_Pa": means["mean_stress_Pa"],
            "law_stress_Pa": pressure,
            "energy_slope_Pa": slope,
            "misfit_stress_Pa": slope - pressure,
            "rearrangement_stress_Pa": means["mean_stress_Pa"] - slope,
            "law_energy_J_per_m3": measured.law.energy(strain),
            "elastic_energy_J_per_m3": stored,
            "work_J_per_m3": work,
            "dissipated_J_per_m3": work - stored,
        }
    )
    return table[strain > 0].reset_index(drop=True)


def rearrangement_sentence(table: pd.DataFrame) -> str:
    """Return in words what rearrangement takes.

    Parameters
    ----------
    table : DataFrame
        From `elastic_law_table`.

    Returns
    -------
    str
    """
    table = table[table["mean_stress_Pa"] > 0.0]
    law = 100.0 * table["law_stress_Pa"] / table["mean_stress_Pa"]
    near = table["volumetric_strain"] <= _NEAR
    part = f"{_range(law)} %"
    if near.any() and not near.all():
        part = f"{_range(law[~near])} % beyond a strain of {_NEAR:g} and "
        part += f"{_range(law[near])} % nearer to jamming"
    if _too_much(law):
        part += ", above 100 % where it misses the states"
    # A slope beside a state without load, or at the last state, would rest on one side alone.
    slope = (100.0 * table["energy_slope_Pa"] / table["mean_stress_Pa"])[1:-1]
    own = f"the energies of the states themselves give back −dE/dV, {_range(slope)} %"
    if slope.size < _FEWEST_SLOPES:
        own = f"for the slope −dE/dV of the states' own energies {len(table)} loaded "
        own += "state is too few" if len(table) == 1 else "states are too few"
    elif _too_much(slope):
        own += ", above 100 % where states are too far apart for a slope"
    told = f"Of the packings' mean stress the elastic law gives back dΨ₀/dε, {part}; {own}"
    last = table.iloc[-1]
    share = 100.0 * last["dissipated_J_per_m3"] / last["work_J_per_m3"]
    return (
        f"{told}. The rest rearranges grains and is lost: {share:.1f} % of the work, "
        f"{last['dissipated_J_per_m3']:.3g} of {last['work_J_per_m3']:.3g} J/m³ at the end, what "
        "was lost before jamming included."
    )


def _too_much(percent: pd.Series) -> bool:
    """Return whether more is said to come back than there is, beyond rounding."""
    return bool(percent.max() >= 100.5)


def _range(values: pd.Series) -> str:
    low, high = f"{values.min():.0f}", f"{values.max():.0f}"
    return low if low == high else f"{low} to {high}"
