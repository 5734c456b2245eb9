"""The crushing model in all its forms: energy, stress and driving force for a strain and C.

A form is two functions of C: by what factor the elastic energy changes at equal elastic strain,
and how the solid fraction at jamming moves. The paper's, Einav's and ours differ in these alone.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.crushing.curves import UNCHANGED, Curve
from branchcrush.crushing.elasticity import Elasticity


@dataclass(frozen=True)
class ModelForm:
    r"""A form of the crushing model: how C changes the stored energy and the jamming point.

    .. math:: \Psi(\epsilon, C) = \frac{g(C)}{j(C)}\, \Psi_0(\epsilon_e), \qquad
        1 - \epsilon = \frac{1 - \epsilon_e}{j(C)}

    .. math:: \sigma = \frac{\partial \Psi}{\partial \epsilon} = g\, p_0(\epsilon_e), \qquad
        E_C = -\frac{\partial \Psi}{\partial C} = \frac{g}{j} \left\{ (\ln j)'
        \left[\Psi_0 + (1 - \epsilon_e)\, p_0\right] - (\ln g)'\, \Psi_0 \right\}

    Psi_0 is per volume at jamming before crushing, and so is Psi; the total strain eps counts
    from there. j = 1 leaves the jamming point alone, as the paper and Einav do: then
    eps_e = eps and E_C = -g' Psi_0. Arguments of "any shape" broadcast.

    Parameters
    ----------
    factor : Curve
        g, of the energy at equal elastic strain [-].
    jamming : Curve
        j = phi_J(C)/phi_J(0) [-].

    Examples
    --------
    >>> from branchcrush.crushing.curves import LinearCurve
    >>> from branchcrush.crushing.elasticity import PowerLawElasticity
    >>> form, law = ModelForm(LinearCurve(0.5)), PowerLawElasticity(2.0, 1.0)
    >>> float(form.stress(0.1, 0.5, law)), float(form.driving_force(0.1, 0.5, law))
    (0.15000000000000002, 0.005000000000000001)

    References
    ----------
    Paper, Eqs. 16 to 23, for j = 1 and g = 1 - theta C.
    """

    factor: Curve
    jamming: Curve = UNCHANGED

    @property
    def knots(self) -> NDArray:
        """C between which the form is smooth, from 0 to the last one that it is meant for [-]."""
        knots = np.union1d(self.factor.knots, self.jamming.knots)
        return knots[knots <= min(self.factor.knots[-1], self.jamming.knots[-1])]

    def elastic_strain(self, strain: ArrayLike, crushing: ArrayLike) -> NDArray:
        r"""Return the strain from the jamming point where it is now.

        .. math:: \epsilon_e = 1 - j\, (1 - \epsilon)

        Parameters
        ----------
        strain, crushing : array_like
            eps, total, and C, any shape [-].

        Returns
        -------
        ndarray
            [-]; below 0 grains are apart.
        """
        # So that nothing is rounded away where the jamming point stays.
        moved = self.jamming.value(crushing) - 1.0
        return np.subtract(strain, moved * np.subtract(1.0, strain))

    def total_strain(self, elastic_strain: ArrayLike, crushing: ArrayLike) -> NDArray:
        r"""Return the strain from the jamming point before crushing.

        .. math:: \epsilon = 1 - (1 - \epsilon_e)/j

        Parameters
        ----------
        elastic_strain, crushing : array_like
            eps_e and C, any shape [-].

        Returns
        -------
        ndarray
            [-]
        """
        moved = 1.0 - 1.0 / self.jamming.value(crushing)
        return np.add(elastic_strain, moved * np.subtract(1.0, elastic_strain))

    def free_energy(
        self, strain: ArrayLike, crushing: ArrayLike, elasticity: Elasticity
    ) -> NDArray:
        """Return the stored energy.

        Parameters
        ----------
        strain, crushing : array_like
            eps, total, and C, any shape [-].
        elasticity : Elasticity

        Returns
        -------
        ndarray
            Psi, per volume at jamming before crushing [J/m3].
        """
        energy = elasticity.energy(self.elastic_strain(strain, crushing))
        return self.factor.value(crushing) / self.jamming.value(crushing) * energy

    def stress(self, strain: ArrayLike, crushing: ArrayLike, elasticity: Elasticity) -> NDArray:
        """Return the mean stress.

        Parameters
        ----------
        strain, crushing : array_like
            eps, total, and C, any shape [-].
        elasticity : Elasticity

        Returns
        -------
        ndarray
            sigma [Pa].
        """
        pressure = elasticity.pressure(self.elastic_strain(strain, crushing))
        return self.factor.value(crushing) * pressure

    def driving_force(
        self, strain: ArrayLike, crushing: ArrayLike, elasticity: Elasticity
    ) -> NDArray:
        """Return the energy that more crushing would set free.

        Parameters
        ----------
        strain, crushing : array_like
            eps, total, and C, any shape [-].
        elasticity : Elasticity

        Returns
        -------
        ndarray
            E_C [J/m3]; below 0 crushing would cost elastic energy.
        """
        elastic = self.elastic_strain(strain, crushing)
        energy, pressure = elasticity.energy(elastic), elasticity.pressure(elastic)
        released = self.jamming.log_slope(crushing) * (energy + (1.0 - elastic) * pressure)
        released = released - self.factor.log_slope(crushing) * energy
        return self.factor.value(crushing) / self.jamming.value(crushing) * released

    def tangent_stiffness(
        self, strain: ArrayLike, crushing: ArrayLike, elasticity: Elasticity
    ) -> NDArray:
        r"""Return the elastic stiffness of unloading, at a C that stays.

        .. math:: \frac{\partial \sigma}{\partial \epsilon} = g\, j\, p_0'(\epsilon_e)

        Parameters
        ----------
        strain, crushing : array_like
            eps, total, and C, any shape [-].
        elasticity : Elasticity

        Returns
        -------
        ndarray
            [Pa]
        """
        stiffness = elasticity.stiffness(self.elastic_strain(strain, crushing))
        return self.factor.value(crushing) * self.jamming.value(crushing) * stiffness
