"""How strong a grain is: Weibull's distribution, the effect of size, and draws by descent."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from branchcrush.packings.geometry import Real

# Which of a grain's own streams of random numbers: for its strength, for its fragments' rotation.
_STRENGTH, _ROTATION = 0, 1


@dataclass(frozen=True, kw_only=True)
class Strength:
    r"""Strength of the grains of a material against their size.

    .. math:: s = s_0 \left(\frac{d}{d_0}\right)^{-b} w, \qquad P(w > x) = e^{-x^m}

    Parameters
    ----------
    strength : float
        s_0, which 37 % of the grains of the reference diameter survive; above 0, or infinite [Pa].
    weibull_modulus : float
        m, above 0 [-].
    reference_diameter : float
        d_0, above 0 [m].
    size_exponent : float
        b; Weibull's own is 3/m, where flaws fill the volume [-].

    Examples
    --------
    >>> sand = Strength(strength=2e7, weibull_modulus=3.0, reference_diameter=1e-3,
    ...                 size_exponent=1.0)
    >>> round(sand.of(0.5e-3, 1.0))
    40000000

    References
    ----------
    McDowell and Bolton (1998), Géotechnique 48, 667-679.
    """

    strength: float
    weibull_modulus: float
    reference_diameter: float
    size_exponent: float

    def of(self, diameter: Real, factor: Real) -> Real:
        """Return the strength of grains.

        Parameters
        ----------
        diameter : float or ndarray, shape (N,)
            [m]
        factor : float or ndarray, shape (N,)
            w, from `weibull_factor` [-].

        Returns
        -------
        float or ndarray, shape (N,)
            s [Pa].
        """
        return self.strength * (diameter / self.reference_diameter) ** -self.size_exponent * factor


def weibull_factor(seed: int, descent: Sequence[int], modulus: float) -> float:
    r"""Return how much stronger a grain is than what 37 % of its size survive.

    .. math:: w = (-\ln u)^{1/m}

    u is drawn from a stream of the grain's own, told by its descent. So neither the order in which
    grains break, nor ranks, nor a run that was continued change it.

    Parameters
    ----------
    seed : int
        Of the packing.
    descent : sequence of int
        The grain of the first packing that it comes from, then which fragment of it, and so on.
    modulus : float
        m [-].

    Returns
    -------
    float
        w [-].

    Examples
    --------
    >>> weibull_factor(1, (7, 3), 3.0) == weibull_factor(1, (7, 3), 3.0)
    True
    >>> weibull_factor(1, (7, 3), 3.0) == weibull_factor(1, (7, 4), 3.0)
    False
    """
    # 1 - u is above 0, as u is below 1.
    return float((-np.log1p(-_stream(seed, _STRENGTH, descent).random())) ** (1.0 / modulus))


def rotation_stream(seed: int, descent: Sequence[int]) -> np.random.Generator:
    """Return the random numbers that turn the fragments of a grain, told by its descent.

    Parameters
    ----------
    seed : int
        Of the packing.
    descent : sequence of int
        As for `weibull_factor`.

    Returns
    -------
    numpy.random.Generator
    """
    return _stream(seed, _ROTATION, descent)


def _stream(seed: int, kind: int, descent: Sequence[int]) -> np.random.Generator:
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(kind, *descent)))
