"""Quantities of one packing along its path, and what they are at a level that is not a state.

A level is an elastic strain a Psi/p, a strain from the packing's own jamming point, or a stress.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pairs import Pair, Sample

from branchcrush.errors import FitError
from branchcrush.files.tables import Table, read_packing, read_table
from branchcrush.packings.grains import grain_stress_volume
from branchcrush.packings.network import Network, state_networks
from branchcrush.statistics.power_law import power_law_fit

# What is interpolated in its logarithm; all else as it is.
IN_LOGARITHMS = ("energy_J_per_m3", "stress_Pa")
# Elastic strain below which a state hardly carries load, and tells no jamming point [-].
HARDLY_LOADED = 0.005
_STATES_TO_JAMMING = 5
# What a level can be of, and where it is taken.
LEVELS = {
    "elastic_strain": (0.02, 0.04, 0.07),
    "strain": (0.04, 0.07, 0.10),
    # Elastic strains at which the packings of C = 0 have the stress.
    "stress": (0.05, 0.07, 0.09),
}


@dataclass(frozen=True)
class SeedPath:
    """States of one packing that are at rest and carry load, from the loosest on."""

    seed: int
    values: dict[str, NDArray]  # by quantity, each of shape (states,)
    networks: list[Network]
    jamming: float  # phi_J measured; nan where the path does not tell [-]

    def at(self, abscissa: str, level: float) -> dict[str, float]:
        """Return every quantity at a level, nan beyond the states.

        Parameters
        ----------
        abscissa : str
            elastic_strain, strain or stress.
        level : float
            [-] or [Pa].

        Returns
        -------
        dict of float
        """
        known = self.values["stress_Pa" if abscissa == "stress" else abscissa]
        return {
            name: at_level(known, values, level, logarithmic=name in IN_LOGARITHMS)
            for name, values in self.values.items()
        } | {"jamming_solid_fraction": self.jamming}

    def nearest(self, elastic_strain: float) -> Network:
        """Return the network of the state nearest to an elastic strain, by ratio."""
        return self.networks[self._nearest(elastic_strain)]

    def strain_near(self, elastic_strain: float) -> float:
        """Return the strain from jamming of that state [-]."""
        return float(self.values["strain"][self._nearest(elastic_strain)])

    def _nearest(self, elastic_strain):
        return int(np.abs(np.log(self.values["elastic_strain"] / elastic_strain)).argmin())


def at_level(
    abscissa: ArrayLike, values: ArrayLike, level: float, *, logarithmic: bool = True
) -> float:
    r"""Return a quantity at a level of an abscissa, between the two states beside it.

    .. math:: \ln y = \ln y_1 + \frac{\ln x - \ln x_1}{\ln x_2 - \ln x_1} (\ln y_2 - \ln y_1)

    exact for a power law; or the same with y itself. A state after which the abscissa falls again,
    as where a packing rearranges near jamming, is left out.

    Parameters
    ----------
    abscissa, values : array_like, shape (n,)
        Along the path; where the abscissa is not above 0, or not known, they are left out.
    level : float
    logarithmic : bool
        Whether the quantity is taken in its logarithm.

    Returns
    -------
    float
        nan outside of the states: nothing is extrapolated.

    Examples
    --------
    >>> x = [0.01, 0.04, 0.09]
    >>> round(at_level(x, [1e-4, 16e-4, 81e-4], 0.02), 12)
    0.0004
    """
    x, y = np.asarray(abscissa, dtype=float), np.asarray(values, dtype=float)
    known = (x > 0.0) & np.isfinite(x) & np.isfinite(y)
    x, y = x[known], y[known]
    # From the last state backwards, those below all that follow.
    following = np.minimum.accumulate(np.append(x[1:], np.inf)[::-1])[::-1]
    rising = x < following
    x, y = x[rising], y[rising]
    if not x.size or not x[0] <= level <= x[-1]:
        return float("nan")
    found = np.interp(np.log(level), np.log(x), np.log(y) if logarithmic else y)
    return float(np.exp(found) if logarithmic else found)


def jamming_fraction(
    solid_fraction: ArrayLike, stress: ArrayLike, contact_exponent: float
) -> float:
    r"""Return the solid fraction at which the stress of a packing vanishes.

    .. math:: \phi = \phi_J + a\, p^{1/m} + b\, p^{2/m}

    by least squares through the first five states. States of this study are 0.015 in solid
    fraction apart: `loading.jamming.jamming_point`, made for more, would take four and lets one
    that hardly carries load decide.

    Parameters
    ----------
    solid_fraction, stress : array_like, shape (n,)
        Of the states that carry load, in their order [-], [Pa].
    contact_exponent : float
        m, 1 for linear contacts and 3/2 for Hertz's.

    Returns
    -------
    float
        phi_J [-]; nan with fewer than five states.

    Examples
    --------
    >>> stress = np.array([1.0, 2.0, 3.0, 4.0, 5.0])
    >>> round(jamming_fraction(0.64 + 0.01 * stress + 0.001 * stress**2, stress, 1.0), 9)
    0.64
    """
    phi = np.asarray(solid_fraction, dtype=float)[:_STATES_TO_JAMMING]
    root = np.asarray(stress, dtype=float)[: phi.size] ** (1.0 / contact_exponent)
    if phi.size < _STATES_TO_JAMMING:
        return float("nan")
    return float(np.polyfit(root / root[-1], phi, 2)[-1])


def sample_paths(
    results: Path, pair: Pair, sample: Sample
) -> tuple[list[SeedPath], list[str], list[str]]:
    """Return the packings of a sample that are there, and what is missing or of no use.

    Parameters
    ----------
    results : Path
        Of the study.
    pair : Pair
    sample : Sample

    Returns
    -------
    paths : list of SeedPath
    missing : list of str
        What is said of packings that are not there.
    untold : list of str
        A line each for packings that are, without a jamming point.
    """
    paths, missing, untold = [], [], []
    absent = []
    for seed in sample.settings["seeds"]:
        folder = results / sample.name / f"seed_{seed}"
        if not (folder / "made.json").exists():  # the last that a packing writes
            absent.append(str(seed))
            continue
        path = _seed_path(folder, pair, sample, seed)
        if path is None:
            missing.append(f"{sample.name}, seed {seed}: fewer than two states at rest carry load")
            continue
        paths.append(path)
        if np.isnan(path.jamming):
            untold.append(f"{sample.name}, seed {seed}: its path does not tell a jamming point")
    if absent:
        missing.append(f"{sample.name}: seeds {', '.join(absent)} not packed yet")
    return paths, missing, untold


def _seed_path(folder: Path, pair: Pair, sample: Sample, seed: int) -> SeedPath | None:
    """Return the path of one packing, None with fewer than two states at rest under load."""
    table = read_table(folder / "path.csv")
    at_rest = table["unbalanced_force_ratio"] <= sample.settings["state_tolerance"]
    used = table[table["carries_load"] & at_rest & (table["leg"] == "loading")]
    if len(used) < 2:
        return None
    _, radii, _ = read_packing(folder / "packing.npz")
    tables = (read_table(folder / f"{name}.parquet") for name in ("contacts", "wall_contacts"))
    networks = list(state_networks(radii, *tables, used["state"].tolist()))
    energy = used["elastic_energy_J"] / used["volume_m3"]
    loaded = used[pair.energy_exponent * energy / used["mean_stress_Pa"] >= HARDLY_LOADED]
    jamming = jamming_fraction(
        loaded["solid_fraction"], loaded["mean_stress_Pa"], pair.contact.exponent
    )
    # Below it, load was there before the first strain step, and the path does not tell.
    if jamming < sample.settings["loading"]["approach_solid_fraction"]:
        jamming = float("nan")
    return SeedPath(seed, _values(used, networks, pair, jamming), networks, jamming)


def _values(
    used: Table, networks: Sequence[Network], pair: Pair, jamming: float
) -> dict[str, NDArray]:
    volume = used["volume_m3"].to_numpy()
    fraction = used["solid_fraction"].to_numpy()
    energy = used["elastic_energy_J"].to_numpy() / volume
    stress = used["mean_stress_Pa"].to_numpy()
    contacts = np.array([network.i.size for network in networks])
    return {
        "elastic_strain": pair.energy_exponent * energy / stress,
        "strain": 1.0 - jamming / fraction,
        "solid_fraction": fraction,
        "energy_J_per_m3": energy,
        "stress_Pa": stress,
        "branch_density_per_m3": contacts / volume,
        "coordination_number": used["coordination_number"].to_numpy(),
        "mechanical_coordination_number": used["mechanical_coordination_number"].to_numpy(),
        "rattler_fraction": used["rattler_fraction"].to_numpy(),
        "bearing_mass": np.array([_bearing_mass(network) for network in networks]),
        "mean_cube_length_m3": np.array([np.mean(network.length**3) for network in networks]),
        "exponent": np.array([_exponent(network) for network in networks]),
        **_of_fines(networks, pair),
    }


def _bearing_mass(network: Network) -> float:
    mass = network.radius**3
    return float(mass[network.bearing].sum() / mass.sum())


def _exponent(network: Network) -> float:
    """Return n of E ~ l^n, by gamma regression of all branches."""
    try:
        return float(power_law_fit(network.length, network.energy).exponent)
    except FitError:
        return float("nan")


def _of_fines(networks: Sequence[Network], pair: Pair) -> dict[str, NDArray]:
    """Return what soil mechanics asks of fines; nothing where the gradings overlap."""
    coarsest_fine, finest_coarse = pair.ultimate.support()[1], pair.initial.support()[0]
    if coarsest_fine >= finest_coarse:
        return {}
    rows = []
    for network in networks:
        fine = network.radius < np.sqrt(coarsest_fine * finest_coarse)
        stress, volume = grain_stress_volume(network), network.radius**3
        both_coarse = ~fine[network.i] & ~fine[network.j]
        with np.errstate(invalid="ignore", divide="ignore"):
            of_fines = (stress[fine].sum() / volume[fine].sum()) / (stress.sum() / volume.sum())
            bearing = network.bearing[fine].sum() / fine.sum()
        rows.append((of_fines, bearing, 2.0 * both_coarse.sum() / (~fine).sum()))
    names = ("stress_reduction_factor", "bearing_fines", "coarse_coarse_coordination")
    return dict(zip(names, np.transpose(rows), strict=True))
