"""The last lines of a run, the same whichever way it was started."""

import os
from pathlib import Path

from snakemake_logger_plugin_branchcrush.run import Run, duration_text

# Of jobs whose end makes the verdict of the run's own, from which the summary is read.
_TELLING = ("all", "comparison")
_NAMED = 5
_GOES_ON = "The same command goes on from there; what is finished stays."


def closing_lines(
    run: Run,
    *,
    nothing_to_do: bool,
    is_interrupted: bool,
    seconds: float,
    start_folder: str,
) -> list[str]:
    """Return how a run ended: what failed, or what it came to and where the page is.

    Parameters
    ----------
    run : Run
    nothing_to_do : bool
        Whether all was there already.
    is_interrupted : bool
    seconds : float
        How long it took [s].
    start_folder : str
        Paths are told as seen from there.

    Returns
    -------
    list of str
        Empty where no job was to be run, as for a report or a list of files.
    """
    if is_interrupted:
        return [f"Stopped: {_done(run)}. {_GOES_ON}"]
    if run.failed:
        return _failures(run, start_folder)
    if not nothing_to_do and not run.finished:
        return []
    lines = [] if nothing_to_do else [f"Finished in {duration_text(seconds)}: {_done(run)}."]
    results = Path("results")
    if (nothing_to_do or run.has_finished(_TELLING)) and (results / "comparison.csv").exists():
        lines += _summary(results, start_folder)
    return lines


def _summary(results: Path, start_folder: str) -> list[str]:
    """Return the lines of the results, which are read in no other place."""
    from branchcrush.study.summary import summary

    try:
        return summary(results, shown_as=seen_from(start_folder, results)).splitlines()
    except (OSError, ValueError, KeyError) as error:  # of another version
        return [f"{seen_from(start_folder, results)}: no summary ({type(error).__name__}: {error})"]


def _failures(run: Run, start_folder: str) -> list[str]:
    """Return which jobs failed, where their logs are, and what to do."""
    lines = [f"{'One job' if len(run.failed) == 1 else f'{len(run.failed)} jobs'} failed:"]
    for job, reason in run.failed[:_NAMED]:
        log = f" ({seen_from(start_folder, job.log)})" if job.log else ""
        lines.append(f"  {job}: {reason.splitlines()[0]}{log}")
    if len(run.failed) > _NAMED:
        lines.append(f"  and {len(run.failed) - _NAMED} more")
    return [*lines, f"Before that: {_done(run)}. Once the cause is mended: {_GOES_ON.lower()}"]


def _done(run: Run) -> str:
    """Return how many jobs have ended well, in words."""
    words = [f"{run.packings_done} of {run.packings} packings"] if run.packings else []
    if run.steps:
        words.append(f"{run.steps_done} of {run.steps} {'other ' if words else ''}steps")
    return " and ".join(words) or "no job"


def seen_from(folder: str, path: str | os.PathLike[str]) -> str:
    """Return a path as it is seen from a folder, or whole where it lies outside.

    Parameters
    ----------
    folder : str
    path : path-like
        Seen from the working folder.

    Returns
    -------
    str

    Examples
    --------
    >>> seen_from(os.getcwd(), "results"), seen_from("/home/mia", "/home/zoe/results")
    ('results', '/home/zoe/results')
    """
    whole = os.path.abspath(path)
    seen = os.path.relpath(whole, folder)
    return whole if seen.startswith(os.pardir) else seen
