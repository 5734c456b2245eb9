"""The command `branchcrush verify`: every file of a study, held against what made it."""

import sys

from branchcrush.results.verification import verify as verified


def verify(place: str) -> int:
    """Print which files of a study are not what their jobs left, a line each, and a summary.

    Parameters
    ----------
    place : str
        The folder `results` of a study, or the folder that holds it.

    Returns
    -------
    int
        1 if there is such a file, else 0.

    Raises
    ------
    ResultsError
        When there are no results in the folder.

    Examples
    --------
    >>> verify("nowhere")
    Traceback (most recent call last):
    branchcrush.errors.ResultsError: nowhere is no folder: ...
    """
    found = verified(place)
    for fault in found.faults:
        print(fault, file=sys.stderr)
    for note in found.notes:
        print(note)
    whole = f"{found.whole} files are what {len(found.records)} jobs left"
    if not found.faults:
        print(f"sound: {found.folder}: {whole}")
        return 0
    number = len(found.faults)
    print(f"not sound: {found.folder}: {number} fault{'s' * (number > 1)}; {whole}")
    return 1
