"""The paper's form in the moments <l^n> of branch lengths: Eqs. 9 to 15 and 22."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

# theta of the paper's form above which it says no more than that.
DEGENERATE = 0.99


def admissibility_problem(initial_moment: float, ultimate_moment: float) -> str | None:
    r"""Return why crushing from one grading to another is not admissible, and what to change.

    .. math:: 0 < \langle l^n \rangle_u \le \langle l^n \rangle_0 < \infty

    Parameters
    ----------
    initial_moment, ultimate_moment : float
        <l^n>_0 and <l^n>_u of the two gradings, in one unit [m^n].

    Returns
    -------
    str or None
        None when it is admissible.

    Examples
    --------
    >>> admissibility_problem(1.0, 0.25) is None
    True
    >>> print(admissibility_problem(1.0, 1.5).split(",")[0])
    the ultimate grading is coarser than the initial one: its mean of l^n is 1.5 times as large

    References
    ----------
    Paper, Eqs. 15 and 22.
    """
    if not (0 < initial_moment < np.inf and 0 < ultimate_moment < np.inf):
        return (
            "the mean of l^n must be positive and finite for both gradings: initial"
            f" {initial_moment:.3g}, ultimate {ultimate_moment:.3g}"
        )
    if ultimate_moment > initial_moment:
        return (
            "the ultimate grading is coarser than the initial one: its mean of l^n is"
            f" {ultimate_moment / initial_moment:.4g} times as large, so crushing would create"
            " energy. Raise thermodynamics.ultimate_alpha, which makes the ultimate grading finer,"
            " or let both reach finer sizes: a smaller grading.min"
        )
    return None


def reference_energy(
    elastic_energy: ArrayLike, moment: float, exponent: float, reference_length: float
) -> NDArray:
    r"""Return the energy of the branches of the reference length.

    .. math:: \psi_r = \frac{\Psi_0}{\langle f \rangle_0}
        = \frac{\Psi_0\, l_r^n}{\langle l^n \rangle_0}

    Parameters
    ----------
    elastic_energy : array_like
        Psi_0, any shape [J/m3].
    moment : float
        <l^n>_0 [m^n].
    exponent : float
        n of the energy split [-].
    reference_length : float
        l_r [m].

    Returns
    -------
    ndarray
        Shape of `elastic_energy` [J/m3].

    Examples
    --------
    >>> float(reference_energy(2.0, moment=1.0, exponent=3.0, reference_length=0.5))
    0.25

    References
    ----------
    Paper, Eqs. 9 to 11.
    """
    return np.multiply(elastic_energy, reference_length**exponent / moment)
