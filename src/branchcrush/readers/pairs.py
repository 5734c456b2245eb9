"""Contacts that a file lists once or twice: each of them once."""

import numpy as np
from numpy.typing import NDArray

from branchcrush.readers.roles import Grains

# Relative difference up to which two forces, or two branch vectors, are the same contact's.
_SAME_FORCE, _SAME_PLACE = 1e-3, 1e-2


def each_once(
    grains: Grains,
    i: NDArray,
    j: NDArray,
    vector: NDArray,
    normal: NDArray,
    each_pair: str,
    smaller: NDArray,
) -> tuple[NDArray, NDArray, list[str]]:
    """Return which contacts are kept so that each is there once, and which have to be turned.

    Parameters
    ----------
    grains : Grains
    i, j : ndarray of int, shape (M,)
        Its grains, from 0.
    vector : ndarray, shape (M, 3)
        From i to j [m].
    normal : ndarray, shape (M,)
        Normal force [N].
    each_pair : {"once", "twice"}
        How the file lists them.
    smaller : ndarray, shape (M,)
        Smaller radius of each [m].

    Returns
    -------
    kept : ndarray of int
        Rows.
    turned : ndarray of bool, shape (M,)
        Where i comes after j.
    problems : list of str
        Pairs that are there another number of times.

    Examples
    --------
    >>> grains = Grains(np.array([5, 6]), np.zeros((2, 3)), np.ones(2))
    >>> vector = np.array([[1.0, 0, 0], [-1.0, 0, 0]])
    >>> kept, turned, problems = each_once(
    ...     grains, np.array([0, 1]), np.array([1, 0]), vector, np.ones(2), "twice", np.ones(2))
    >>> kept.tolist(), turned.tolist(), problems
    ([0], [False, True], [])
    """
    turned = i > j
    low, high = np.minimum(i, j), np.maximum(i, j)
    along = np.where(turned[:, None], -vector, vector)
    pair = low * grains.ids.size + high
    # Of one pair those through the same face come together.
    place = np.round(along / (_SAME_PLACE * smaller[:, None]) / 10.0)
    order = np.lexsort((*place.T[::-1], pair))
    problems = []
    selfish = np.flatnonzero(i == j)
    if selfish.size:
        problems.append(
            f"{selfish.size} contacts join a grain with itself, such as "
            f"{grains.ids[i[selfish[0]]]}: are the two columns of ids the right ones?"
        )
    again = np.zeros(pair.size, dtype=bool)
    near = np.linalg.norm(np.diff(along[order], axis=0), axis=1) < _SAME_PLACE * smaller[order[1:]]
    again[1:] = (np.diff(pair[order]) == 0) & near
    times = np.diff(np.append(np.flatnonzero(~again), again.size))
    firsts = order[~again]
    due = 2 if each_pair == "twice" else 1
    wrong = firsts[times != due]
    if wrong.size:
        problems.append(_words(grains, low, high, wrong, times, due, firsts.size))
    elif due == 2:
        seconds = order[again]
        differ = np.abs(normal[firsts] - normal[seconds]) > _SAME_FORCE * normal.max(initial=0.0)
        if differ.any():
            one = firsts[np.argmax(differ)]
            problems.append(
                f"{int(differ.sum())} pairs stand twice with two forces, such as "
                f"{grains.ids[low[one]]} and {grains.ids[high[one]]}: is the file of one moment?"
            )
    return np.sort(firsts), turned, problems


def _words(grains, low, high, wrong, times, due, pairs):
    """Return what is wrong with how often pairs stand in a file."""
    one = wrong[0]
    example = f"such as {grains.ids[low[one]]} and {grains.ids[high[one]]}"
    if due == 1:
        every = wrong.size == pairs and np.all(times == 2)
        advice = (
            "all of them: say packing.each_pair: twice"
            if every
            else f"{example}: remove the second, or if the code lists each pair in both directions "
            "say packing.each_pair: twice"
        )
        return f"{wrong.size} of {pairs} contacts stand more than once, {advice}"
    if np.all(times == 1):
        return f"no contact of {pairs} stands twice: say packing.each_pair: once"
    return (
        f"{wrong.size} of {pairs} contacts do not stand exactly twice, {example}: does the file "
        "break off? write it again, whole"
    )
