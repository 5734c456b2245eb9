"""How LAMMPS searches for neighbours, chosen from the radii.

Three things cost time: each pair in a list is looked at in every force evaluation, lists are made
anew when a grain has moved half a skin, and making them compares each grain with all in the cells
around it. With one grid of cells (style `bin`) these are cells for the largest grains, in which a
small one meets hundreds of others. A grid for each collection of similar sizes (style `multi`)
avoids that, but a grid with more cells than grains is slow to search. `benchmarks/neighbours.py`
measures the choice against others.
"""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

# Of the mean diameter. The list of a grain then holds about twice its contacts.
_SKIN = 0.3
# Grains, of all sizes, in a cube as large as the largest grain, from which collections pay.
_CROWDED = 50.0
# Largest over smallest diameter in a collection, about.
_SIMILAR = 2.7
# Neighbours that a list may hold of one grain, beside one for every grain there is.
_MORE_NEIGHBOURS = 2000


def neighbour_settings(radii: ArrayLike, edge: float) -> dict[str, Any]:
    """Return the variables of `in.compress` that say how neighbours are found.

    Parameters
    ----------
    radii : array_like, shape (N,)
        [m]
    edge : float
        Of the cell where the grains begin to carry load [m].

    Returns
    -------
    dict
        skin [m], neighbour_style ("bin" or "multi"), collections (how many, and the largest
        diameter of each [m], as text; "none" with bin) and neighbours (of one grain at most).

    Examples
    --------
    >>> neighbour_settings([1.0] * 100, 9.0)
    {'skin': 0.6, 'neighbour_style': 'bin', 'collections': 'none', 'neighbours': 2100}
    >>> neighbour_settings([1.0] * 990 + [10.0] * 10, 37.0)["neighbour_style"]
    'multi'
    """
    diameters = 2.0 * np.asarray(radii, dtype=float)
    skin = _SKIN * float(diameters.mean())
    largest = diameters.max() + skin
    bounds = []
    if diameters.size / edge**3 * largest**3 > _CROWDED:
        bounds = _collections(diameters, edge, skin)
    return {
        "skin": skin,
        "neighbour_style": "multi" if bounds else "bin",
        "collections": " ".join(map(repr, [len(bounds), *bounds])) if bounds else "none",
        "neighbours": diameters.size + _MORE_NEIGHBOURS,
    }


def _collections(diameters, edge, skin):
    """Return the largest diameter of each collection [m]."""
    # A cell is half as wide as the collection's largest diameter and the skin, and no narrower
    # than half the mean distance of grains.
    spacing = edge / np.cbrt(diameters.size)
    finest = max(_SIMILAR * diameters.min(), spacing - skin)
    # Rounding must leave no grain above the last bound.
    last = float(diameters.max()) * (1.0 + 1e-9)
    number = max(1, 1 + round(np.log(last / finest) / np.log(_SIMILAR)))
    return [float(bound) for bound in np.geomspace(finest, last, number)] if number > 1 else []
