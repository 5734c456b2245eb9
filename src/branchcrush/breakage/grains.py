"""All the grains there are while a packing is crushed, by rising number, and whence they come."""

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.breakage.fragments import Fragments, broken
from branchcrush.breakage.rules import Breakage
from branchcrush.breakage.strength import rotation_stream, weibull_factor


@dataclass(frozen=True, eq=False)
class Grains:
    """The grains of a packing, whole ones and fragments; a number is never given twice."""

    number: NDArray  # from 0, rising, shape (N,)
    radius: NDArray  # with all its mass [m]
    strength: NDArray  # [Pa]
    parent: NDArray  # number of the grain it is a fragment of, -1 of one of the first packing
    # The grain of the first packing that each comes from, then which fragment of it, and so on.
    descent: list[tuple[int, ...]] = field(repr=False)
    next_number: int

    @property
    def generation(self) -> NDArray:
        """How many times what each grain comes from has broken: 0 of the first packing."""
        return np.array([len(line) - 1 for line in self.descent])

    def rows(self, numbers: ArrayLike) -> NDArray:
        """Return where the grains of some numbers are.

        Parameters
        ----------
        numbers : array_like of int, shape (n,)

        Returns
        -------
        ndarray of int, shape (n,)

        Raises
        ------
        KeyError
            When there is no grain of a number.
        """
        rows = np.searchsorted(self.number, numbers)
        if np.any(rows >= self.number.size) or np.any(self.number[rows] != numbers):
            raise KeyError("there is no grain of this number")
        return rows


def first_grains(radii: ArrayLike, seed: int, rules: Breakage) -> Grains:
    """Return the grains of a first packing, each with a strength of its own.

    Parameters
    ----------
    radii : array_like, shape (N,)
        [m]
    seed : int
        Of the packing.
    rules : Breakage

    Returns
    -------
    Grains

    Examples
    --------
    >>> from branchcrush.breakage.strength import Strength
    >>> glass = Strength(strength=2e7, weibull_modulus=3.0, reference_diameter=1e-3,
    ...                  size_exponent=1.0)
    >>> grains = first_grains([1e-3, 2e-3], 1, Breakage(strength=glass, smallest_diameter=1e-3))
    >>> grains.number.tolist(), grains.generation.tolist(), grains.next_number
    ([0, 1], [0, 0], 2)
    """
    radius = np.array(radii, dtype=float)
    number = np.arange(radius.size)
    descent: list[tuple[int, ...]] = [(int(n),) for n in number]
    return Grains(
        number,
        radius,
        _strengths(radius, descent, seed, rules),
        np.full(radius.size, -1),
        descent,
        int(radius.size),
    )


@dataclass(frozen=True, eq=False)
class Exchange:
    """Grains that break in one round, and what is put in their place."""

    gone: NDArray  # numbers of the grains that broke, rising
    number: NDArray  # of the fragments, grain after grain
    position: NDArray  # of the fragments, shape (n, 3) [m]
    touching_radius: NDArray  # of the fragments as they are put in [m]


def exchange(
    grains: Grains, breaking: Iterable[int], position: NDArray, seed: int, rules: Breakage
) -> tuple[Grains, Exchange]:
    """Return the grains after some have broken, and which have come for which.

    Parameters
    ----------
    grains : Grains
    breaking : iterable of int
        Numbers of the grains that break, rising.
    position : ndarray, shape (N, 3)
        Of all the grains before [m].
    seed : int
        Of the packing.
    rules : Breakage

    Returns
    -------
    grains : Grains
    exchange : Exchange
    """
    gone = np.array(list(breaking), dtype=int)
    rows = grains.rows(gone)
    pieces: list[Fragments] = [
        broken(
            position[row],
            float(grains.radius[row]),
            rules.fragments,
            rotation_stream(seed, grains.descent[row]),
        )
        for row in rows
    ]
    descent = [(*grains.descent[row], n) for row in rows for n in range(rules.fragments)]
    number = np.arange(grains.next_number, grains.next_number + len(descent))
    full = np.concatenate([piece.full_radius for piece in pieces])
    kept = np.ones(grains.number.size, dtype=bool)
    kept[rows] = False
    after = replace(
        grains,
        number=np.concatenate([grains.number[kept], number]),
        radius=np.concatenate([grains.radius[kept], full]),
        strength=np.concatenate([grains.strength[kept], _strengths(full, descent, seed, rules)]),
        parent=np.concatenate([grains.parent[kept], np.repeat(gone, rules.fragments)]),
        descent=[line for line, stays in zip(grains.descent, kept, strict=True) if stays] + descent,
        next_number=grains.next_number + len(descent),
    )
    return after, Exchange(
        gone,
        number,
        np.concatenate([piece.position for piece in pieces]),
        np.concatenate([piece.radius for piece in pieces]),
    )


def _strengths(
    radius: NDArray, descent: list[tuple[int, ...]], seed: int, rules: Breakage
) -> NDArray:
    law = rules.strength
    factors = [weibull_factor(seed, line, law.weibull_modulus) for line in descent]
    return law.of(2.0 * radius, np.array(factors))
