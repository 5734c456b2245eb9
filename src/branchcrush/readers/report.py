"""What the reader of a packing should know: what was left out, and what its digits allow."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from branchcrush.packings.contact_laws import HertzContact, LinearContact, reduced_radius
from branchcrush.readers.packing import Moment, ReadPacking

# Relative errors of overlaps, and shares of tangential forces, that are told from.
_TOLD, _TANGENTIAL = 1e-3, 1e-2
# Overlaps that are so many times their error tell the law; the forces may differ by this share.
_SURE, _LAW = 20.0, 0.1
_FEWEST = 10


def reading_report(
    read: ReadPacking, law: LinearContact | HertzContact, files: Sequence[str]
) -> dict[str, Any]:
    r"""Return what was read of a packing, in numbers and in sentences.

    Parameters
    ----------
    read : ReadPacking
    law : LinearContact or HertzContact
        As it is declared.
    files : sequence of str

    Returns
    -------
    dict
        files, states, steps, cells_m, periodic, grains, contacts, wall_contacts, digits,
        overlap_error, force_by_law, tangential_share and notes. Numbers are of the last frame.

    Examples
    --------
    >>> from branchcrush.readers.layouts import Source
    >>> from branchcrush.readers.packing import read_frames
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     grains, contacts = (pathlib.Path(folder, name) for name in ("balls", "contacts"))
    ...     _ = grains.write_text("id x y z radius\n4 1 2 2 0.5\n9 1.9 2 2 0.5\n")
    ...     _ = contacts.write_text("id1 id2 fx fy fz\n9 4 3 0 0\n")
    ...     read = read_frames(Source(format="columns", grains=[grains], contacts=[contacts],
    ...                               periodic=True, low=[0, 0, 0], high=[4, 4, 4]))
    >>> reading_report(read, LinearContact(10.0), ["balls"])["contacts"]
    1
    """
    last = read.moments[-1]
    touching = last.touching
    relative = _relative_error(last)
    by_law = _force_by_law(last, law)
    notes = [*read.notes, *_left_out(read), *_digits(last, relative), *_law(by_law)]
    if touching.tangential_share > _TANGENTIAL:
        notes.append(
            f"tangential forces are {touching.tangential_share:.1%} of the normal ones: they count "
            "in the balance of forces; stress, energies and fabric here are of normal forces alone"
        )
    return {
        "files": list(files),
        "states": len(read.moments),
        "steps": [moment.step for moment in read.moments],
        "cells_m": [moment.cell.vectors.tolist() for moment in read.moments],
        "periodic": [bool(each) for each in last.cell.periodic],
        "grains": int(last.grains.ids.size),
        "contacts": int(touching.i.size),
        "wall_contacts": int(touching.wall_grain.size),
        "digits": last.digits,
        "overlap_error": relative,
        "force_by_law": by_law,
        "tangential_share": touching.tangential_share,
        "notes": notes,
    }


def _relative_error(moment: Moment) -> float:
    """Return how far the median overlap is off by the digits of positions [-]."""
    overlap = moment.touching.overlap
    return float(moment.touching.overlap_error / np.median(overlap)) if overlap.size else 0.0


def _force_by_law(moment: Moment, law: LinearContact | HertzContact) -> float:
    """Return the force of the law at the overlaps over that of the file, the median [-].

    Of overlaps that the digits tell; nan where there are none.
    """
    touching, radii = moment.touching, moment.grains.radii
    sure = touching.overlap > _SURE * touching.overlap_error
    if sure.sum() < _FEWEST:
        return float("nan")
    reduced = reduced_radius(radii[touching.i[sure]], radii[touching.j[sure]])
    return float(
        np.median(law.force(touching.overlap[sure], reduced) / touching.normal_force[sure])
    )


def _left_out(read: ReadPacking) -> list[str]:
    """Return a sentence for each kind of contact that was left out, with how many there were."""
    totals: dict[str, int] = {}
    for moment in read.moments:
        for why, number in moment.touching.counts.items():
            totals[why] = totals.get(why, 0) + number
    return [f"{number} {why} were left out" for why, number in totals.items()]


def _digits(moment: Moment, relative: float) -> list[str]:
    if relative <= _TOLD:
        return []
    return [
        f"positions have {moment.digits} significant digits: overlaps that are made of them may be "
        f"off by {relative:.2g} of the median one. Energies do not rest on them but on the forces"
    ]


def _law(ratio: float) -> list[str]:
    if np.isnan(ratio) or abs(ratio - 1.0) <= _LAW:
        return []
    return [
        f"the contact law that is declared makes {ratio:.3g} times the forces of the file at their "
        "overlaps (median): is contact that of the run? A stiffness that is wrong by a factor "
        "makes all energies wrong by it, and leaves n as it is"
    ]
