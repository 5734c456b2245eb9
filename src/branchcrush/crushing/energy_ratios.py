"""What a form says of the energy of gradings beside each other: at equal strain, or stress."""

from numpy.typing import ArrayLike, NDArray

from branchcrush.crushing.elasticity import Elasticity
from branchcrush.crushing.forms import ModelForm


def ratio_at_equal_strain(form: ModelForm, crushing: ArrayLike) -> NDArray:
    r"""Return the energy over that at C = 0, each at one strain from its own jamming point.

    .. math:: \frac{\Psi_J(C)}{\Psi_J(0)} = g(C), \qquad \Psi_J = g\, \Psi_0(\epsilon_e)

    Per volume at the jamming point of each. At equal a Psi_J/p it is the same: energy and pressure
    both have the factor g, which leaves a Psi_0/p_0, a function of the elastic strain alone.

    Parameters
    ----------
    form : ModelForm
    crushing : array_like
        C, any shape [-].

    Returns
    -------
    ndarray
        [-]

    Examples
    --------
    >>> from branchcrush.crushing.curves import LinearCurve
    >>> float(ratio_at_equal_strain(ModelForm(LinearCurve(0.6)), 0.5))
    0.7
    """
    return form.factor.value(crushing)


def ratio_at_equal_stress(
    form: ModelForm, crushing: ArrayLike, elasticity: Elasticity, stress: float
) -> NDArray:
    r"""Return the energy over that at C = 0, under one stress.

    .. math:: \frac{g\, \Psi_0(\epsilon_e)}{\Psi_0(\epsilon_{e0})}, \qquad
        g\, p_0(\epsilon_e) = p_0(\epsilon_{e0}) = \sigma

    Per volume at the jamming point of each. For a power law it is g^(-1/(a - 1)), with a = 2 for
    linear contacts and 5/2 for Hertz's.

    Parameters
    ----------
    form : ModelForm
    crushing : array_like
        C, any shape [-].
    elasticity : Elasticity
    stress : float
        sigma, above 0 [Pa].

    Returns
    -------
    ndarray
        [-]

    Examples
    --------
    >>> from branchcrush.crushing.curves import LinearCurve
    >>> from branchcrush.crushing.elasticity import PowerLawElasticity
    >>> four_times = ModelForm(LinearCurve(-3.0))
    >>> round(float(ratio_at_equal_stress(four_times, 1.0, PowerLawElasticity(1.0, 1.0), 0.1)), 12)
    0.25
    """
    factor = form.factor.value(crushing)
    energy = factor * elasticity.energy(elasticity.strain_at_pressure(stress / factor))
    return energy / elasticity.energy(elasticity.strain_at_pressure(stress))


def ratio_at_equal_total_strain(
    form: ModelForm, crushing: ArrayLike, elasticity: Elasticity, strain: float
) -> NDArray:
    r"""Return the energy over that at C = 0, at one solid fraction.

    .. math:: \frac{g}{j}\, \frac{\Psi_0[1 - j (1 - \epsilon)]}{\Psi_0(\epsilon)}

    Parameters
    ----------
    form : ModelForm
    crushing : array_like
        C, any shape [-].
    elasticity : Elasticity
    strain : float
        eps, from the jamming point before crushing, beyond the onset [-].

    Returns
    -------
    ndarray
        [-]; 0 where the grading is loose at this solid fraction.

    Examples
    --------
    >>> from branchcrush.crushing.curves import LinearCurve
    >>> from branchcrush.crushing.elasticity import PowerLawElasticity
    >>> denser = ModelForm(LinearCurve(0.0), LinearCurve(-0.2))
    >>> law = PowerLawElasticity(1.0, 1.0)
    >>> ratio_at_equal_total_strain(denser, [0.0, 0.25, 1.0], law, 0.1).round(3).tolist()
    [1.0, 0.288, 0.0]
    """
    energy = form.free_energy(strain, crushing, elasticity)
    return energy / form.free_energy(strain, 0.0, elasticity)
