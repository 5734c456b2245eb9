"""Whether channels and densities are what they are declared to be, by their words and numbers."""

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from branchcrush.files.channel_edges import edges_of_channels, regular
from branchcrush.files.columns import Table
from branchcrush.files.declared import Declared
from branchcrush.files.rows import Row
from branchcrush.files.sieve_tables import sum_of
from branchcrush.gradings.tables import from_density, from_histogram

# How far the sum of percent may be from 100, and an integral from 1 or 100, of it.
_ROUNDED, _INEXACT = 1.0, 0.02


def _against_both(table, declared):
    """Return which keys the words above the columns speak against, of channels and densities."""
    words, against = table.words, []
    basis = {"volume": "mass"}.get(declared.basis, declared.basis)
    bases = words.bases()
    if bases and basis and basis not in bases:
        against.append(
            f'the words "{words.value}" say basis: {" or ".join(sorted(bases))}, not basis: '
            f"{declared.basis}"
        )
    if words.units() and declared.unit not in words.units():
        against.append(
            f'the words "{words.opening or words.title}" say unit: '
            f"{' or '.join(sorted(words.units()))}, not unit: {declared.unit}"
        )
    if words.openings() and "size" not in words.openings():
        against.append(
            f'the words "{words.opening or words.title}" say that sizes are '
            f"{' or '.join(sorted(words.openings()))}: give form: sieve with openings and values, "
            "or sizes"
        )
    return against


def against_density(table: Table, declared: Declared, rows: Sequence[Row]) -> list[str]:
    """Return why a table is no density as it is declared, with what else it can be.

    Parameters
    ----------
    table : Table
        With the words above the columns.
    declared : Declared
    rows : sequence of Row
        Size and density, by size.

    Returns
    -------
    list of str
        One line at most, with the D50 of each reading.

    Examples
    --------
    >>> rows = [Row(1, (1.0, 40.0)), Row(2, (2.0, 30.0)), Row(3, (4.0, 0.0))]
    >>> against_density(Table([], ["um", "dQ3/dlog x"]), Declared(unit="um"), rows)[0][:65]
    'the file and the keys disagree: the words "dQ3/dlog x" say per: l'
    """
    words, against = table.words, _against_both(table, declared)
    sizes = [row.values[0] for row in rows]
    values = [row.values[1] for row in rows]
    per, said = declared.taken("per"), words.per()
    if words.cumulative():
        against.append(
            f'the words "{words.value}" say a cumulative curve: give form: sieve with values: '
            "percent_finer or percent_coarser"
        )
    elif said and per not in said and not (per != "size" and said <= {"phi", "log_size"}):
        against.append(
            f'the words "{words.value or words.title}" say per: {" or ".join(sorted(said))}, not '
            f"per: {per}" + ("" if declared.per else ", the default")
        )
    if not against and declared.per is None and "size" not in said:
        against += _numbers_against_density(words, sizes, values)
    if not against:
        return []
    return [_density_readings(against, declared, words, sizes, values)]


def _numbers_against_density(words, sizes, values):
    many, geometric = len(sizes) >= 5, regular(sizes, "log")
    rising = all(high >= low for low, high in pairwise(values))
    if many and rising and values[-1] == 100:
        return ["the values grow to 100, as percent finer do (form: sieve)"]
    if len(sizes) >= 4 and abs(sum_of(values) - 100) <= _ROUNDED:
        return ["the values sum to 100, as percent in each channel do (form: histogram)"]
    if words.percent():
        return [f'the words "{words.value}" say percent, as of a channel (form: histogram)']
    if many and geometric and not _is_one(np.trapezoid(values, sizes)):
        logs = np.log(sizes)
        whole = np.trapezoid(values, logs)
        if _is_one(whole) or _is_one(whole / math.log(10)) or _is_one(whole / math.log(2)):
            return ["the density integrates to 1 over the logarithm of size, not over size"]
        if len(sizes) >= 8:
            return ["the sizes grow by a constant factor, as of a density per log_size"]
    return []


def _is_one(integral):
    return any(abs(integral / whole - 1) < _INEXACT for whole in (1.0, 100.0))


