"""Particle crushing seen through branch lengths: pack, compress, and split the elastic energy.

The package holds the science; the Snakefile beside it holds the study, and `open_study` reads what
that wrote.

>>> import branchcrush
>>> branchcrush.__version__.count(".")
2
"""

from importlib import import_module
from os import PathLike
from typing import Any

__version__ = "0.1.0"


def open_study(folder: str | PathLike[str] = "results") -> Any:
    """Return the results of a study, which are read when they are asked for.

    Parameters
    ----------
    folder : path-like
        The folder `results` that a run wrote, or the folder of the study that holds it.

    Returns
    -------
    branchcrush.results.study.Study

    Raises
    ------
    branchcrush.errors.ResultsError
        When there are no results in the folder.

    Examples
    --------
    >>> open_study("nowhere")
    Traceback (most recent call last):
    branchcrush.errors.ResultsError: nowhere is no folder: ...
    """
    # By its name: every module takes the version from here, and none shall load pandas by that.
    return import_module("branchcrush.results.study").Study.opened(folder)
