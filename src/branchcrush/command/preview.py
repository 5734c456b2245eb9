"""The preview of a study: a picture and a plan of each sample, and one text of all."""

import math
from collections.abc import Collection, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

import branchcrush
from branchcrush.command.check import measured_line, study_of
from branchcrush.config.build import size_fits, unit_of
from branchcrush.config.sample import breakage_of, sample_of
from branchcrush.errors import BranchcrushError
from branchcrush.files.memory import machine_memory
from branchcrush.files.tables import write_text
from branchcrush.gradings.curves import grading_table, ultimate_grading
from branchcrush.gradings.sampling import sampled_radii
from branchcrush.jobs import job
from branchcrush.lammps.compression import trial
from branchcrush.plotting.packing_figures import draw_preview
from branchcrush.study.preview import sample_plan
from branchcrush.study.preview_text import preview_text


def study_preview(
    samples: Mapping[str, Mapping[str, Any]],
    pictures: Mapping[str, str],
    text: str | PathLike[str],
    *,
    inputs: str | PathLike[str],
    log: str | PathLike[str],
    ultimate_alpha: float,
    dpi: int,
    cores: int,
    measured: Mapping[str, Collection[str]],
) -> str:
    """Draw the grading of every sample, write what the study will be, and return it.

    Parameters
    ----------
    samples : mapping
        By name, settings of `config.schema.Sample.settings`.
    pictures : mapping of str
        The PNG file of each sample.
    text : path-like
        The file for the text.
    inputs, log : path-like
        As for `lammps.compression.trial`.
    ultimate_alpha : float
        Of the ultimate grading [-].
    dpi : int
        Of the pictures, dots per inch.
    cores : int
        That a run will use.
    measured : mapping
        Which keys are given of each measured material, by its name.

    Returns
    -------
    str

    Raises
    ------
    GradingError
        When a file of a grading is not usable.
    """
    plans, notes = {}, {}
    compressed = {name: each for name, each in samples.items() if not each.get("packing")}
    for name, settings in compressed.items():
        sample = sample_of(settings)
        rng = np.random.default_rng(sample.seeds[0])
        radii = sampled_radii(sample.grading, sample.grains, sample.sampling, rng)
        ultimate = ultimate_grading(sample.grading, ultimate_alpha)
        table = grading_table(sample.grading, [radii], ultimate)
        unit, metres, size = unit_of(settings["grading"])
        draw_preview(pictures[name], dpi, table, unit, f"seed {sample.seeds[0]}")
        seconds = math.nan
        try:
            seconds = trial(sample, rng, inputs=inputs, folder=Path(pictures[name]).parent, log=log)
        except BranchcrushError as error:  # of grains too few for any packing
            notes[name] = str(error).splitlines()[0]
        plans[name] = sample_plan(
            sample,
            radii,
            seconds,
            ultimate,
            unit=(unit, metres),
            size=size,
            fits=size_fits(settings["grading"]),
            refused=not settings["allow_unrepresentative"],
            breakage=breakage_of(settings["breakage"]) if settings["breakage"] else None,
        )
    page = preview_text(plans, cores, pictures, notes, machine_memory()) if plans else ""
    page += "".join(
        f"{name}: read from files of another code; nothing to preview\n"
        for name in samples
        if name not in compressed
    )
    page += "".join(f"{measured_line(*material)}\n" for material in measured.items())
    write_text(text, page)
    return page


def preview(place: str, cores: int) -> int:
    """Make the preview of the study in a folder, and print it.

    Parameters
    ----------
    place : str
        As for `command.check.study_of`.
    cores : int
        That a run will use.

    Returns
    -------
    int
        1 if the configuration has a problem, else 0.

    Raises
    ------
    FileNotFoundError
        When there is no such study, or the package has no LAMMPS scripts beside it.
    """
    inputs = Path(branchcrush.__file__).parents[2] / "lammps_inputs"
    study = study_of(place, few_grains=True)
    if study is None:
        return 1
    if not inputs.is_dir():
        raise FileNotFoundError(
            f"there is no folder {inputs}: a preview needs the whole repository, installed by "
            "make or pip install -e"
        )
    log = Path("logs/preview.log")
    with job(log):
        print(
            study_preview(
                {name: sample.settings() for name, sample in study.samples.items()},
                {name: f"results/figures/{name}/preview.png" for name in study.samples},
                "results/preview.txt",
                inputs=inputs,
                log=log,
                ultimate_alpha=study.thermodynamics.ultimate_alpha,
                dpi=study.figures.dpi,
                cores=cores,
                measured={name: each.settings() for name, each in study.measured.items()},
            ),
            end="",
        )
    return 0
