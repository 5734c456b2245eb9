"""Where channels begin and end, from the one size of each that a file has."""

import math
from collections.abc import Sequence
from itertools import pairwise

from branchcrush.files.declared import Declared
from branchcrush.files.rows import Row

# How far sizes of even channels may be from where the series has them [of a channel]. Exports
# round small sizes to two digits.
_ROUNDED = 0.15


def regular(sizes: Sequence[float], scale: str) -> bool:
    """Return whether sizes grow by one factor, or by one step.

    Parameters
    ----------
    sizes : sequence of float
        Increasing.
    scale : {"log", "linear"}

    Returns
    -------
    bool

    Examples
    --------
    >>> regular([1.0, 2.0, 4.0], "log"), regular([1.0, 2.0, 4.0], "linear")
    (True, False)
    """
    places = [math.log(size) for size in sizes] if scale == "log" else list(sizes)
    if len(places) < 3:
        return False
    step = (places[-1] - places[0]) / (len(places) - 1)
    return all(
        abs(place - places[0] - number * step) <= _ROUNDED * step
        for number, place in enumerate(places)
    )


def edges_of_channels(
    rows: Sequence[Row], declared: Declared
) -> tuple[list[float], list[float], list[str], list[str]]:
    """Return the edges of channels, what each holds, remarks, and what is wrong.

    Parameters
    ----------
    rows : sequence of Row
        By size: one size, or the lower and the upper edge, and the value.
    declared : Declared
        With sizes, scale and unit, and the smallest and largest grain if they are given.

    Returns
    -------
    edges, values : list of float
    remarks, problems : list of str

    Examples
    --------
    >>> rows = [Row(1, (10.0, 20.0)), Row(2, (20.0, 50.0)), Row(3, (30.0, 30.0))]
    >>> edges_of_channels(rows, Declared(sizes="middles", scale="linear"))[0]
    [5.0, 15.0, 25.0, 35.0]
    """
    if declared.sizes == "edges":
        read = _between_pairs if len(rows[0].values) == 3 else _between_edges
        return read(rows)
    sizes, values = [row.values[0] for row in rows], [row.values[-1] for row in rows]
    if len(rows) < 2:
        wrong = f"line {rows[0].line}: one channel; give its two edges (sizes: edges)"
        return [], [], [], [wrong]
    if declared.sizes == "middles":
        return _around_middles(rows, sizes, values, declared)
    return _beside(rows, sizes, values, declared)


def _between_pairs(rows):
    """Return the edges of channels that have both, one above the other."""
    problems = [
        f"line {row.line}: the lower edge {row.values[0]:g} must be below the upper "
        f"{row.values[1]:g}: correct one"
        for row in rows
        if not row.values[0] < row.values[1]
    ]
    problems += [
        f"line {high.line}: the channel from {high.values[0]:g} begins inside that of line "
        f"{low.line}, which ends at {low.values[1]:g}: correct one"
        for low, high in pairwise(rows)
        if high.values[0] < low.values[1] * (1 - 1e-9)
    ]
    if problems:
        return [], [], [], problems
    edges, values = [rows[0].values[0]], []
    for lower, upper, value in (row.values for row in rows):
        if lower > edges[-1] * (1 + 1e-9):
            edges.append(lower)
            values.append(0.0)
        edges.append(upper)
        values.append(value)
    return edges, values, [], []


def _between_edges(rows):
    """Return the channels between successive edges, one of which has no value."""
    unfilled = [place for place, row in enumerate(rows) if row.values[1] is None]
    sizes, values = [row.values[0] for row in rows], [row.values[1] for row in rows]
    if unfilled == [len(rows) - 1]:
        return sizes, values[:-1], ["values lie between their size and the next larger"], []
    if unfilled == [0]:
        return sizes, values[1:], ["values lie between their size and the next smaller"], []
    problem = (
        f"line {rows[0].line}: sizes: edges needs both edges of each channel (columns: [lower, "
        "upper, value], or cells like 10-20), or one edge more than values, its value left empty; "
        "with one size a channel say sizes: lower, upper or middles"
    )
    return [], [], [], [problem]


def _around_middles(rows, sizes, values, declared):
    """Return the edges half a channel beside each middle."""
    scale = declared.scale or ""
    other = "linear" if scale == "log" else "log"
    if len(sizes) > 2 and not regular(sizes, scale):
        hint = f"; they do by scale: {other}" if regular(sizes, other) else ""
        how = "one factor" if scale == "log" else "one step"
        problem = (
            f"line {rows[0].line}: these middles do not grow by {how}, as those of scale: {scale} "
            f"do{hint}; where channels meet does not follow from them: give their edges (sizes: "
            "lower, upper or edges)"
        )
        return [], [], [], [problem]
    if scale == "log":
        inner = [math.sqrt(low * high) for low, high in pairwise(sizes)]
        edges = [sizes[0] ** 2 / inner[0], *inner, sizes[-1] ** 2 / inner[-1]]
    else:
        inner = [(low + high) / 2 for low, high in pairwise(sizes)]
        edges = [2 * sizes[0] - inner[0], *inner, 2 * sizes[-1] - inner[-1]]
    return _above_zero(edges, values, rows, declared)


def _beside(rows, sizes, values, declared):
    """Return the edges of channels whose lower or upper ones are given."""
    lower = declared.sizes == "lower"
    place = -1 if lower else 0
    if not values[place]:
        # Nothing lies there, wherever its other edge is.
        return sizes, values[:-1] if lower else values[1:], [], []
    scale = declared.scale or next((each for each in ("log", "linear") if regular(sizes, each)), "")
    given = declared.largest if lower else declared.smallest
    outside = given is not None and (given > sizes[-1] if lower else given < sizes[0])
    first, second = (sizes[-1], sizes[-2]) if lower else (sizes[0], sizes[1])
    if scale:
        edge = first**2 / second if scale == "log" else 2 * first - second
    elif outside:
        edge = given
    else:
        key, what = ("max", "largest") if lower else ("min", "smallest")
        return (
            [],
            [],
            [],
            [
                f"line {rows[place].line}: the channel at {first:g} {declared.unit} holds "
                f"{values[place]:g}, and its {'upper' if lower else 'lower'} edge is not in the "
                f"file: give the {what} grain ({key}), or scale: log or linear, if channels go on "
                "as they are"
            ],
        )
    edges = [*sizes, edge] if lower else [edge, *sizes]
    return _above_zero(edges, values, rows, declared)


def _above_zero(edges, values, rows, declared):
    """Return the channels, the first of which must begin above 0."""
    if edges[0] <= edges[1] * 1e-12:
        if declared.smallest is None or not declared.smallest < edges[1]:
            return (
                [],
                [],
                [],
                [
                    f"line {rows[0].line}: the first channel begins at {max(edges[0], 0.0):g}; how "
                    f"small is the smallest grain? Set min to its size, below {edges[1]:g} "
                    f"{declared.unit}"
                ],
            )
        edges = [declared.smallest, *edges[1:]]
    ends = f"channels go from {edges[0]:.4g} to {edges[-1]:.4g} {declared.unit}"
    return edges, values, [ends], []
