"""The command line of `branchcrush`."""

import argparse
import os
import sys
from collections.abc import Sequence

from branchcrush import __version__
from branchcrush.config.units import UNITS
from branchcrush.errors import BranchcrushError
from branchcrush.files.declared import WORDS

_GRADING = """\
Tell how a table of grain sizes is read: what its columns mean, D10 to D90, its curve, and the lines
for config.yaml. What is not declared and not told by the file's own header is asked for.

  branchcrush grading soil.csv --unit mm
  branchcrush grading sieves.csv --unit mm --values mass_retained --min 0.02
  branchcrush grading laser.csv --form histogram --basis volume --size diameter --unit um \\
      --sizes middles --scale log
  branchcrush grading --form lognormal --basis mass --size diameter --unit um \\
      --d10 82 --d50 200 --d90 486 --min 40 --max 1000
"""
_PREVIEW = """\
Tell what a study will be, cost and take on this machine, and draw its gradings, before it runs:
results/preview.txt and results/figures/<sample>/preview.png. Half a minute, for a trial in LAMMPS.
"""
_CHECK = """\
Check a configuration with all that it asks of grains, files and folders, and name all problems at
once, a line each. Names of files in it are relative to its folder.
"""
_VERIFY = """\
Read every file of a study and hold it against the record of the job that made it: what is missing,
changed, cut or damaged, without a record, of another seed or of another configuration, a line each.
Neither Snakemake nor a configuration is needed.
"""
_EXPORT = """\
Write a state of a packing for ParaView: grains, contacts, those with walls, force chains and the
cell, a .vtp file each, in a folder for the packing. Or, with --crate, ro-crate-metadata.json into
the results of a finished study: every file with its digest, what made it of what, the software and
the machine.

  branchcrush export                                  # the first packing, at the end of its loading
  branchcrush export my_sand --sample sand --seed 3   # of a study in another folder
  branchcrush export --crushed --state all            # grains that break, a file for each state
  branchcrush export --crate --licence https://spdx.org/licenses/CC-BY-4.0
"""
_EXIT = "exit code: 0 sound, 1 problems in what was given, 2 no such file, folder or option"
_HELP = {
    "unit": "of the sizes, if the header gives none",
    "size": "what sizes are; a sieve's are diameters",
    "basis": "what the table counts; sieves weigh mass",
    "values": "what stands beside the openings of sieves",
    "openings": "what the openings of sieves are",
    "sizes": "which size of each channel stands in the file",
    "scale": "how channels are spaced",
    "per": "what a density is taken per",
    "min": "the smallest grain, in the unit",
    "max": "the largest grain, in the unit",
}


