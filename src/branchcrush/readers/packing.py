"""All frames of a packing that another code made: contacts held against grains."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from branchcrush.errors import ReadingError
from branchcrush.readers.cells import Cell
from branchcrush.readers.frames import ColumnFrame
from branchcrush.readers.layouts import (
    Source,
    contact_reader,
    contact_roles,
    grain_reader,
    grain_roles,
)
from branchcrush.readers.limits import sound_cell
from branchcrush.readers.matching import Matching, Touching, matched
from branchcrush.readers.roles import Grains, grains_of, in_roles

# A radius that differs by more is another grain's.
_SAME_RADIUS = 1e-4


@dataclass(frozen=True, eq=False)
class Moment:
    """Grains, cell and contacts of one frame, in SI."""

    where: str
    step: float | None
    grains: Grains
    cell: Cell
    touching: Touching
    digits: int


@dataclass(frozen=True)
class ReadPacking:
    """The frames of a packing, each a state, and what was left out on the way."""

    moments: tuple[Moment, ...]
    notes: tuple[str, ...]


def read_frames(source: Source) -> ReadPacking:
    r"""Return the frames of a packing, contacts held against grains in each.

    Parameters
    ----------
    source : Source

    Returns
    -------
    ReadPacking

    Raises
    ------
    ReadingError
        With a line for each problem: what a file lacks, and all that does not fit.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     grains, contacts = (pathlib.Path(folder, name) for name in ("balls", "contacts"))
    ...     _ = grains.write_text("id,x,y,z,radius\n4,1,2,2,0.5\n9,1.9,2,2,0.5\n")
    ...     _ = contacts.write_text("id1,id2,fx,fy,fz\n9,4,3,0,0\n")
    ...     read = read_frames(Source(format="columns", grains=[grains], contacts=[contacts],
    ...                               periodic=True, low=[0, 0, 0], high=[4, 4, 4]))
    >>> read.moments[0].touching.normal_force.tolist()
    [3.0]
    """
    grains = _numbered(source.grains, grain_reader(source))
    contacts = _numbered(source.contacts, contact_reader(source))
    pairs, notes = _together(grains, contacts, source.match)
    notes += [note for frame in (*grains, *contacts) for note in frame.notes]
    if source.last:
        pairs = pairs[-1:]
    moments, problems = [], []
    for one, other in pairs:
        try:
            moments.append(_moment(one, other, source))
        except ReadingError as error:
            # Some codes list no contacts at first, before they have sought any.
            if other.rows or moments or len(pairs) == 1:
                problems += str(error).splitlines()
            else:
                notes.append(f"left out, a first frame without contacts: {error}")
    if problems:
        raise ReadingError("\n".join(problems))
    if not moments:
        raise ReadingError(f"{pairs[0][1].where}: no frame has contacts")
    _same_grains(moments)
    return ReadPacking(tuple(moments), tuple(notes))


def _numbered(files, reader):
    """Return the frames of some files, in the order of their steps where all tell them."""
    frames = [frame for file in files for frame in reader(file)]
    steps = [frame.step for frame in frames]
    if None in steps:
        return frames
    twice = {step for step in steps if steps.count(step) > 1}
    if twice:
        raise ReadingError(
            f"{frames[0].where}: step {min(twice):g} stands more than once: were two runs written "
            "into one file?"
        )
    return sorted(frames, key=lambda frame: frame.step)


def _together(grains, contacts, match):
    """Return grains and contacts of the same frames, and notes of what has no partner."""
    told = all(frame.step is not None for frame in (*grains, *contacts))
    if match == "order" or not told:
        if len(grains) != len(contacts):
            raise ReadingError(
                f"{grains[0].where}: {len(grains)} frames of grains and {len(contacts)} of "
                "contacts, matched by their order: give as many of both"
            )
        return list(zip(grains, contacts, strict=True)), []
    by_step = {frame.step: frame for frame in contacts}
    pairs = [(frame, by_step[frame.step]) for frame in grains if frame.step in by_step]
    if not pairs:
        steps = [", ".join(f"{frame.step:g}" for frame in each[:5]) for each in (grains, contacts)]
        raise ReadingError(
            f"{grains[0].where}: grains and contacts have no step in common, grains {steps[0]}, "
            f"contacts {steps[1]}: dump both at the same steps, or if they are of the same moments "
            "say packing.match: order"
        )
    both = {frame.step for frame, _ in pairs}
    notes = []
    for kind, other, frames in (
        ("grains", "contacts", grains),
        ("contacts", "grains", contacts),
    ):
        alone = [frame.step for frame in frames if frame.step not in both]
        if alone:
            shown = ", ".join(f"{step:g}" for step in alone[:5])
            notes.append(
                f"{len(alone)} frames of {kind} (step {shown}) have no {other} and were left out"
            )
    return pairs, notes


def _moment(one: ColumnFrame, other: ColumnFrame, source: Source) -> Moment:
    """Return the state that a frame of grains and one of contacts make."""
    grains = grains_of(one, grain_roles(one, source), source.length)
    cell = sound_cell(_cell(one, other, source), grains.positions, grains.radii, one.where)
    digits = min(one.digits, 17)
    how = Matching(
        "twice" if source.format == "mercurydpm" else source.each_pair,
        source.wall_ids,
        source.format == "mercurydpm",
        source.length,
        source.force,
    )
    columns = in_roles(other, contact_roles(other, source)) if other.rows else _no_contacts()
    touching = matched(grains, columns, cell, how, other.where, digits)
    return Moment(one.where, one.step, grains, cell, touching, digits)


def _no_contacts() -> dict[str, NDArray]:
    return {"id1": np.zeros(0), "id2": np.zeros(0), "normal_force": np.zeros(0)}


def _cell(one: ColumnFrame, other: ColumnFrame, source: Source) -> Cell:
    """Return the cell of a frame: of the configuration, or of the file."""
    if source.low is not None and source.high is not None:
        low, high = (np.multiply(each, source.length) for each in (source.low, source.high))
        return Cell.between(low, high, (source.periodic,) * 3)
    frame = one if one.cell is not None else other
    if frame.cell is None:
        raise ReadingError(
            f"{one.where}: the file does not tell the cell: give packing.cell, its corners low and "
            "high"
        )
    told = frame.cell.periodic
    if not frame.boundary_told:
        told = (source.periodic,) * 3
    elif all(told) != source.periodic:
        faces = " ".join("pp" if each else "not periodic" for each in told)
        raise ReadingError(
            f"{frame.where}: its cell is {faces} in x, y and z, and boundary says "
            f"{'periodic' if source.periodic else 'walls'}: correct boundary"
        )
    return Cell(frame.cell.origin * source.length, frame.cell.vectors * source.length, told)


def _same_grains(moments: Sequence[Moment]) -> None:
    """Refuse frames that have other grains than the first."""
    first = moments[0].grains
    for moment in moments[1:]:
        same = np.array_equal(moment.grains.ids, first.ids)
        if not same or np.any(np.abs(moment.grains.radii / first.radii - 1.0) > _SAME_RADIUS):
            raise ReadingError(
                f"{moment.where}: its grains are not those of the first frame "
                f"({moment.grains.ids.size} and {first.ids.size}): states of one packing have the "
                "same grains; read each frame as a packing of its own"
            )
