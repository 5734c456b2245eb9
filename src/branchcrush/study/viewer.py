"""Grains and contacts of saved states, packed so small that a page can hold and draw them."""

import base64
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from branchcrush.packings.cells import cell_corners

# What a page may hold for one packing: with its figures it stays under 6 MB.
PAGE_BYTES = 2_000_000
_STEPS = 65535
_LOGARITHMIC = ("radius", "energy", "pressure", "force")


@dataclass(frozen=True, eq=False)
class ViewerState:
    """What is drawn of a packing in one saved state."""

    state: int  # number of the state
    label: str  # what it is, in two or three words
    cell: NDArray  # vectors of its edges, a row each, about the origin, shape (3, 3) [m]
    solid_fraction: float  # phi [-]
    mean_stress: float  # [Pa]
    positions: NDArray  # shape (N, 3) [m]
    radius: NDArray  # shape (N,) [m]
    energy: NDArray  # elastic, half of each contact's and all of a wall's, shape (N,) [J]
    pressure: NDArray  # mean stress of each grain, shape (N,) [Pa]
    i: NDArray  # the two grains of each contact, from 0, shape (M,)
    j: NDArray
    force: NDArray  # of each contact, shape (M,) [N]
    wall_grain: NDArray  # the grain of each contact with a wall, shape (W,)
    wall_direction: NDArray  # of unit length from the grain to the wall, shape (W, 3) [-]
    wall_force: NDArray  # shape (W,) [N]
    generation: NDArray | None = None  # breakages before each grain, shape (N,); None: none break

    @property
    def words(self) -> int:
        """Numbers of 16 bits that it takes."""
        index = 2 if self.wide else 1
        walls = (4 + index) * len(self.wall_grain)
        return 7 * len(self.radius) + (1 + 2 * index) * len(self.force) + walls

    @property
    def wide(self) -> bool:
        """Whether 16 bits are too few to count its grains."""
        return len(self.radius) > _STEPS + 1


class ViewerData(NamedTuple):
    """What the macro `viewer` of `workflow/report/viewer.html.jinja` takes."""

    header: dict[str, Any]  # what the numbers are, as JSON; a key `reason` where there are none
    data: str  # the numbers, 16 bits each, in base64


def viewer_data(
    states: Sequence[ViewerState],
    *,
    periodic: Sequence[bool],
    limit_bytes: int = PAGE_BYTES,
    saved_states: int | None = None,
) -> ViewerData:
    r"""Pack saved states for the page: numbers of 16 bits in base64, and a header of JSON.

    A coordinate is a multiple of 1/65535 of the range of the state's coordinates, one of a
    direction of the range from -1 to 1. Radius, energy,
    pressure and force have equal ratios between their steps, one scale for all states:

    .. math:: v = v_{\min} (v_{\max}/v_{\min})^{(k - 1)/65534}, \quad k = 1 \ldots 65535

    and k = 0 is no energy, pressure or force. Over ten decades a step is 0.035 %.

    Where all states take more than the limit, the most that fit are taken at equal distances, the
    last among them. Where even the last alone takes more, its weakest contacts are left out. The
    header's `notes` say so.

    Parameters
    ----------
    states : sequence of ViewerState
        In the order of the loading.
    periodic : sequence of bool, shape (3,)
        Whether the cell is, along each of its edges.
    limit_bytes : int
        Of the text in base64.
    saved_states : int, optional
        How many states were saved, where positions are known of fewer.

    Returns
    -------
    ViewerData

    Raises
    ------
    ValueError
        When a number is not finite or a radius not positive; the message names all of them.

    Examples
    --------
    >>> no, one = np.zeros(0), np.ones(1)
    >>> grain = ViewerState(0, "placed", 4.0 * np.eye(3), 0.07, 0.0, np.zeros((1, 3)), one,
    ...                     0 * one, 0 * one, no, no, no, no, np.zeros((0, 3)), no)
    >>> header, data = viewer_data([grain], periodic=[True] * 3)
    >>> header["scales"]["radius"], header["states"][0]["grains"], len(data)
    ([1.0, 1.0], 1, 20)
    """
    _check(states)
    kept, notes = _fitting(list(states), limit_bytes)
    saved = len(states) if saved_states is None else saved_states
    if not kept:
        return ViewerData({"reason": notes[0] if notes else "no state was saved"}, "")
    if saved > len(states):
        notes.insert(0, f"Positions are known of {len(states)} of {saved} saved states.")
    scales = {name: _scale([_values(state, name) for state in kept]) for name in _LOGARITHMIC}
    words, rows, offset = [], [], 0
    for state in kept:
        span = float(np.abs(np.concatenate([state.positions, cell_corners(state.cell)])).max())
        part = _words(state, span, scales)
        rows.append(
            {
                "state": int(state.state),
                "label": state.label,
                "cell_m": np.asarray(state.cell, dtype=float).tolist(),
                "span_m": span,
                "solid_fraction": float(state.solid_fraction),
                "mean_stress_Pa": float(state.mean_stress),
                "grains": len(state.radius),
                "contacts": len(state.force),
                "walls": len(state.wall_grain),
                "wide": state.wide,
                "offset": offset,
            }
        )
        words.append(part)
        offset += part.size
    header = {
        "periodic": [bool(each) for each in periodic],
        "breaks": any(state.generation is not None for state in kept),
        "scales": scales,
        "states": rows,
        "notes": notes,
    }
    # Little-endian on every machine, as the page reads it.
    raw = np.concatenate(words).astype("<u2").tobytes()
    return ViewerData(header, base64.b64encode(raw).decode("ascii"))


