"""Measure a part, and write what came of it: python -m benchmarks PART [NAME=VALUE ...]

PART is one of the names below, or `all`, which leaves out those that need a setting (`before`) or
Slurm (`cluster`) and those that measure no time (`damage`, `kills`, `orphans`, `fuzz`). A
NAME=VALUE, the value as JSON, is a setting of the part's `run`, for a trial; its result goes to a
folder named by --results, so that no trial is taken for a result.
"""

import argparse
import json
import shlex
import subprocess
import sys
import time
from datetime import date
from importlib import import_module
from pathlib import Path

from benchmarks.measure import machine

PARTS = (
    "paper",
    "fractal",
    "large",
    "growth",
    "mpi",
    "overhead",
    "pages",
    "analysis",
    "neighbours",
    "paths",
    "tolerance",
    "breakdown",
    "minimisers",
    "crushing",
    "checkpoints",
)
# These need settings, so `all` leaves them out.
NEED_SETTINGS = ("before",)
# It begins daemons, as root.
NEED_SLURM = ("cluster",)
# What holds, not what it takes.
NOT_TIMED = ("damage", "kills", "orphans", "fuzz")
RESULTS = Path(__file__).with_name("results")
# What is shown of a result without a `summary` of its own.
_MOST_LINES = 20


def main(arguments=None):
    """Run the parts asked for; return 1 if one of them failed, after all the others."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("part", choices=["all", *PARTS, *NEED_SETTINGS, *NEED_SLURM, *NOT_TIMED])
    parser.add_argument("settings", nargs="*", metavar="NAME=VALUE")
    parser.add_argument("--results", type=Path, help="folder of what is written")
    asked = parser.parse_args(arguments)
    if asked.settings and (asked.part == "all" or asked.results is None):
        parser.error("settings are for one part, and need --results FOLDER")
    folder = asked.results or RESULTS
    if asked.part != "all":
        measure(asked.part, dict(map(_setting, asked.settings)), folder)
        return 0
    # Each in a process of its own: the memory of what a part starts is counted from the size of
    # the process that starts it. One that fails does not keep the others from being measured.
    command = [sys.executable, "-m", "benchmarks", "--results", str(folder)]
    failed = [part for part in PARTS if subprocess.run([*command, part]).returncode]
    if failed:
        print(f"failed: {', '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


def measure(part, settings, folder):
    """Run a part, write its JSON into a folder, and print what came of it in short."""
    print(f"{part} ...", flush=True)
    module = import_module(f"benchmarks.{part}")
    # Before the part itself loads the machine.
    on = machine()
    start = time.perf_counter()
    result = module.run(**settings)
    minutes = (time.perf_counter() - start) / 60.0
    words = [f"{name}={json.dumps(value)}" for name, value in settings.items()]
    written = {
        "part": part,
        "made": date.today().isoformat(),
        "command": shlex.join(["python", "-m", "benchmarks", part, *words]),
        "minutes": round(minutes, 1),
        "machine": on,
        "result": result,
    }
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{part}.json"
    path.write_text(json.dumps(written, indent=2, default=_plain) + "\n", encoding="utf-8")
    lines = module.summary(result) if hasattr(module, "summary") else _numbers(result)
    for line in lines:
        print(f"  {line}")
    print(f"  {path.name} after {minutes:.1f} minutes", flush=True)


def _setting(word):
    name, equals, value = word.partition("=")
    if not equals:
        raise SystemExit(f"a setting is NAME=VALUE, and {word!r} is not")
    return name, json.loads(value)


def _plain(value):
    """Return what JSON can hold of a NumPy number or array, or of a path."""
    return value.tolist() if hasattr(value, "tolist") else str(value)


def _numbers(result, of=""):
    """Return the first lines `name: number` of a result, whatever is nested in it."""
    lines = []
    for name, value in result.items():
        if isinstance(value, dict):
            lines += _numbers(value, f"{of}{name}.")
        elif isinstance(value, int | float | str):
            shown = f"{value:.4g}" if isinstance(value, float) else value
            lines.append(f"{of}{name}: {shown}")
    return lines[:_MOST_LINES]


if __name__ == "__main__":
    sys.exit(main())
