"""What made the results of a job, written beside them, and whether they still fit what is there."""

import contextlib
import json
import os
import shutil
import sys
from collections.abc import Iterable, Iterator
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

from branchcrush import __version__
from branchcrush.checkpoints import checkpoint_of
from branchcrush.claims import claimed
from branchcrush.errors import ResultsError
from branchcrush.files.digests import Digests, digests_of, file_digest
from branchcrush.files.intact import Records, check_inputs, refuse
from branchcrush.files.made import below_results, read_record, record_bytes
from branchcrush.files.replacing import replacing
from branchcrush.jobs import job
from branchcrush.words import few

# Params of a rule that do not decide what its results hold: where its sources lie (the digest in
# `code` tells what is in them), and which dumps are kept.
_NOT_COMPARED = ("code", "inputs", "template", "templates", "glossary", "keep_dumps")
# Of the grains in each saved state.
_DUMP = "particles.dump.gz"


@contextlib.contextmanager
def recorded_job(snakemake: Any) -> Iterator[list[str]]:
    """Run a job of the workflow as `jobs.job` does; it ends with the record of what made it.

    What it kept to go on from is removed then.

    Its inputs are read before, and held against the records of the jobs that made them. Whoever
    else makes the same results, from another run or by a job that was begun twice, is waited for.

    Parameters
    ----------
    snakemake : object
        What Snakemake gives a script; `output.record` is where the record goes.

    Yields
    ------
    list of str
        For paths of files that the job writes besides its outputs, and that may be deleted.

    Raises
    ------
    SystemExit
        For a `BranchcrushError`; one is an input that is not what its job left. With exit code 0
        where whoever was waited for has made the results.
    """
    with job(snakemake.log[0]), claimed(snakemake.output.record) as waited:
        if waited and _is_made(snakemake):
            sys.exit(0)
        beside: list[str] = []
        digests = Digests(snakemake.rule, trust=False)
        record = _made_with(snakemake, snakemake.rule)
        # Before the job reads them: one that is edited meanwhile is another one the next time.
        record["inputs"] = digests_of(map(str, snakemake.input), digests)
        check_inputs(json.loads(_as_text(record)), snakemake.output.record)
        yield beside
        record["outputs"] = digests_of(_results(snakemake), digests)
        record["beside"] = digests_of(beside, digests)
        digests.note()
        _check_left({**record["outputs"], **record["beside"]})
        with replacing(snakemake.output.record) as file:
            file.write(record_bytes(record))
        # While nobody else makes the same, who would work in it.
        shutil.rmtree(checkpoint_of(snakemake.output.record), ignore_errors=True)


def _is_made(snakemake):
    """Return whether the results are there, made with what they would be made with now."""
    if not read_record(snakemake.output.record):
        return False
    return not _reason(snakemake, snakemake.rule, Digests(snakemake.rule, trust=False))


def _check_left(files):
    """Refuse a record of a file that is gone."""
    gone = [path for path, digest in files.items() if not digest]
    if gone:
        raise ResultsError(
            f"{gone[0]} was removed, or cannot be read, while the job that made it was at work, "
            "perhaps by a second job for the same results: repeat the command"
        )


def kept_dump(beside: str | PathLike[str], snakemake: Any) -> list[Path]:
    """Return the dump of the grains of a packing, which is no input of a job since it may go.

    Parameters
    ----------
    beside : path-like
        A file of the same packing.
    snakemake : object
        What Snakemake gives a script.

    Returns
    -------
    list of Path
        Empty where it is not there.

    Raises
    ------
    ResultsError
        When it is not as the job that wrote it left it.
    """
    path = Path(beside).with_name(_DUMP)
    if not path.exists():
        return []
    wildcards = dict(snakemake.wildcards.items())
    folder, _ = below_results(snakemake.output.record, wildcards)
    refuse([Records(folder).fault(path.relative_to(folder).as_posix(), file_digest(path))])
    return [path]


