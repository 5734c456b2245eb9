"""What the energy of a branch depends on: predictors side by side, judged on seeds left out.

Every predictor gives the mean energy of a branch from its two radii. Each is fitted to all branches
of some seeds and then asked about the branches of the others.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from branchcrush.energy.fit import Curvature, FittedPredictor
from branchcrush.errors import FitError
from branchcrush.statistics.gamma_regression import deviance, gamma_fit, parameter_intervals
from branchcrush.statistics.intervals import Resampling, pooled_interval

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
    design: Callable
    label: str
    color: str
    marker: str


def _linear(columns, start):
    """Return the design of a linear predictor from what makes its columns of ln r_min, ln r_max."""

    def design(theta, small=None, large=None):
        if theta is None:
            return [0.0, *start]
        slope = np.stack([np.ones_like(small), *columns(small, large)], axis=1)
        return slope @ theta, slope

    return design


def log_length(small, large):
    """Return ln((r_min + r_max)/R_max) from ln(r_min/R_max) and ln(r_max/R_max)."""
    return large + np.log1p(np.exp(small - large))


def _log_reduced(small, large):
    return small + large - log_length(small, large)


def _grain_sizes(theta, small=None, large=None):
    if theta is None:
        return [0.0, 3.0]
    share = 1.0 / (1.0 + np.exp(theta[1] * (small - large)))  # of the larger grain
    eta = theta[0] + theta[1] * large - np.log(share)
    return eta, np.stack([np.ones_like(small), share * large + (1.0 - share) * small], axis=1)


PREDICTORS = {
    "branch_length": Predictor(
        "A l^n",
        ("exponent",),
        _linear(lambda s, g: [log_length(s, g)], [3.0]),
        label="branch length l",
        color="#1f4e79",
        marker="o",
    ),
    "reduced_radius": Predictor(
        "A (r1 r2/(r1 + r2))^n",
        ("exponent",),
        _linear(lambda s, g: [_log_reduced(s, g)], [2.0]),
        label="reduced radius R*",
        color="#3a7d44",
        marker="D",
    ),
    "both_radii": Predictor(
        "A r_min^a r_max^b",
        ("a", "b"),
        _linear(lambda s, g: [s, g], [1.0, 2.0]),
        label=r"$r_{min}^a\, r_{max}^b$",
        color="#8a5aa5",
        marker="^",
    ),
    "grain_size": Predictor(
        "A (r1^q + r2^q)",
        ("exponent",),
        _grain_sizes,
        label="grain size (Einav)",
        color="#c1440e",
        marker="s",
    ),
    "surface": Predictor(
        "exp of a full quadratic in ln r_min and ln r_max",
        ("s", "g", "ss", "sg", "gg"),
        _linear(lambda s, g: [s, g, s * s, s * g, g * g], [1.0, 2.0, 0.0, 0.0, 0.0]),
        label="any smooth function of both",
        color="#444444",
        marker="|",
    ),
}
_CONSTANT = _linear(lambda s, g: [], [])


def branch_columns(radius_i, radius_j, energy, radius_max):
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
    radius_i, radius_j, energy = (np.asarray(x, dtype=float) for x in (radius_i, radius_j, energy))
    kept = energy > _RESIDUE * (energy.mean() if energy.size else 0.0)
    first, second = radius_i[kept] / radius_max, radius_j[kept] / radius_max
    return np.log(np.minimum(first, second)), np.log(np.maximum(first, second)), energy[kept]


def compared_predictors(seeds, *, confidence=0.95, resamples=2000):
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
        As in `PREDICTORS`. Where no seeds can be left out, as when there is one, what is explained
        is nan and `left_out_reason` says why.
    """
    options = {"confidence": confidence, "resamples": resamples}
    nothing, _ = _judged(seeds, _CONSTANT)
    by_length, fitted = None, []
    for name, predictor in PREDICTORS.items():
        try:
            fit = gamma_fit(seeds, predictor.design)
        except FitError as error:
            fitted.append(FittedPredictor.without(name, predictor.formula, str(error)))
            continue
        limits = parameter_intervals(fit, rng=Resampling.PREDICTORS.rng(), **options)
        # The first parameter is the scale.
        parameters = {key: limits.part(k) for k, key in enumerate(predictor.names, start=1)}
        left_out, reason = _judged(seeds, predictor.design, fit.parameters)
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
                exponent=parameters["exponent"].estimate if name == "branch_length" else None,
                left_out_reason=reason or None,
            )
        )
    return tuple(fitted)


def _judged(seeds, design, start=None):
    """Return the deviance of every seed from the fit to the others, and why if there is none."""
    try:
        return _left_out(seeds, design, start), ""
    except FitError as error:
        return np.full(len(seeds), np.nan), str(error)


def _left_out(seeds, design, start):
    if len(seeds) == 1:
        raise FitError("one seed: there is none to leave out")
    found = np.empty(len(seeds))
    for group in np.array_split(np.arange(len(seeds)), min(len(seeds), _FOLDS)):
        others = [seed for number, seed in enumerate(seeds) if number not in group]
        try:
            parameters = gamma_fit(others, design, start).parameters
        except FitError as error:
            raise FitError(f"without some of the seeds: {error}") from error
        for number in group:
            found[number] = deviance(seeds[number], design, parameters)
    return found


def _gained(other, deviances, nothing, options):
    """Return how much less deviance there is than by another predictor, over that of none."""
    return pooled_interval(
        np.stack([other - deviances, nothing], axis=1),
        lambda x: x[:, 0] / x[:, 1],
        rng=Resampling.PREDICTORS.rng(),
        **options,
    )


def curvature(seeds, *, confidence=0.95, resamples=2000):
    r"""Return how far the energies are from a power law of branch length: its curvature.

    .. math:: \ln \langle E \rangle = \ln A + n \ln\frac{l}{l_0} + c \left(\ln\frac{l}{l_0}\right)^2

    l_0 is the geometric mean length, so n is the slope there. The power law is contradicted when
    the interval of c leaves out 0. The slopes at short and long branches, n + 2 c ln(l/l_0), say
    what that amounts to.

    Parameters
    ----------
    seeds, confidence, resamples
        As for `compared_predictors`.

    Returns
    -------
    Curvature

    Raises
    ------
    FitError
        When fewer than three lengths carry energy.
    """
    logs = np.concatenate([log_length(small, large) for small, large, _ in seeds])
    centre = logs.mean() if logs.size else 0.0
    short, long = np.quantile(logs - centre, [0.1, 0.9]) if logs.size else (0.0, 0.0)
    del logs

    def columns(small, large):
        x = log_length(small, large) - centre
        return [x, x * x]

    fit = gamma_fit(seeds, _linear(columns, [3.0, 0.0]))

    def wanted(theta):
        slope, bend = theta[:, 1], theta[:, 2]
        return np.stack([bend, slope + 2 * bend * short, slope, slope + 2 * bend * long], axis=1)

    limits = parameter_intervals(
        fit, wanted, confidence=confidence, resamples=resamples, rng=Resampling.PREDICTORS.rng()
    )
    return Curvature(*(limits.part(number) for number in range(4)))
