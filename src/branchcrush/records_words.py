"""What is said of records before a run: what is made anew, what is kept, and what it lacks."""

from collections.abc import Iterable, Mapping
from typing import Any

from branchcrush import __version__
from branchcrush.files.made import read_record
from branchcrush.records import OutOfDate
from branchcrush.words import few

# From the least.
_KEPT_DUMPS = ("none", "last", "all")


def lines_of(cases: Iterable[OutOfDate]) -> list[str]:
    """Return what is made anew, a line for each reason.

    Parameters
    ----------
    cases : iterable of OutOfDate

    Returns
    -------
    list of str

    Examples
    --------
    >>> from types import SimpleNamespace as Namespace
    >>> fit = Namespace(rule=Namespace(name="fit"), wildcards={"sample": "paper"})
    >>> lines_of([OutOfDate(fit, "its code changed")])
    ['made anew: fit of paper, because its code changed']
    """
    grouped: dict[str, dict[str, int]] = {}
    for case in cases:
        wildcards = dict(case.job.wildcards.items())
        what = case.job.rule.name
        if "sample" in wildcards:
            what += f" of {wildcards['sample']}"
        names = grouped.setdefault(case.reason, {})
        names[what] = names.get(what, 0) + ("seed" in wildcards)
    return [
        f"made anew: {few(_counted(names))}, because {reason}" for reason, names in grouped.items()
    ]


def _counted(names: Mapping[str, int]) -> list[str]:
    """Return names with the number of packings that each stands for."""
    return [
        f"{name} ({number} packing{'s' * (number > 1)})" if number else name
        for name, number in names.items()
    ]


def kept_of_other_versions(jobs: Iterable[Any]) -> str:
    """Return how many results another version made that this one keeps, and why, or "".

    Parameters
    ----------
    jobs : iterable
        As for `records.out_of_date`, of those that will not be done.

    Returns
    -------
    str
    """
    records = (read_record(each.output.record) for each in jobs)
    versions = [record["branchcrush"] for record in records if record]
    others = sorted({version for version in versions if version != __version__})
    if not others:
        return ""
    number = sum(version != __version__ for version in versions)
    return (
        f"kept: what {number} job{'s' * (number > 1)} of branchcrush {', '.join(others)} made, "
        f"whose sources are the same in {__version__}"
    )


def dumps_not_kept(jobs: Iterable[Any]) -> str:
    """Return what to do where dumps are asked for that earlier runs did not keep, or "".

    Parameters
    ----------
    jobs : iterable
        As for `records.out_of_date`, of those that will not be done.

    Returns
    -------
    str
    """
    short = []
    for each in jobs:
        wanted = dict(each.params.items()).get("keep_dumps")
        kept = (read_record(each.output.record) or {}).get("keep_dumps") if wanted else None
        if kept in _KEPT_DUMPS and _KEPT_DUMPS.index(kept) < _KEPT_DUMPS.index(wanted):
            short.append((each.rule.name, wanted))
    if not short:
        return ""
    number, (rule, wanted) = len(short), short[0]
    return (
        f"keep_dumps: {wanted} holds for packings that are still to be compressed; {number} "
        f"packing{'s' * (number > 1)} kept less. To have their dumps: --forcerun {rule}"
    )