def _made_with(made: Any, rule: str) -> dict[str, Any]:
    """Return what a job is made with, of a job of Snakemake or of what it gives a script."""
    params = dict(made.params.items())
    return {
        "branchcrush": __version__,
        "rule": rule,
        "wildcards": dict(made.wildcards.items()),
        "code": params["code"],
        "keep_dumps": params.get("keep_dumps"),
        "params": {name: params[name] for name in params if name not in _NOT_COMPARED},
    }


def _results(made):
    """Return the paths of a job's outputs but for its record."""
    return [str(path) for path in made.output if path != made.output.record]


class OutOfDate(NamedTuple):
    """Why a job has to be done again."""

    job: Any
    reason: str


def out_of_date(jobs: Iterable[Any]) -> list[OutOfDate]:
    """Return which jobs do not fit what is there now, and why: by content, not by times and paths.

    A job fits when its record tells of the same code, configuration and inputs, and its outputs
    are there as it left them. A job of which nothing is there was not done yet, and is no case.

    Parameters
    ----------
    jobs : iterable
        Of Snakemake, or like them: rule.name, wildcards, params, input and output. Those without
        an output `record` are passed over.

    Returns
    -------
    list of OutOfDate
    """
    digests = Digests("checked")
    found = [
        OutOfDate(each, reason)
        for each in jobs
        if "record" in each.output.keys()  # noqa: SIM118 (a Namedlist is a list)
        if (reason := _reason(each, each.rule.name, digests))
    ]
    digests.note()
    return found


def _reason(made, rule, digests):
    """Return why a job has to be done again, in words, or "" where it fits."""
    record, results = read_record(made.output.record), _results(made)
    missing = [path for path in results if not os.path.exists(path)]
    if record is None:
        return (
            ""
            if len(missing) == len(results)
            else "no record tells what made its files: interrupted, or of an earlier version"
        )
    if not record:
        return "its record is damaged"
    if missing:
        return f"its file {_name(missing[0])} is missing"
    now = _made_with(made, rule)
    if now["code"] != record["code"]:
        made_by = record["branchcrush"]
        update = "" if made_by == __version__ else f" from branchcrush {made_by} to {__version__}"
        return f"its code changed{update}"
    if _as_text(now["params"]) != _as_text(record["params"]):
        return _changed_keys(record["params"], json.loads(_as_text(now["params"])))
    return _changed_inputs(record["inputs"], digests_of(map(str, made.input), digests)) or next(
        (
            f"its file {_name(path)} is not as it was left"
            for path in results
            if digests.of(path) != record["outputs"].get(path)
        ),
        "",
    )


def _as_text(params):
    """Return params as JSON; keys keep their order, since samples are listed in it."""
    return json.dumps(params)


def _changed_keys(before, now):
    """Return in words which keys of the configuration changed."""
    keys = list(dict.fromkeys(key.removeprefix("sample.") for key in _differences(before, now)))
    return f"{few(keys) or 'the order of its keys'} changed"


def _differences(before, now, key=""):
    """Yield the dotted keys at which two values differ."""
    if isinstance(before, dict) and isinstance(now, dict):
        for name in dict.fromkeys([*before, *now]):
            below = f"{key}.{name}" if key else name
            if name in before and name in now:
                yield from _differences(before[name], now[name], below)
            else:
                yield below
    elif _as_text(before) != _as_text(now):
        yield key


def _changed_inputs(before, now):
    """Return in words what changed of a job's inputs, or ""."""
    for path, digest in now.items():
        if not digest:
            return f"its input {_name(path)} is missing"
        if path not in before:
            return f"its input {_name(path)} is new"
        if digest != before[path]:
            return f"its input {_name(path)} changed"
    if list(before) != list(now):
        gone = next((path for path in before if path not in now), None)
        return f"its input {_name(gone)} is no longer one" if gone else "its inputs changed places"
    return ""


def _name(path):
    return os.path.basename(path)
