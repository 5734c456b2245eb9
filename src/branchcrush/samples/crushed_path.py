"""Rule crushing_results: what crushing did to one packing, a row for each state."""

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from branchcrush.branches.random_contacts import random_contact_moment
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.mixtures import from_radii
from branchcrush.packings.contact_laws import HertzContact, LinearContact
from branchcrush.samples.crushed_sizes import Crushable, grading_row
from branchcrush.samples.measured import EXPONENT

# Parts of the work, of which the shares add up to 1.
PARTS = ("stored", "released_by_parents", "avalanches", "rearrangement")
# With what is a part of the last one: it is lost because strain steps have a size.
TOLD = (*PARTS, "step_excess")
_OF_PATH = (
    "state",
    "leg",
    "solid_fraction",
    "void_ratio",
    "volume_m3",
    "mean_stress_Pa",
    "carries_load",
    "grains",
    "breakages",
    "broken_mass_fraction",
    "stopped",
)


def crushed_path(
    path: pd.DataFrame,
    grains: pd.DataFrame,
    branches: pd.DataFrame,
    control: pd.DataFrame,
    sample: Crushable,
) -> pd.DataFrame:
    r"""Return what crushing did to a packing: grading, energies, elastic strain, in every state.

    .. math:: \epsilon_e = \frac{a E}{p V}, \qquad
        W - W_1 = (E - E_1) + D_{\mathrm{parents}} + D_{\mathrm{avalanches}}
        + (D_{\mathrm{rearr}} - D_{\mathrm{rearr},1})

    State 1 is the last one before the first breakage. a is the exponent of the energy in the
    overlap, 2 with linear and 5/2 with Hertz's contacts: no jamming point is needed.

    Parameters
    ----------
    path : DataFrame
        `path.csv` of the crushing.
    grains : DataFrame
        Columns state and radius_m of `grains.parquet`.
    branches : DataFrame
        Columns state and branch_length_m of `contacts.parquet`.
    control : DataFrame
        `path.csv` of the same packing whose grains do not break.
    sample : Crushable

    Returns
    -------
    DataFrame
        Columns of `crushing_states.csv` but seed and halved_step; without the loose packing.
    """
    path = path[path["state"] > 0].reset_index(drop=True)
    radii = dict(tuple(grains.groupby("state")["radius_m"]))
    rows = path[list(_OF_PATH)].copy()
    rows["elastic_strain"] = _elastic_strain(path, sample.law)
    rows = pd.concat([rows, energies(path), _beside_control(path, control)], axis=1)
    first = radii[path["state"].iloc[0]].to_numpy()
    of_gradings = [grading_row(first, radii[state].to_numpy(), sample) for state in path["state"]]
    rows = pd.concat([rows, pd.DataFrame(of_gradings)], axis=1)
    rows["jamming_by_elastic_strain"] = rows["solid_fraction"] * (1.0 - rows["elastic_strain"])
    rows["crushing_by_contacts"] = _by_contacts(path, branches, from_radii(first), sample)
    rows["compaction_work_J"] = _compaction(path, rows["jamming_by_rods"])
    return rows


def energies(path: pd.DataFrame) -> pd.DataFrame:
    """Return where the work since the first breakage went, in joules and as shares of it.

    Parameters
    ----------
    path : DataFrame
        `path.csv` of the crushing.

    Returns
    -------
    DataFrame
        Work and its parts [J], cumulative, and their shares, `TOLD` [-]; nan before the first
        breakage.

    Examples
    --------
    >>> path = pd.DataFrame({
    ...     "breakages": [0, 1], "work_J": [1.0, 5.0], "elastic_energy_J": [0.5, 1.5],
    ...     "released_by_parents_J": [0.0, 1.0], "dissipated_avalanches_J": [0.0, 1.5],
    ...     "dissipated_rearrangement_J": [0.5, 1.0], "step_excess_J": [0.1, 0.5]})
    >>> energies(path)[["stored_share", "avalanches_share"]].iloc[1].tolist()
    [0.25, 0.375]
    """
    before = int((path["breakages"] == 0).sum()) - 1
    start = path.iloc[max(before, 0)]
    broke = (path["breakages"] > 0) & (path.index > before)
    columns = {
        "stored": "elastic_energy_J",
        "released_by_parents": "released_by_parents_J",
        "avalanches": "dissipated_avalanches_J",
        "rearrangement": "dissipated_rearrangement_J",
        "step_excess": "step_excess_J",
    }
    work = (path["work_J"] - start["work_J"]).where(broke)
    parts = {name: (path[key] - start[key]).where(broke) for name, key in columns.items()}
    return pd.DataFrame(
        {"work_since_breakage_J": work}
        | {f"{name}_since_breakage_J": parts[name] for name in TOLD}
        | {f"{name}_share": parts[name] / work for name in TOLD}
    )


