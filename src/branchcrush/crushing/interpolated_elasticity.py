"""An elastic law through measured energies, with the methods of `elasticity.Elasticity`."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

# The least number of states that a measured law goes through.
FEWEST_KNOTS = 3
# Exponent of the energy next to jamming: at 1 the pressure would begin with a step.
_LEAST_POWER = 1.5
# Places between two states at which the pressure must rise.
_LOOKS = 65
_ONLY_ROUNDING = {"xatol": 0.0, "xrtol": 4e-16, "fatol": 0.0, "frtol": 0.0}


@dataclass(frozen=True)
class InterpolatedElasticity:
    r"""The energies of measured states, and between them no hills or valleys that are not there.

    .. math:: \ln \Psi_0 = Y(\ln \epsilon), \qquad p_0 = \frac{\Psi_0}{\epsilon}\, Y', \qquad
        \frac{dp_0}{d\epsilon} = \frac{\Psi_0}{\epsilon^2}\, [Y'' + Y'\,(Y' - 1)]

    Y is SciPy's PCHIP, so Psi_0 goes through every state and p_0 is continuous; a power law is met
    exactly. From jamming to the first state, and beyond the last one, Y goes on straight: a power
    law of the exponent that the energy has there.

    Parameters
    ----------
    strain : tuple of float
        eps of the states from jamming, increasing, above 0 [-].
    energy : tuple of float
        Psi_0, increasing, above 0 [J/m3].

    Raises
    ------
    ValueError
        For other than three or more such states, where p_0 would fall between them, or where the
        energy goes as less than the power 1.5 of the strain at the first one.

    Examples
    --------
    >>> law = InterpolatedElasticity((0.1, 0.2, 0.4), (1.0, 4.0, 16.0))
    >>> law.pressure([0.05, 0.1, 0.3, 0.5]).round(9).tolist()
    [10.0, 20.0, 60.0, 100.0]
    >>> law.strain_at_energy([0.0, 9.0]).round(9).tolist()
    [0.0, 0.3]

    References
    ----------
    Fritsch and Carlson (1980), SIAM J. Numer. Anal. 17, 238-246.
    """

    strain: tuple[float, ...]
    energy_at: tuple[float, ...]

    def __post_init__(self) -> None:
        strain, energy = np.array(self.strain), np.array(self.energy_at)
        rising = all(
            np.isfinite(values).all() and values[0] > 0 and (np.diff(values) > 0).all()
            for values in (strain, energy)
            if values.size
        )
        if not (strain.shape == energy.shape and strain.size >= FEWEST_KNOTS and rising):
            raise ValueError(
                f"a measured law needs {FEWEST_KNOTS} or more states whose strains and energies "
                "are above 0 and increase"
            )
        places = np.linspace(self._ends[:-1], self._ends[1:], _LOOKS)
        falls = (self._rise(places) < 0).any(axis=0)
        if falls.any():
            raise ValueError(
                "the pressure that the energies mean would not rise from a strain of "
                f"{self.strain[int(np.argmax(falls))]:.4g} on"
            )
        power = float(self._slope(self._ends[0]))
        if power < _LEAST_POWER:
            raise ValueError(
                f"the energies mean the power {power:.2f} of the strain next to jamming, and need "
                f"{_LEAST_POWER:g} for a pressure that begins at nothing"
            )

    def pressure(self, strain: ArrayLike) -> NDArray:
        """Return the pressure at a strain.

        Parameters
        ----------
        strain : array_like
            eps, any shape [-].

        Returns
        -------
        ndarray
            p_0 [Pa]; 0 up to jamming.
        """
        return self._where_loaded(strain, lambda x: np.exp(self._log(x) - x) * self._slope(x))

    def energy(self, strain: ArrayLike) -> NDArray:
        """Return the elastic energy at a strain.

        Parameters
        ----------
        strain : array_like
            eps, any shape [-].

        Returns
        -------
        ndarray
            Psi_0 [J/m3]; 0 up to jamming.
        """
        return self._where_loaded(strain, lambda x: np.exp(self._log(x)))

    def stiffness(self, strain: ArrayLike) -> NDArray:
        """Return the stiffness at a strain; it jumps at the states.

        Parameters
        ----------
        strain : array_like
            eps, any shape [-].

        Returns
        -------
        ndarray
            dp_0/deps [Pa]; 0 up to jamming.
        """
        return self._where_loaded(strain, lambda x: np.exp(self._log(x) - 2 * x) * self._rise(x))

    def strain_at_energy(self, energy: ArrayLike) -> NDArray:
        """Return the strain at which an energy is stored.

        Parameters
        ----------
        energy : array_like
            Psi_0, any shape, 0 or more [J/m3].

        Returns
        -------
        ndarray
            eps [-]; 0 at zero energy.
        """
        return self._inverse(energy, self._log, self._slope(self._ends))

    def strain_at_pressure(self, pressure: ArrayLike) -> NDArray:
        """Return the strain at a pressure.

        Parameters
        ----------
        pressure : array_like
            p_0, any shape, 0 or more [Pa].

        Returns
        -------
        ndarray
            eps [-]; 0 at none.
        """

        def logarithm(x: NDArray) -> NDArray:
            return self._log(x) - x + np.log(self._slope(x))

        return self._inverse(pressure, logarithm, self._slope(self._ends) - 1.0)

    @property
    def knots(self) -> NDArray:
        """Jamming and the states."""
        return np.append(0.0, self.strain)

    @cached_property
    def _ends(self) -> NDArray:
        """The logarithms of the strains of the states."""
        return np.log(self.strain)

    @cached_property
    def _curve(self) -> tuple[Callable, Callable, Callable]:
        from scipy.interpolate import PchipInterpolator  # slow to import, and few jobs need it

        curve = PchipInterpolator(self._ends, np.log(self.energy_at))
        return curve, curve.derivative(), curve.derivative(2)

    def _log(self, x: ArrayLike) -> NDArray:
        """Return Y at the logarithm of the strain."""
        within = np.clip(x, self._ends[0], self._ends[-1])
        return self._curve[0](within) + self._curve[1](within) * (x - within)

    def _slope(self, x: ArrayLike) -> NDArray:
        return self._curve[1](np.clip(x, self._ends[0], self._ends[-1]))

    def _rise(self, x: ArrayLike) -> NDArray:
        """Return Y'' + Y' (Y' - 1): the pressure rises where it is above 0."""
        slope, inside = self._slope(x), (x >= self._ends[0]) & (x <= self._ends[-1])
        bend = np.where(inside, self._curve[2](np.clip(x, self._ends[0], self._ends[-1])), 0.0)
        return bend + slope * (slope - 1.0)

    def _where_loaded(self, strain: ArrayLike, result: Callable[[NDArray], NDArray]) -> NDArray:
        strain = np.asarray(strain, float)
        loaded = strain > 0
        return np.where(loaded, result(np.log(np.where(loaded, strain, 1.0))), 0.0)

    def _inverse(
        self, value: ArrayLike, logarithm: Callable[[NDArray], NDArray], powers: NDArray
    ) -> NDArray:
        """Return the strain at which a function, `powers` its slopes at the states, has a value."""
        from scipy.optimize.elementwise import find_root  # slow to import, and few jobs need it

        value = np.asarray(value, float)
        loaded = value > 0
        goal = np.log(np.where(loaded, value, 1.0))
        at_ends = logarithm(self._ends)
        # Straight on both sides of the states.
        x = np.where(
            goal < at_ends[0],
            self._ends[0] + (goal - at_ends[0]) / powers[0],
            self._ends[-1] + (goal - at_ends[-1]) / powers[-1],
        )
        inside = (goal >= at_ends[0]) & (goal < at_ends[-1])
        if inside.any():
            goals = goal[inside]
            after = np.searchsorted(at_ends, goals, side="right")
            found = find_root(
                lambda x, goal: logarithm(x) - goal,
                (self._ends[after - 1], self._ends[after]),
                args=(goals,),
                tolerances=_ONLY_ROUNDING,
            )
            x[inside] = found.x
        return np.where(loaded, np.exp(x), 0.0)
