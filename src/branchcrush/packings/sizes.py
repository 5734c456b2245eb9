"""Sizes that grains have: outside of them it is the unit that is wrong."""

# Diameters [m].
SMALLEST, LARGEST = 1e-9, 1e3


def size_problem(smallest: float, largest: float) -> str:
    """Return what is wrong with the diameters of grains, or "".

    Parameters
    ----------
    smallest, largest : float
        [m]

    Returns
    -------
    str

    Examples
    --------
    >>> size_problem(1e-3, 2e4)
    'diameters are 0.001 to 2e+04 m, and must be from 1e-09 to 1000 m'
    """
    if smallest >= SMALLEST and largest <= LARGEST:
        return ""
    return (
        f"diameters are {smallest:.3g} to {largest:.3g} m, and must be from {SMALLEST:g} to "
        f"{LARGEST:g} m"
    )