def _density_readings(against, declared, words, sizes, values):
    """Return the readings of a density, and of channels, with the D50 of each, in one line."""
    read = []
    for basis in _bases(declared, words):
        for per in ("size", "log_size"):
            median = from_density(sizes, values, _by(basis), per=per).mass_ppf(0.5)
            keys = declared.advice({"form": "density", "basis": basis, "per": per})
            read.append(f"`{keys}` D50 = {float(median):.3g} {declared.unit}")
    scale = "log" if regular(sizes, "log") else "linear"
    channels = replace(declared, scale=scale)
    rows = [Row(0, pair) for pair in zip(sizes, values, strict=True)]
    read += _histogram_readings(rows, channels, words, ("middles", "lower", "upper"))
    return _told(against, read, words, declared)


def _bases(declared, words):
    """Return what a file's values may count: what is declared, and what its words say."""
    own = declared.basis or "mass"
    return [own, *sorted(basis for basis in words.bases() if basis != _by(own))]


def _by(basis):
    return "number" if basis == "number" else "mass"


def _told(against, read, words, declared):
    """Return all that is known of a disagreement in one line."""
    others = sorted(words.units() - {declared.unit})
    if declared.unit not in words.units():
        units = {unit: declared.advice({"unit": unit}) for unit in others}
        read += [f"`{keys}` each D50 is as many {unit}" for unit, keys in units.items()]
    seen = f" Read as {'; as '.join(read)}." if read else ""
    typed = declared.typed is not None
    to_do = "Type the command that is" if typed else "Paste the keys that are"
    where = "" if typed else " into the grading"
    return (
        f"the file and the keys disagree: {'; '.join(against)}.{seen} {to_do} meant{where}, or "
        "correct the words in the file"
    )


def _histogram_readings(rows, declared, words, kinds):
    """Return how channels of these sizes would be read, with the D50 of each."""
    read = []
    for basis in _bases(declared, words):
        for kind in kinds:
            edges, shares, _, wrong = edges_of_channels(rows, replace(declared, sizes=kind))
            if not wrong:
                grading = from_histogram(edges, shares, _by(basis), scale=declared.taken("scale"))
                named = {"form": "histogram", "basis": basis, "sizes": kind}
                named |= {"scale": declared.scale} if declared.scale else {}
                keys = declared.advice(named)
                median = float(grading.mass_ppf(0.5))
                read.append(f"`{keys}` D50 = {median:.3g} {declared.unit}")
    return read


def against_histogram(table: Table, declared: Declared, rows: Sequence[Row]) -> list[str]:
    """Return why a table is no histogram as it is declared, with what else it can be.

    Parameters
    ----------
    table : Table
        With the words above the columns.
    declared : Declared
    rows : sequence of Row
        Size, or both edges, and value, by size.

    Returns
    -------
    list of str
        One line at most, with the D50 of each reading.

    Examples
    --------
    >>> rows = [Row(1, (1.0, 40.0)), Row(2, (2.0, 60.0))]
    >>> table = Table([], ["lower edge", "volume %"])
    >>> against_histogram(table, Declared(sizes="upper"), rows)[0][:64]
    'the file and the keys disagree: the words "lower edge" say sizes'
    """
    words, against = table.words, _against_both(table, declared)
    if words.cumulative():
        against.append(
            f'the words "{words.value}" say a cumulative curve: give form: sieve with values: '
            "percent_finer or percent_coarser"
        )
    if words.per():
        against.append(
            f'the words "{words.value or words.title}" say a density: give form: density with '
            f"per: {' or '.join(sorted(words.per()))}"
        )
    if words.sizes() and declared.sizes not in words.sizes():
        against.append(
            f'the words "{words.opening}" say sizes: {" or ".join(sorted(words.sizes()))}, not '
            f"sizes: {declared.sizes}"
        )
    values = [row.values[-1] for row in rows if row.values[-1] is not None]
    rising = all(high >= low for low, high in pairwise(values))
    falling = all(high <= low for low, high in pairwise(values))
    whole = max(values, default=0.0) == 100 and len(values) >= 4
    if not against and declared.basis != "number" and whole and (rising or falling):
        against.append(
            "the values go between 0 and 100 without turning, as percent finer or coarser do "
            "(form: sieve)"
        )
    if not against:
        return []
    kinds = [declared.sizes, *sorted(words.sizes() - {declared.sizes})]
    if len(rows[0].values) == 2 and None not in values:
        scale = declared.scale or (
            "log" if regular([row.values[0] for row in rows], "log") else None
        )
        declared = replace(declared, scale=scale)
    return [_told(against, _histogram_readings(rows, declared, words, kinds), words, declared)]
