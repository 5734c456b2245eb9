"""What breakage will make of a sample, in words for a person."""

from branchcrush.study.preview_breakage import Breaking, three_digits


def strength_words(found: Breaking, unit: str, metres: float) -> str:
    """Return how strong grains are, and how fine they may become, as a sentence for a person.

    Parameters
    ----------
    found : Breaking
    unit : str
        That the user gives sizes in.
    metres : float
        What it is [m].

    Returns
    -------
    str

    Examples
    --------
    >>> from branchcrush.breakage.rules import Breakage
    >>> from branchcrush.breakage.strength import Strength
    >>> sand = Strength(strength=2e7, weibull_modulus=3.0, reference_diameter=1e-3,
    ...                 size_exponent=1.0)
    >>> found = Breaking(Breakage(strength=sand, smallest_diameter=2.5e-4), ((1e-3, 2e7),) * 3,
    ...                  0.04, 0.015, 4812, 0.73, None, 2e5, 80.0, [])
    >>> strength_words(found, "mm", 1e-3)[-79:]
    'or finer breaks, and the finest fragment there can be has 0.0665 mm of diameter'
    """
    names = ("smallest", "median by mass", "largest")
    told = [
        f"{_pascals(strength)} of the {name} ({three_digits(diameter / metres)} {unit})"
        for name, (diameter, strength) in zip(names, found.strengths, strict=True)
    ]
    sizes = found.rules.smallest_diameter, found.rules.finest_diameter
    limit, finest = (f"{three_digits(size / metres)} {unit}" for size in sizes)
    return (
        f"strength that 37 % survive {', '.join(told)}; no grain of {limit} or finer breaks, and "
        f"the finest fragment there can be has {finest} of diameter"
    )


def grains_words(found: Breaking, *, periodic: bool) -> str:
    """Return how many grains there will be as a sentence for a person.

    Parameters
    ----------
    found : Breaking
    periodic : bool
        Whether the cell is one without walls.

    Returns
    -------
    str
    """
    most = found.rules.largest_grains
    number = f"{found.grains:,}".replace(",", " ") if found.grains >= most else _about(found.grains)
    more = "at least " if found.densest is not None else ""
    walls = "" if periodic else " less a layer at each wall"
    stress = found.rules.largest_mean_stress
    before = "" if stress is None else "; fewer where largest_mean_stress ends the run before"
    return (
        f"{more}about {number} at a solid fraction of {found.solid_fraction:.3f}, half or twice as "
        "many (an estimate: so many are in the grading that jams there by the rod map"
        f"{walls}, at an elastic strain of {100.0 * found.elastic_strain:.2g} %, if of the grains "
        f"above the limit an equal share of every size has broken){before}"
    )


def _about(number: int) -> str:
    """Return a number to two digits."""
    return f"{float(f'{number:.2g}'):,.0f}".replace(",", " ")


def _pascals(stress: float) -> str:
    """Return a stress in a unit that suits it."""
    for scale, unit in ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa")):
        if stress >= scale:
            return f"{stress / scale:.3g} {unit}"
    return f"{stress:.3g} Pa"