def parser() -> argparse.ArgumentParser:
    """Return the reader of the command line.

    Returns
    -------
    argparse.ArgumentParser

    Examples
    --------
    >>> parser().parse_args(["check"]).place
    '.'
    """
    raw = argparse.RawDescriptionHelpFormatter
    whole = argparse.ArgumentParser("branchcrush", description=__doc__, epilog=_EXIT)
    whole.add_argument("--version", action="version", version=f"branchcrush {__version__}")
    commands = whole.add_subparsers(dest="command", required=True, metavar="COMMAND")

    grading = commands.add_parser(
        "grading",
        help="how a table of sizes is read",
        description=_GRADING,
        epilog=_EXIT,
        formatter_class=raw,
    )
    grading.add_argument("file", nargs="?", metavar="FILE", help="the table: text or .xlsx")
    forms = ("sieve", "density", "histogram", "radii", "lognormal", "weibull")
    grading.add_argument("--form", choices=forms, default="sieve", help="what it is [sieve]")
    for key, words in {"unit": tuple(UNITS), **WORDS}.items():
        grading.add_argument(f"--{key}", choices=words, help=_HELP[key])
    grading.add_argument(
        "--columns", nargs="+", metavar="COLUMN", help="which columns: words above one, or numbers"
    )
    grading.add_argument("--sheet", help="of a workbook: its name, or its number from 1")
    for key in ("min", "max", "d10", "d50", "d90"):
        grading.add_argument(
            f"--{key}", type=float, metavar="SIZE", help=_HELP.get(key, _sized(key))
        )
    grading.add_argument(
        "--geometric_standard_deviation", type=float, metavar="S", help="of a lognormal, with d50"
    )
    grading.add_argument(
        "--picture", type=_png, metavar="PNG", help="draw the curve into this file"
    )

    preview = commands.add_parser(
        "preview",
        help="what a study will be, cost and take",
        description=_PREVIEW,
        epilog=_EXIT,
        formatter_class=raw,
    )
    preview.add_argument("place", nargs="?", default=".", metavar="FOLDER", help="[.]")
    preview.add_argument(
        "--cores", type=_cores, default=_all_cores(), help="that a run will use [all]"
    )

    check = commands.add_parser(
        "check",
        help="all problems of a configuration",
        description=_CHECK,
        epilog=_EXIT,
        formatter_class=raw,
    )
    check.add_argument(
        "place",
        nargs="?",
        default=".",
        metavar="FOLDER|FILE",
        help="a folder with a config.yaml, or a configuration file [.]",
    )

    verify = commands.add_parser(
        "verify",
        help="every file of a study, held against what made it",
        description=_VERIFY,
        epilog=_EXIT,
        formatter_class=raw,
    )
    verify.add_argument(
        "place", nargs="?", default=".", metavar="FOLDER", help="of the study or its results [.]"
    )

    export = commands.add_parser(
        "export",
        help="packings as files for ParaView, a study as RO-Crate",
        description=_EXPORT,
        epilog=_EXIT,
        formatter_class=raw,
    )
    export.add_argument(
        "place", nargs="?", default=".", metavar="FOLDER", help="of the study or its results [.]"
    )
    export.add_argument("--sample", help="its name [the first]")
    export.add_argument("--seed", type=int, help="of the packing [the first]")
    export.add_argument(
        "--state", type=_state, default="end", help="its number, end, or all whose grains are kept"
    )
    export.add_argument("--crushed", action="store_true", help="the packing whose grains break")
    export.add_argument(
        "--crate", action="store_true", help="metadata of the whole study as RO-Crate"
    )
    export.add_argument("--licence", default="", metavar="URL", help="of the data, for --crate")
    export.add_argument("--to", default="paraview", metavar="FOLDER", help="to write to [paraview]")
    return whole


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command, and return its exit code.

    Parameters
    ----------
    arguments : sequence of str, optional
        Of the command line; those of the process by default.

    Returns
    -------
    int
        0, 1 for problems of what was given, 2 for no such file or folder.

    Examples
    --------
    >>> main(["check", "nowhere"])
    2
    """
    given = vars(parser().parse_args(arguments))
    command = given.pop("command")
    # A command imports what it needs, some of which takes a second.
    try:
        if command == "check":
            from branchcrush.command.check import check

            return check(given["place"])
        if command == "preview":
            from branchcrush.command.preview import preview

            return preview(given["place"], given["cores"])
        if command == "verify":
            from branchcrush.command.verify import verify

            return verify(given["place"])
        if command == "export":
            from branchcrush.command.export import export

            return export(**given)
        from branchcrush.command.grading import grading

        file, picture = given.pop("file"), given.pop("picture")
        return grading(file, {key: _key(value) for key, value in given.items()}, picture)
    except OSError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except BranchcrushError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    except MemoryError:
        print("error: not enough memory: ask for fewer grains or states", file=sys.stderr)
        return 1


def _key(value):
    """Return an option as the key of the configuration: a column or a sheet may be a number."""
    if isinstance(value, list):
        return [_key(item) for item in value]
    return int(value) if isinstance(value, str) and value.isdecimal() else value


def _sized(key):
    return f"the size that {key[1:]} %% are finer than, of a lognormal or Weibull curve"


def _png(name):
    if not name.endswith(".png"):
        raise argparse.ArgumentTypeError(f"{name!r} must end in .png")
    return name


def _state(text):
    if text not in ("end", "all") and not text.isdecimal():
        raise argparse.ArgumentTypeError(f"{text!r} must be the number of a state, end or all")
    return text


def _cores(text):
    cores = int(text)
    if cores < 1:
        raise argparse.ArgumentTypeError("must be 1 or more")
    return cores


def _all_cores():
    return len(os.sched_getaffinity(0))


if __name__ == "__main__":
    sys.exit(main())