def _check(states: Sequence[ViewerState]) -> None:
    """Refuse what cannot be drawn, naming all of it."""
    wrong = []
    for state in states:
        for name in ("cell", "positions", "wall_direction", *_LOGARITHMIC):
            value = _values(state, name)
            if not np.all(np.isfinite(value)):
                wrong.append(f"state {state.state}: {name} holds a number that is not finite")
        if np.any(np.asarray(state.radius) <= 0):
            wrong.append(f"state {state.state}: a radius must be above 0")
    if wrong:
        raise ValueError("; ".join(wrong))


def _values(state: ViewerState, name: str) -> NDArray:
    if name == "force":
        return np.concatenate([state.force, state.wall_force]).astype(float)
    return np.asarray(getattr(state, name), dtype=float)


def _fitting(states: list[ViewerState], limit: int) -> tuple[list[ViewerState], list[str]]:
    """Return the states that fit, and what is to be said of those that do not."""

    def size(some: Sequence[ViewerState]) -> int:
        return 4 * -(-2 * sum(state.words for state in some) // 3)

    total = len(states)
    for number in range(total, 0, -1):
        picked = np.unique(np.linspace(0, total - 1, number).round().astype(int))
        some = [states[k] for k in picked] if number > 1 else states[-1:]
        if size(some) <= limit:
            left_out = number < total
            note = (
                f"{number} of {total} states are in this page, at equal distances, so that it "
                "stays small."
            )
            return some, [note] if left_out else []
    if not states:
        return [], []
    last = states[-1]
    grains = len(last.radius)
    of_contact = 5 if last.wide else 3
    room = limit // 4 * 3 // 2 - replace(last, i=[], j=[], force=[]).words
    if room < 0:
        return [], [f"{grains} grains are more than a page can hold; the result files hold them"]
    most = int(room // of_contact)
    strongest = np.sort(np.argsort(-np.asarray(last.force), kind="stable")[:most])
    cut = replace(last, i=last.i[strongest], j=last.j[strongest], force=last.force[strongest])
    only = f"Only the last of {total} states is in this page" if total > 1 else "In this page"
    what = f"the {most} strongest of its {len(last.force)} contacts"
    return [cut], [f"{only}, with {what}, so that it stays small."]


def _scale(values: Sequence[NDArray]) -> list[float] | None:
    """Return the least and the largest positive value, None where there is none."""
    positive = [some[some > 0] for some in values if np.any(some > 0)]
    if not positive:
        return None
    return [
        float(min(some.min() for some in positive)),
        float(max(some.max() for some in positive)),
    ]


def _coded(values: ArrayLike, scale: list[float] | None) -> NDArray:
    """Return the step of each value on a scale of equal ratios, 0 where it is not positive."""
    values = np.asarray(values, dtype=float)
    code = np.zeros(values.shape, dtype=np.uint16)
    some = values > 0
    if scale is None or not some.any():
        return code
    low, high = np.log(scale)
    # A range of one number has one step.
    place = (np.log(values[some]) - low) / (high - low if high > low else 1.0)
    code[some] = 1 + np.clip(place * (_STEPS - 1), 0, _STEPS - 1).round()
    return code


def _shares(vectors: ArrayLike, span: float) -> NDArray:
    """Return the step of each coordinate from -span to span, a row for x, y and z."""
    places = np.asarray(vectors, dtype=float).reshape(-1, 3).T
    return ((places / span + 1.0) / 2.0 * _STEPS).round()


def _indices(grains: ArrayLike, wide: bool) -> list[NDArray]:
    """Return numbers of grains in one word, or their lower and their upper words."""
    number = np.asarray(grains).astype(np.uint32)
    return [number & 0xFFFF, number >> 16] if wide else [number]


def _words(state: ViewerState, span: float, scales: dict[str, Any]) -> NDArray:
    """Return all numbers of a state, one kind after the other."""
    grains = len(state.radius)
    born = np.zeros(grains) if state.generation is None else np.asarray(state.generation)
    parts = [
        *_shares(state.positions, span),
        *(_coded(getattr(state, name), scales[name]) for name in ("radius", "energy", "pressure")),
        born,
        *_indices(state.i, state.wide),
        *_indices(state.j, state.wide),
        _coded(state.force, scales["force"]),
        *_indices(state.wall_grain, state.wide),
        *_shares(state.wall_direction, 1.0),
        _coded(state.wall_force, scales["force"]),
    ]
    return np.concatenate([np.asarray(part).astype(np.uint16) for part in parts])
