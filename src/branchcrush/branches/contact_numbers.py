"""Who touches whom, measured: contact numbers by radius, and the two radii of a contact."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.packings.network import Network
from branchcrush.statistics.bins import bin_numbers
from branchcrush.statistics.intervals import Interval
from branchcrush.statistics.resampling import pooled_interval

_CLASSES = 10


class ContactSums(NamedTuple):
    """What one seed in one state adds to the contact statistics of a sample."""

    grains: NDArray  # in each class of radius, shape (K,)
    radii: NDArray  # sum of their radii [m]
    contacts: NDArray  # sum of their contacts with other grains
    bearing: NDArray  # grains that are no rattlers
    bearing_contacts: NDArray  # and the sum of their contacts
    pairs: NDArray  # contacts of each class with each, every contact twice, shape (K, K)
    moments: NDArray  # of the two ends of a contact, of R and of ln R, shape (2, 4)


def radius_classes(radii: ArrayLike, contacts: ArrayLike, classes: int = _CLASSES) -> NDArray:
    """Return the edges of classes of radius that hold as many grains as contacts' ends each.

    By number alone all that carries load would be in one class where most grains are fines.

    Parameters
    ----------
    radii : array_like, shape (N,)
        Of the grains of all seeds [m].
    contacts : array_like, shape (N,)
        Contacts of each.
    classes : int
        At most; a grading of few single sizes has one for each.

    Returns
    -------
    ndarray, shape (K+1,)
        [m]

    Examples
    --------
    >>> radius_classes([1.0, 1.0, 4.0], [1, 1, 2]).tolist()
    [1.0, 2.0, 4.0]
    """
    radius, ends = np.asarray(radii, dtype=float), np.asarray(contacts, dtype=float)
    values = np.unique(radius)
    if values.size <= classes:
        inner = np.sqrt(values[:-1] * values[1:])
    else:
        order = np.argsort(radius, kind="stable")
        weight = np.cumsum(1.0 / radius.size + ends[order] / max(ends.sum(), 1.0))
        levels = np.arange(1, classes) / classes * weight[-1]
        inner = np.unique(radius[order][np.searchsorted(weight, levels)])
        inner = inner[(inner > values[0]) & (inner < values[-1])]
    return np.concatenate([values[:1], inner, values[-1:]])


def contact_sums(network: Network, edges: ArrayLike) -> ContactSums:
    """Return what one seed adds to the contact statistics.

    Parameters
    ----------
    network : Network
    edges : array_like, shape (K+1,)
        Edges of the classes of radius [m].

    Returns
    -------
    ContactSums

    Examples
    --------
    >>> nothing = np.zeros(0)
    >>> network = Network(np.array([1.0, 3.0]), np.array([0]), np.array([1]), *3 * (nothing,),
    ...                   np.zeros(0, dtype=int), nothing, nothing)
    >>> sums = contact_sums(network, [1.0, 2.0, 3.0])
    >>> sums.contacts.tolist(), sums.pairs.tolist()
    ([1.0, 1.0], [[0, 1], [1, 0]])
    """
    ends = np.asarray(edges, dtype=float)
    classes = ends.size - 1
    group = bin_numbers(network.radius, ends)
    contacts, bearing = network.contacts, network.bearing
    grains, radii, touching, held, held_touching = (
        np.bincount(group, weights, minlength=classes)
        for weights in (None, network.radius, contacts, bearing, bearing * contacts)
    )
    cell = group[network.i] * classes + group[network.j]
    pairs = np.bincount(cell, minlength=classes**2).reshape(classes, classes)
    # Scaled: cubes and squares of metres would be lost beside counts.
    first, second = network.radius_i / ends[-1], network.radius_j / ends[-1]
    moments = [_end_moments(first, second), _end_moments(np.log(first), np.log(second))]
    return ContactSums(
        grains, radii, touching, held, held_touching, pairs + pairs.T, np.array(moments)
    )


def _end_moments(first: NDArray, second: NDArray) -> list[float]:
    """Return the sums over contacts, each taken in both orders, of 1, x, x^2 and x y."""
    return [
        2.0 * first.size,
        first.sum() + second.sum(),
        first @ first + second @ second,
        2.0 * (first @ second),
    ]


def assortativity(
    sums: Sequence[ContactSums],
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> Interval:
    r"""Return how alike the two radii of a contact are: their correlation over contacts.

    .. math:: a = \frac{\langle x y\rangle - \langle x\rangle^2}
        {\langle x^2\rangle - \langle x\rangle^2}

    Each contact counts in both orders. 0 says that grains choose their neighbours by contact
    number alone; less than 0, that large grains touch small ones more often than that.

    Parameters
    ----------
    sums : list of ContactSums
        Of each seed.
    confidence, resamples, rng
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    Interval
        Arrays of two: of the radii, and of their logarithms; nan where all radii are equal.

    Examples
    --------
    >>> unused = 5 * (np.zeros(2),)
    >>> ends = [4.0, 6.0, 10.0, 10.0]  # two contacts: 1 touches 1, 2 touches 2
    >>> seed = ContactSums(*unused, pairs=np.zeros((2, 2)), moments=np.array([ends, ends]))
    >>> assortativity([seed], rng=None).estimate.tolist()
    [1.0, 1.0]

    References
    ----------
    Newman (2003), Phys. Rev. E 67, 026126.
    """

    def correlation(moments: NDArray) -> NDArray:
        number, first, square, product = np.moveaxis(moments, -1, 0)
        with np.errstate(invalid="ignore", divide="ignore"):
            mean = first / number
            spread = square / number - mean**2
            return np.where(spread > 1e-12, (product / number - mean**2) / spread, np.nan)

    return pooled_interval(
        [seed.moments for seed in sums],
        correlation,
        confidence=confidence,
        resamples=resamples,
        rng=rng,
    )


def contact_number_table(
    sums: Sequence[ContactSums],
    edges: ArrayLike,
    *,
    confidence: float = 0.95,
    resamples: int = 2000,
    rng: np.random.Generator,
) -> dict[str, NDArray]:
    r"""Return the contact number by radius, with and without rattlers, with intervals.

    .. math:: c(R) = \frac{\sum_g z_g}{N(R)}, \qquad c^*(R) = \frac{\sum_{g \notin r} z_g}{N^*(R)}

    Parameters
    ----------
    sums : list of ContactSums
        Of each seed.
    edges : array_like, shape (K+1,)
        Edges of the classes [m].
    confidence, resamples, rng
        As for `statistics.resampling.pooled_interval`.

    Returns
    -------
    dict of ndarray, shape (K,)
        radius_low_m, radius_high_m, mean_radius_m, grains; contact_number,
        load_bearing_contact_number and rattler_fraction, each with _low and _high.

    Examples
    --------
    >>> sums = (np.array([4]), np.array([4.0]), np.array([12]), np.array([2]), np.array([11]))
    >>> seed = ContactSums(*sums, pairs=np.array([[12]]), moments=np.zeros((2, 4)))
    >>> table = contact_number_table([seed], [1.0, 1.0], rng=None)
    >>> [table[name].tolist() for name in ("contact_number", "load_bearing_contact_number")]
    [[3.0], [5.5]]
    """
    names = ("contact_number", "load_bearing_contact_number", "rattler_fraction")

    def ratios(totals: NDArray) -> NDArray:
        grains, contacts, bearing, bearing_contacts = np.moveaxis(totals, 1, 0)
        with np.errstate(invalid="ignore", divide="ignore"):
            parts = contacts / grains, bearing_contacts / bearing, 1.0 - bearing / grains
        return np.stack(parts, axis=1)

    totals = [(s.grains, s.contacts, s.bearing, s.bearing_contacts) for s in sums]
    limits = pooled_interval(totals, ratios, confidence=confidence, resamples=resamples, rng=rng)
    grains = np.sum([seed.grains for seed in sums], axis=0)
    with np.errstate(invalid="ignore"):
        mean_radius = np.sum([seed.radii for seed in sums], axis=0) / grains
    ends = np.asarray(edges)
    table = {
        "radius_low_m": ends[:-1],
        "radius_high_m": ends[1:],
        "mean_radius_m": mean_radius,
        "grains": grains.astype(int),
    }
    for row, name in enumerate(names):
        table |= limits.part(row).named(name)
    return table


def pair_table(sums: Sequence[ContactSums], edges: ArrayLike) -> dict[str, NDArray]:
    r"""Return how often classes of radius touch, over what contact numbers alone would give.

    .. math:: \frac{M_{ab}}{M_a M_b / M}

    M_ab counts the contacts of class a with class b, each contact in both orders; M_a is their sum
    over b, and M over both.

    Parameters
    ----------
    sums : list of ContactSums
        Of each seed.
    edges : array_like, shape (K+1,)
        [m]

    Returns
    -------
    dict of ndarray, shape (K^2,)
        radius_i_low_m, radius_i_high_m, radius_j_low_m, radius_j_high_m, contacts (in both
        orders), expected_contacts, ratio (nan where nothing is expected).

    Examples
    --------
    >>> unused = 5 * (np.zeros(2),)
    >>> seed = ContactSums(*unused, pairs=np.array([[6, 2], [2, 6]]), moments=np.zeros((2, 4)))
    >>> pair_table([seed], [1.0, 2.0, 3.0])["ratio"].tolist()
    [1.5, 0.5, 0.5, 1.5]
    """
    pairs = np.sum([seed.pairs for seed in sums], axis=0).astype(float)
    of_class = pairs.sum(axis=1)
    expected = np.outer(of_class, of_class) / max(pairs.sum(), 1.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = pairs / expected
    ends = np.asarray(edges)
    classes = np.arange(ends.size - 1)
    first, second = (grid.ravel() for grid in np.meshgrid(classes, classes, indexing="ij"))
    return {
        "radius_i_low_m": ends[first],
        "radius_i_high_m": ends[first + 1],
        "radius_j_low_m": ends[second],
        "radius_j_high_m": ends[second + 1],
        "contacts": pairs.ravel().astype(int),
        "expected_contacts": expected.ravel(),
        "ratio": ratio.ravel(),
    }