def _elastic_strain(path: pd.DataFrame, law: LinearContact | HertzContact) -> pd.Series:
    """Return the strain that the elastic energy and the stress tell of, where there is load."""
    loaded = path["carries_load"].astype(bool)
    power = law.exponent + 1.0
    strain = power * path["elastic_energy_J"] / (path["mean_stress_Pa"] * path["volume_m3"])
    return strain.where(loaded)


def control_law(
    control: pd.DataFrame, law: LinearContact | HertzContact
) -> tuple[NDArray, NDArray]:
    """Return elastic strain and stress of the packing whose grains do not break, rising.

    Parameters
    ----------
    control : DataFrame
        `path.csv`.
    law : LinearContact or HertzContact

    Returns
    -------
    strain, stress : ndarray
        eps_e [-] and p_0 [Pa] of the loaded states of its way in.
    """
    way_in = control[control["leg"] == "loading"]
    strain = _elastic_strain(way_in, law)
    known = pd.DataFrame({"strain": strain, "stress": way_in["mean_stress_Pa"]}).dropna()
    known = known.sort_values("strain")
    return known["strain"].to_numpy(), known["stress"].to_numpy()


def _beside_control(path: pd.DataFrame, control: pd.DataFrame) -> pd.DataFrame:
    """Return energy and stress over those of grains that do not break, at equal solid fraction."""
    way_in = control[(control["leg"] == "loading") & control["carries_load"].astype(bool)]
    way_in = way_in.sort_values("solid_fraction")
    ratios = {}
    for name, key in (("energy", "elastic_energy_J"), ("stress", "mean_stress_Pa")):
        beside = (
            np.interp(path["solid_fraction"], way_in["solid_fraction"], way_in[key], np.nan, np.nan)
            if len(way_in)
            else np.full(len(path), np.nan)
        )
        ratios[f"{name}_over_control"] = path[key] / beside
    return pd.DataFrame(ratios)


def _by_contacts(
    path: pd.DataFrame, branches: pd.DataFrame, first: Grading, sample: Crushable
) -> NDArray:
    """Return C by the measured branch lengths, from the last state before any grain broke."""
    ultimate = sample.ultimate(first)
    cubes = (branches["branch_length_m"] ** EXPONENT).groupby(branches["state"]).mean()
    moment = cubes.reindex(path["state"]).to_numpy()
    known = np.flatnonzero(np.isfinite(moment))
    if ultimate is None or not known.size:
        return np.full(len(path), np.nan)
    whole = known[path["breakages"].to_numpy()[known] == 0]
    initial = moment[whole[-1] if whole.size else known[0]]
    # Before it there are few contacts, which tell nothing of crushing.
    start = whole[-1] if whole.size else known[0]
    last = random_contact_moment(ultimate, EXPONENT)
    crushing = (initial - moment) / (initial - last)
    return np.where(np.arange(len(path)) < start, np.nan, crushing)


def _compaction(path: pd.DataFrame, jamming: pd.Series) -> NDArray:
    r"""Return the work that the moving jamming point takes, of states since the first breakage.

    .. math:: \int p\, V_s\, \frac{d \ln \phi_J}{\phi_J} = -\int p\, dV_J, \qquad
        V_J = V_s/\phi_J
    """
    before = max(int((path["breakages"] == 0).sum()) - 1, 0)
    volume = (path["solid_fraction"] * path["volume_m3"] / jamming).to_numpy()
    stress = path["mean_stress_Pa"].to_numpy()
    steps = -np.diff(volume) * (stress[1:] + stress[:-1]) / 2.0
    steps[:before] = 0.0
    work = np.append(0.0, np.cumsum(steps))
    work[: before + 1] = np.nan
    return work
