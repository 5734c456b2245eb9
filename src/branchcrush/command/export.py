"""The command `branchcrush export`: packings as files for ParaView, a study as RO-Crate."""

from pathlib import Path

import branchcrush
from branchcrush.results.crate import write_crate
from branchcrush.results.packing import Packing, State


def export(
    place: str,
    to: str,
    sample: str | None = None,
    seed: int | None = None,
    state: str = "end",
    crushed: bool = False,
    crate: bool = False,
    licence: str = "",
) -> int:
    """Write states of packings as .vtp files, a folder each packing, and print what was written.

    Or the metadata of the study as RO-Crate, beside its results.

    Parameters
    ----------
    place : str
        The folder `results` of a study, or the folder that holds it.
    to : str
        The folder to write to.
    sample : str, optional
        The first one by default.
    seed : int, optional
        The first one by default.
    state : str
        The number of a state, end or all.
    crushed : bool
        Whether of the packing whose grains break.
    crate : bool
        Whether the metadata of the study are wanted, and no packing.
    licence : str
        Address of the licence of the data, for these metadata.

    Returns
    -------
    int
        0.

    Raises
    ------
    ResultsError
        When there is no such sample, seed or state, or its centres are not kept; of RO-Crate when
        the study is not finished or a file of it is damaged.

    Examples
    --------
    >>> export("nowhere", "paraview")
    Traceback (most recent call last):
    branchcrush.errors.ResultsError: nowhere is no folder: ...
    """
    if crate:
        print(write_crate(place, licence))
        return 0
    study = branchcrush.open_study(place)
    chosen = study[next(iter(study.samples)) if sample is None else sample]
    packing = chosen.seed(next(iter(chosen.seeds), 0) if seed is None else seed)
    if crushed:
        packing = packing.as_crushed()
    folder = Path(to, packing.prefix)
    for one in _states(packing, state):
        print(*one.export_vtp(folder), sep="\n")
    return 0


def _states(packing: Packing, asked: str) -> tuple[State, ...]:
    if asked == "all":
        return tuple(state for state in packing.states if state.has_centres)
    return (packing.end if asked == "end" else packing.state(int(asked)),)
