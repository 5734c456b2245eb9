"""What the energy of a branch depends on: predictors side by side, judged on seeds left out.

Every predictor gives the mean energy of a branch from its two radii. Each is fitted to all branches
of some seeds and then asked about the branches of the others.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.energy.designs import (
    LinearDesign,
    grain_sizes,
    log_equality,
    log_length,
    log_reduced_radius,
    prepared,
)
from branchcrush.energy.state_fit import FittedPredictor
from branchcrush.errors import FitError
from branchcrush.statistics.gamma_regression import (
    deviance,
    fitted_parameters,
    gamma_fit,
    parameter_intervals,
)
from branchcrush.statistics.intervals import Interval
from branchcrush.statistics.resampling import Resampling, pooled_interval

# Of one seed: ln(r_min/R_max), ln(r_max/R_max) and energy [J] of each branch.
BranchColumns = tuple[NDArray, NDArray, NDArray]

# Over the mean energy of the packing: contacts of rattlers hold what relaxation leaves, 1e-10 of it
# or less, and forces below 1e-4 of the mean are no part of the network.
_RESIDUE = 1e-8
# Seeds are left out in so many groups, or one by one.
_FOLDS = 4


@dataclass(frozen=True)
class Predictor:
    """A mean energy as a function of two radii, in logarithms of R/R_max, and how it is drawn.

    Parameters
    ----------
    formula : str
    names : tuple of str
        Of the parameters after the scale.
    design : callable
        As `statistics.gamma_regression.gamma_fit` takes it.
    label : str
        What figures call it.
    color, marker : str
    """

    formula: str
    names: tuple[str, ...]
    design: Callable[..., Any]
    label: str
    color: str
    marker: str


PREDICTORS = {
    "branch_length": Predictor(
        "A l^n",
        ("exponent",),
        LinearDesign(lambda s, g: [log_length(s, g)], [3.0]),
        label="branch length l",
        color="#1f4e79",
        marker="o",
    ),
    "reduced_radius": Predictor(
        "A (r1 r2/(r1 + r2))^n",
        ("exponent",),
        LinearDesign(lambda s, g: [log_reduced_radius(s, g)], [2.0]),
        label="reduced radius R*",
        color="#3a7d44",
        marker="D",
    ),
    "both_radii": Predictor(
        "A r_min^a r_max^b",
        ("a", "b"),
        LinearDesign(lambda s, g: [s, g], [1.0, 2.0]),
        label=r"$r_{min}^a\, r_{max}^b$",
        color="#8a5aa5",
        marker="^",
    ),
    "grain_size": Predictor(
        "A (r1^n + r2^n)",
        ("exponent",),
        grain_sizes,
        label="grain size (Einav)",
        color="#c1440e",
        marker="s",
    ),
    # A mean energy that goes as a power where both radii are scaled alike is A l^q g(r_min/r_max).
    # By symmetry g is level at equal radii. This one holds l (t = 0) and R* (t = q), and a second
    # exponent explains no more on seeds left out.
    "length_and_ratio": Predictor(
        "A l^q (4 r1 r2/l^2)^t",
        ("length_exponent", "ratio_exponent"),
        LinearDesign(lambda s, g: [log_length(s, g), log_equality(s, g)], [3.0, 0.0]),
        label="length and ratio",
        color="#c99a1a",
        marker="v",
    ),
    "surface": Predictor(
        "exp of a full quadratic in ln r_min and ln r_max",
        ("s", "g", "ss", "sg", "gg"),
        LinearDesign(lambda s, g: [s, g, s * s, s * g, g * g], [1.0, 2.0, 0.0, 0.0, 0.0]),
        label="any smooth function of both",
        color="#444444",
        marker="|",
    ),
}
# Nothing but a scale: what is explained is explained beyond it.
_CONSTANT = LinearDesign(lambda s, g: [], [])


def branch_columns(
    radius_i: ArrayLike, radius_j: ArrayLike, energy: ArrayLike, radius_max: float
) -> BranchColumns:
    """Return the branches of a seed as the predictors take them; those that hold nothing left out.

    What a contact of a rattler holds, 1e-10 of the mean or less, is left by the relaxation and says
    nothing of radii; its logarithm would weigh heavily. Left out is less than 1e-8 of the mean.

    Parameters
    ----------
    radius_i, radius_j : array_like, shape (M,)
        [m]
    energy : array_like, shape (M,)
        [J]
    radius_max : float
        [m]

    Returns
    -------
    tuple of ndarray
        ln(r_min/R_max), ln(r_max/R_max), energy [J].

    Examples
    --------
    >>> [part.tolist() for part in branch_columns([1.0, 2.0], [2.0, 1.0], [3.0, 0.0], 1.0)]
    [[0.0], [0.6931471805599453], [3.0]]
    """
    held = np.asarray(energy, dtype=float)
    kept = held > _RESIDUE * (held.mean() if held.size else 0.0)
    first, second = (
        np.asarray(radius, dtype=float)[kept] / radius_max for radius in (radius_i, radius_j)
    )
    return np.log(np.minimum(first, second)), np.log(np.maximum(first, second)), held[kept]


def compared_predictors(
    seeds: Sequence[BranchColumns], *, confidence: float = 0.95, resamples: int = 2000
) -> tuple[FittedPredictor, ...]:
    r"""Return every predictor's parameters and what it explains on seeds left out of its fit.

    .. math:: D^2 = 1 - \frac{\sum_s D_s(\text{predictor})}{\sum_s D_s(\text{mean energy})}

    D_s is the gamma deviance of a seed from a fit to the other seeds (in at most four groups);
    1 would be an energy known exactly. Between predictors the same seeds are compared in pairs.

    Parameters
    ----------
    seeds : list of tuple
        From `branch_columns`, of each seed.
    confidence : float
    resamples : int

    Returns
    -------
    tuple of FittedPredictor
        In the order of `PREDICTORS`. Where no seeds can be left out, as when there is one, what is
        explained is nan and `left_out_reason` says why.

    Examples
    --------
    >>> rng = np.random.default_rng(1)
    >>> length = rng.uniform(0.5, 2.0, (2, 50))
    >>> seeds = [(np.log(l / 2), np.log(l / 2), l**3) for l in length]  # E = l^3, exactly
    >>> fitted = compared_predictors(seeds)[0]
    >>> fitted.name, round(fitted.exponent, 9), round(fitted.explained.estimate, 9)
    ('branch_length', 3.0, 1.0)
    """
    options: dict[str, Any] = {"confidence": confidence, "resamples": resamples}
    nothing, _ = _judged(seeds, _CONSTANT)
    by_length: NDArray | None = None
    fitted: list[FittedPredictor] = []
    for name, predictor in PREDICTORS.items():
        design, made = prepared(predictor.design, seeds)
        try:
            fit = gamma_fit(made, design)
        except FitError as error:
            fitted.append(FittedPredictor.without(name, predictor.formula, str(error)))
            continue
        limits = parameter_intervals(fit, rng=Resampling.PREDICTORS.rng(), **options)
        # The first parameter is the scale.
        parameters = {key: limits.part(k) for k, key in enumerate(predictor.names, start=1)}
        left_out, reason = _judged(made, design, fit.parameters)
        if name == "branch_length":
            by_length = left_out
        fitted.append(
            FittedPredictor(
                name,
                predictor.formula,
                parameters,
                explained=_gained(nothing, left_out, nothing, options),
                difference=None
                if by_length is None
                else _gained(by_length, left_out, nothing, options),
                # The one that the energy split is about; its exponent beside that of the bins.
                exponent=float(parameters["exponent"].estimate)
                if name == "branch_length"
                else None,
                left_out_reason=reason or None,
            )
        )
    return tuple(fitted)


def _judged(
    seeds: Sequence[tuple[NDArray, ...]], design: Callable[..., Any], start: NDArray | None = None
) -> tuple[NDArray, str]:
    """Return the deviance of every seed from the fit to the others, and why if there is none."""
    try:
        return _left_out(seeds, design, start), ""
    except FitError as error:
        return np.full(len(seeds), np.nan), str(error)


def _left_out(
    seeds: Sequence[tuple[NDArray, ...]], design: Callable[..., Any], start: NDArray | None
) -> NDArray:
    if len(seeds) == 1:
        raise FitError("one seed: there is none to leave out")
    deviances = np.empty(len(seeds))
    for group in np.array_split(np.arange(len(seeds)), min(len(seeds), _FOLDS)):
        others = [seed for number, seed in enumerate(seeds) if number not in group]
        try:
            parameters = fitted_parameters(others, design, start)
        except FitError as error:
            raise FitError(f"without some of the seeds: {error}") from error
        for number in group:
            deviances[number] = deviance(seeds[number], design, parameters)
    return deviances


def _gained(
    other: NDArray, deviances: NDArray, nothing: NDArray, options: dict[str, Any]
) -> Interval:
    """Return how much less deviance there is than by another predictor, over that of none."""
    return pooled_interval(
        np.stack([other - deviances, nothing], axis=1),
        lambda x: x[:, 0] / x[:, 1],
        rng=Resampling.PREDICTORS.rng(),
        **options,
    )
