"""The elastic law of a sample before crushing, from its loading path."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from branchcrush.crushing.elastic_fits import fit_elasticity, interpolated_elasticity
from branchcrush.crushing.elasticity import Elasticity, PowerLawElasticity
from branchcrush.errors import FitError
from branchcrush.samples.ensemble import stacked
from branchcrush.statistics.intervals import Interval

Kind = Literal["power_law", "linear", "hertz", "pressure_dependent", "measured"]
# Exponents of the stress in the strain, m, that contact laws fix.
_EXPONENTS: Mapping[str, float] = {"linear": 1.0, "hertz": 1.5}
UNKNOWN = Interval(np.nan, np.nan, np.nan)


@dataclass(frozen=True)
class MeasuredElasticity:
    """The elastic law of a sample before crushing, and how it was found."""

    law: Elasticity
    kind: str  # as configured
    jamming: float  # phi_J that strains count from [-]
    jamming_interval: tuple[float, float]  # nan where it is not known [-]
    r_squared: float  # of the energies of all packings [-]
    free: tuple[float, float, float]  # phi_J, m, R^2 of the fit that finds phi_J too; nan for none
    largest: float  # strain of the densest state, from jamming [-]
    on_path: bool  # whether jamming lies after the approach
    reference_pressure: float  # p_r [Pa]
    sentences: list[str]  # how phi_J and law were found
    # Laws that the energies mean with the limits of phi_J, "low" and "high"; none where there is no
    # such limit, or no law from it.
    ends: Mapping[str, Elasticity]

    @property
    def ends_without_law(self) -> dict[str, float]:
        """The limits of phi_J that are known and give no law, by their names [-]."""
        limits = dict(zip(("low", "high"), self.jamming_interval, strict=True))
        return {
            name: limit
            for name, limit in limits.items()
            if np.isfinite(limit) and name not in self.ends
        }

    def summary(self) -> dict[str, Any]:
        """Return what `thermodynamics.json` tells of it."""
        power = self.law if isinstance(self.law, PowerLawElasticity) else None
        at_reference = self.law.strain_at_pressure(self.reference_pressure)
        return {
            "elasticity": self.kind,
            "elastic_modulus_Pa": power.modulus if power else None,
            "elastic_exponent": power.exponent if power else None,
            "elastic_r_squared": self.r_squared,
            "reference_pressure_Pa": self.reference_pressure,
            "modulus_at_reference_pressure_Pa": float(self.law.stiffness(at_reference)),
            **Interval(self.jamming, *self.jamming_interval).named("jamming_solid_fraction"),
            "jamming_on_path": self.on_path,
            "free_jamming_solid_fraction": self.free[0],
            "free_elastic_exponent": self.free[1],
            "free_elastic_r_squared": self.free[2],
            "largest_strain": self.largest,
            "elasticity_sentences": self.sentences,
        }


def certified_jamming(
    jamming: pd.DataFrame, used: Sequence[int], confidence: float = 0.95
) -> Interval:
    r"""Return the mean jamming point of packings by their stress, with Student's interval.

    .. math:: \bar\phi_J \pm t_{S-1}\, s/\sqrt{S}

    Parameters
    ----------
    jamming : DataFrame
        `jamming.csv`.
    used : sequence of int
        Which seeds, counted from 0.
    confidence : float
        [-]

    Returns
    -------
    Interval
        nan where no packing has one; without limits where one has.

    Examples
    --------
    >>> points = pd.DataFrame({"jamming_solid_fraction_loading": [0.63, 0.65, np.nan]})
    >>> found = certified_jamming(points, [0, 1, 2])
    >>> round(found.estimate, 6), round(found.high - 0.64, 4)
    (0.64, 0.1271)
    """
    points = jamming["jamming_solid_fraction_loading"].iloc[list(used)].dropna().to_numpy()
    if points.size < 2:
        return Interval(points[0] if points.size else np.nan, np.nan, np.nan)
    from scipy.special import stdtrit  # slow to import, and few jobs need it

    error = points.std(ddof=1) / np.sqrt(points.size)
    half = float(stdtrit(points.size - 1, (1.0 + confidence) / 2.0) * error)
    mean = float(points.mean())
    return Interval(mean, mean - half, mean + half)


def measured_elasticity(
    paths: Sequence[pd.DataFrame],
    certified: Interval = UNKNOWN,
    *,
    kind: Kind = "power_law",
    pressure_exponent: float = 0.5,
    reference_pressure: float = 1e5,
) -> MeasuredElasticity:
    r"""Return the elastic law of the energies per volume of all seeds along the loading path.

    .. math:: \Psi_0 = \frac{\phi_J}{\phi}\, \frac{E}{V}, \quad \epsilon = 1 - \phi_J/\phi

    Psi_0 is per volume at jamming and eps the volumetric strain from there, so dPsi_0/deps is
    the mean stress. phi_J is that of the certificate, so that a sample has one; where there is
    none, or no law from there, it is fitted to the energies too.

    Parameters
    ----------
    paths : list of DataFrame
        A `path.csv` for each seed.
    certified : Interval
        phi_J of the packings by their stress, from `certified_jamming` [-].
    kind : {"power_law", "linear", "hertz", "pressure_dependent", "measured"}
    pressure_exponent : float
        q of the law whose modulus depends on pressure, from 0 to below 1 [-].
    reference_pressure : float
        p_r at which its modulus is told [Pa].

    Returns
    -------
    MeasuredElasticity

    Raises
    ------
    FitError
        When too few states carry load for the law.
    """
    together = stacked(paths)
    phi = together["solid_fraction"].to_numpy()
    density = (together["elastic_energy_J"] / together["volume_m3"]).to_numpy()
    exponents = {**_EXPONENTS, "pressure_dependent": 1.0 / (1.0 - pressure_exponent)}
    exponent = exponents.get(kind)

    def law_from(jamming: float) -> tuple[Elasticity, int]:
        if kind != "measured":
            return fit_elasticity(phi, density, exponent=exponent, jamming=jamming)[0], 0
        means = together.assign(density=density).groupby("state")[["solid_fraction", "density"]]
        return interpolated_elasticity(*means.mean().to_numpy().T, jamming)

    try:
        power, jamming = fit_elasticity(phi, density, exponent=exponent)
        free = jamming, power.exponent, _r_squared(power, jamming, phi, density)
    except ValueError as error:
        if not np.isfinite(certified.estimate):
            raise FitError(f"no elastic law in the loading path: {error}") from error
        free = np.nan, np.nan, np.nan
    reason = "the certificate has no φ_J"
    law, jamming, limits = None, float(certified.estimate), (certified.low, certified.high)
    try:
        if np.isfinite(jamming):
            law, left_out = law_from(jamming)
    except ValueError as error:
        reason = f"from that of the certificate, {jamming:.4f}, there is no law: {error}"
        if not np.isfinite(free[0]):
            raise FitError(f"no elastic law in the loading path: {error}") from error
    fallback = law is None
    if fallback:
        jamming, limits = free[0], (np.nan, np.nan)
        try:
            law, left_out = law_from(jamming)
        except ValueError as error:
            raise FitError(f"no elastic law in the loading path: {error}") from error
    largest = float(1.0 - jamming / phi.max())
    fit = _r_squared(law, jamming, phi, density)
    sentences = [
        f"φ_J of the elastic law is fitted to the energies, {jamming:.4f}: {reason}."
        if fallback
        else _one_jamming(certified, free, fit, len(paths))
    ]
    if kind == "measured":
        sentences += _of_interpolation(law, left_out, largest)
    ends = {}
    for name, limit in zip(("low", "high"), limits, strict=True):
        try:
            if np.isfinite(limit):
                ends[name] = law_from(float(limit))[0]
        except ValueError as error:
            sentences.append(f"No law for the band from φ_J = {limit:.4f}: {error}.")
    return MeasuredElasticity(
        law=law,
        kind=kind,
        jamming=jamming,
        jamming_interval=limits,
        r_squared=fit,
        free=free,
        largest=largest,
        on_path=bool(jamming > max(path["solid_fraction"][1] for path in paths)),
        reference_pressure=reference_pressure,
        sentences=sentences,
        ends=ends,
    )


def _r_squared(law: Elasticity, jamming: float, phi: NDArray, density: NDArray) -> float:
    """Return the share of the scatter of the energies that a law accounts for."""
    fitted = phi / jamming * law.energy(1.0 - jamming / phi)
    residual = np.sum((density - fitted) ** 2)
    return float(1.0 - residual / np.sum((density - density.mean()) ** 2))


def _one_jamming(
    certified: Interval, free: tuple[float, float, float], r_squared: float, packings: int
) -> str:
    known = (
        "" if not np.isfinite(certified.low) else f" ± {certified.high - certified.estimate:.4f}"
    )
    many = "packings" if packings > 1 else "packing"
    sentence = (
        f"Strains count from φ_J = {certified.estimate:.4f}{known} of {packings} {many} by their "
        f"stress: R² of the energies is {r_squared:.4f}"
    )
    if not np.isfinite(free[0]):
        return f"{sentence}; the energies alone give none."
    return (
        f"{sentence}; fitted to the energies alone it would be {free[0]:.4f}, with m = "
        f"{free[1]:.2f} and R² = {free[2]:.4f}."
    )


def _of_interpolation(law: Elasticity, left_out: int, largest: float) -> list[str]:
    first, last = law.knots[1], law.knots[-1]
    power = last * float(law.pressure(last) / law.energy(last))
    sentences = [
        f"The measured law goes through the mean energy of {law.knots.size - 1} states, from a "
        f"strain of {first:.4f} to {last:.4f}; beyond these it goes on as powers of the strain, "
        f"above them with the exponent {power:.2f} of the energy: curves beyond the packings' "
        f"largest strain, {largest:.4f}, rest on no packing."
    ]
    if left_out:
        states = "state" if left_out == 1 else "states"
        sentences.append(
            f"{left_out} {states} next to jamming left out: through them the pressure would "
            "fall, or begin with a step."
        )
    return sentences
