"""The linear normal contact: force and elastic energy."""


def linear_force(overlap, normal_stiffness):
    r"""Return the repulsive normal force of a linear contact.

    .. math:: F = k \delta

    Parameters
    ----------
    overlap : array_like
        delta, positive where the grains touch [m].
    normal_stiffness : float
        k of the *contact*; two equal balls in series have 2k each [N/m].

    Returns
    -------
    array_like
        [N]

    Examples
    --------
    >>> linear_force(1e-6, 1e6)
    1.0
    """
    return normal_stiffness * overlap


def linear_energy(force, normal_stiffness):
    r"""Return the elastic energy stored by a linear contact.

    .. math:: E = F^2 / (2 k)

    The paper's Eq. 24 leaves out the 1/2, which is right only when k is the stiffness of each of
    two equal balls. The factor cancels in f(l), not in the free energy.

    Parameters
    ----------
    force : array_like
        Normal force [N].
    normal_stiffness : float
        k of the contact [N/m].

    Returns
    -------
    array_like
        [J]

    Examples
    --------
    >>> linear_energy(2.0, 4.0)
    0.5
    """
    return force**2 / (2.0 * normal_stiffness)
