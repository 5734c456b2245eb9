"""`branchcrush check`: what is wrong with a configuration, all of it at once."""

import os
import sys
from collections.abc import Collection
from pathlib import Path

from branchcrush.config.checks import checked_study
from branchcrush.config.file import config_file_content
from branchcrush.config.packing import ReadSample
from branchcrush.config.schema import Config
from branchcrush.errors import ConfigError


def study_of(place: str, *, few_grains: bool = False) -> Config | None:
    """Return the configuration of a folder or a file, or print what is wrong with it.

    Names of files in it are relative to that folder, which becomes the working one.

    Parameters
    ----------
    place : str
        A folder with a config.yaml, or a configuration file.
    few_grains : bool
        As for `config.checks.checked_study`.

    Returns
    -------
    Config or None

    Raises
    ------
    FileNotFoundError
        When there is neither.
    """
    path = Path(place)
    file = path / "config.yaml" if path.is_dir() else path
    if not file.is_file():
        raise FileNotFoundError(f"there is no file {file}: name a folder with a config.yaml")
    os.chdir(file.parent)
    try:
        return checked_study(config_file_content(file.name), few_grains=few_grains)
    except ConfigError as error:
        print(error, file=sys.stderr)
        return None


def measured_line(name: str, given: Collection[str]) -> str:
    """Return what will be made of a measured material, in a line.

    Parameters
    ----------
    name : str
    given : collection of str
        Keys of the material that are given.

    Returns
    -------
    str

    Examples
    --------
    >>> measured_line("sand", ["before", "compression", "ultimate_smallest"])
    'sand, measured: resistance from its compression curve -> results/measured.html'
    """
    made = {
        "after": "breakage from its sieve curves",
        "compression": "resistance from its compression curve",
    }
    words = ", ".join(what for key, what in made.items() if key in given)
    return f"{name}, measured: {words} -> results/measured.html"


def read_line(name: str, sample: ReadSample) -> str:
    """Return what will be made of packings that another code made, in a line.

    Parameters
    ----------
    name : str
    sample : ReadSample

    Returns
    -------
    str
    """
    number = len(sample.seeds)
    return f"{name}: {number} packing{'s' if number > 1 else ''} read from {sample.packing.format}"


def check(place: str) -> int:
    """Print what is wrong with a configuration, or what it holds if nothing is.

    Parameters
    ----------
    place : str
        As for `study_of`.

    Returns
    -------
    int
        1 if there is a problem, else 0.
    """
    # Before it becomes the working folder.
    folder = "" if Path(place).is_file() or Path(place) == Path() else f" {place}"
    study = study_of(place)
    if study is None:
        return 1
    for name, sample in study.samples.items():
        if isinstance(sample, ReadSample):
            print(read_line(name, sample))
            continue
        grains = (
            "as many grains as its list" if sample.grains is None else f"{sample.grains} grains"
        )
        print(f"{name}: {sample.grading.form}, {grains}, {len(sample.seeds)} packings")
    for name, material in study.measured.items():
        print(measured_line(name, material.settings()))
    where = f" --directory{folder}" if folder else ""
    print(f"sound: branchcrush preview{folder} tells what it will be")
    print(f"       snakemake --cores 2{where} runs it")
    return 0
