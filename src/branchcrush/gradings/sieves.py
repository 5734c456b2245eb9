"""Openings of sieves by the names that standards give them, and the phi scale of sediments."""

from branchcrush.errors import GradingError

# Nominal openings by number [mm]: ASTM E11-20, Table 1, whose openings are those of ISO 3310-1
# (the series R 40/3 of ISO 565, and sieves between them).
ASTM_E11_NUMBERS = {
    3.5: 5.6, 4: 4.75, 5: 4.0, 6: 3.35, 7: 2.8, 8: 2.36, 10: 2.0, 12: 1.7, 14: 1.4, 16: 1.18,
    18: 1.0, 20: 0.85, 25: 0.71, 30: 0.6, 35: 0.5, 40: 0.425, 45: 0.355, 50: 0.3, 60: 0.25,
    70: 0.212, 80: 0.18, 100: 0.15, 120: 0.125, 140: 0.106, 170: 0.09, 200: 0.075, 230: 0.063,
    270: 0.053, 325: 0.045, 400: 0.038, 450: 0.032, 500: 0.025, 635: 0.02,
}  # fmt: skip
# By inches [mm]: the same table.
ASTM_E11_INCHES = {
    5: 125.0, 4.24: 106.0, 4: 100.0, 3.5: 90.0, 3: 75.0, 2.5: 63.0, 2.12: 53.0, 2: 50.0,
    1.75: 45.0, 1.5: 37.5, 1.25: 31.5, 1.06: 26.5, 1: 25.0, 0.875: 22.4, 0.75: 19.0, 0.625: 16.0,
    0.53: 13.2, 0.5: 12.5, 0.4375: 11.2, 0.375: 9.5, 0.3125: 8.0, 0.265: 6.7, 0.25: 6.3,
}  # fmt: skip
# The Tyler standard screen scale by meshes per inch [mm], as ASTM E11's openings stand for it
# (W. S. Tyler, sieve specifications; Perry's Chemical Engineers' Handbook, 7th ed., Table 19-6).
TYLER_MESHES = {
    2.5: 8.0, 3: 6.7, 3.5: 5.6, 4: 4.75, 5: 4.0, 6: 3.35, 7: 2.8, 8: 2.36, 9: 2.0, 10: 1.7,
    12: 1.4, 14: 1.18, 16: 1.0, 20: 0.85, 24: 0.71, 28: 0.6, 32: 0.5, 35: 0.425, 42: 0.355,
    48: 0.3, 60: 0.25, 65: 0.212, 80: 0.18, 100: 0.15, 115: 0.125, 150: 0.106, 170: 0.09,
    200: 0.075, 250: 0.063, 270: 0.053, 325: 0.045, 400: 0.038, 450: 0.032, 500: 0.025,
    635: 0.02,
}  # fmt: skip
TYLER_INCHES = {
    1.05: 26.5,
    0.883: 22.4,
    0.742: 19.0,
    0.624: 16.0,
    0.525: 13.2,
    0.441: 11.2,
    0.371: 9.5,
}
_SERIES = {
    "astm_e11": ("ASTM E11", ASTM_E11_NUMBERS, ASTM_E11_INCHES),
    "tyler_mesh": ("Tyler's scale", TYLER_MESHES, TYLER_INCHES),
}
# R 20 and R 10 of ISO 565 [mm], the decade from 1; others are 10, 100, ... times as large.
_R_20 = (
    1,
    1.12,
    1.25,
    1.4,
    1.6,
    1.8,
    2,
    2.24,
    2.5,
    2.8,
    3.15,
    3.55,
    4,
    4.5,
    5,
    5.6,
    6.3,
    7.1,
    8,
    9,
)
# No grain is larger or smaller than these two by far: 16 m and 0.06 um.
PHI_RANGE = (-14.0, 24.0)


def opening_of(name: float, series: str, inches: bool = False) -> float:
    r"""Return the nominal opening of a sieve of a standard.

    Parameters
    ----------
    name : float
        Number or meshes per inch, or the opening in inches that the sieve is called by.
    series : {"astm_e11", "tyler_mesh"}
    inches : bool
        Whether it is called by inches. A name below every number is one of inches anyhow.

    Returns
    -------
    float
        [mm]

    Raises
    ------
    GradingError
        When the series has no such sieve.

    Examples
    --------
    >>> opening_of(40, "astm_e11"), opening_of(3 / 8, "astm_e11"), opening_of(28, "tyler_mesh")
    (0.425, 9.5, 0.6)
    """
    title, numbers, by_inches = _SERIES[series]
    known = by_inches if inches or name < min(numbers) else numbers
    if name not in known:
        near = sorted(known, key=lambda other: abs(other - name))[:2]
        kind = "in" if known is by_inches else "number"
        raise GradingError(
            f"{title} has no sieve of {kind} {name:g}; the nearest are "
            f"{' and '.join(f'{other:g}' for other in near)}"
        )
    return known[name]


def size_of_phi(phi: float) -> float:
    r"""Return the diameter at a place on the phi scale.

    .. math:: d = 2^{-\phi}\ \mathrm{mm}

    Parameters
    ----------
    phi : float
        [-]

    Returns
    -------
    float
        [mm]

    Raises
    ------
    GradingError
        When it is beyond any grain.

    Examples
    --------
    >>> size_of_phi(-1.0), size_of_phi(2.0)
    (2.0, 0.25)

    References
    ----------
    Krumbein (1934), J. Sediment. Petrol. 4, 65-77.
    """
    low, high = PHI_RANGE
    if not low <= phi <= high:
        raise GradingError(f"phi = {phi:g} is no grain's; it must be from {low:g} to {high:g}")
    return 2.0**-phi


def is_nominal(opening: float) -> bool:
    """Return whether sieves of an opening are made, by ASTM E11, ISO 3310 or ISO 565.

    Parameters
    ----------
    opening : float
        [mm]

    Returns
    -------
    bool

    Examples
    --------
    >>> is_nominal(0.425), is_nominal(1.5)
    (True, False)
    """
    known = {*ASTM_E11_NUMBERS.values(), *ASTM_E11_INCHES.values(), 16.0, 32.0, 64.0}
    known |= {first * 10.0**power for first in _R_20 for power in range(-3, 3)}
    return any(abs(opening - other) < 1e-6 * other for other in known)
