"""Draw the grading of every sample, and tell what the study will cost on this machine."""

from pathlib import Path

import numpy as np

from branchcrush.config.build import grading_of
from branchcrush.files.tables import write_text
from branchcrush.gradings.curves import grading_table, ultimate_grading
from branchcrush.gradings.sampling import sampled_radii
from branchcrush.jobs import job
from branchcrush.lammps.compression import compression_variables, trial
from branchcrush.lammps.run import declared_variables
from branchcrush.packings.contact_laws import contact_law
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing
from branchcrush.plotting.gradings import plot_grading
from branchcrush.plotting.style import figure
from branchcrush.study.preview import preview_text, sample_plan

# A trial of more grains would take longer than it tells.
_MOST_GRAINS = 1000

with job(snakemake.log[0]):
    settings, inputs = snakemake.params, Path(snakemake.input.inputs[0]).parent
    plans = {}
    for (name, sample), path in zip(settings.samples.items(), settings.figures, strict=True):
        grading, law = grading_of(sample["grading"]), contact_law(**sample["contact"])
        rng = np.random.default_rng(sample["seeds"][0])
        radii = sampled_radii(grading, sample["grains"], sample["sampling"], rng)
        with figure(path, settings.dpi) as ax:
            ultimate = ultimate_grading(grading, settings.ultimate_alpha)
            plot_grading(grading_table(grading, [radii], ultimate), ax)
        few = sampled_radii(grading, min(sample["grains"], _MOST_GRAINS), "number_quantiles", rng)
        edge = cube_edge(few, sample["initial_solid_fraction"])
        positions = random_packing(few, edge, periodic=sample["boundary"] == "periodic", rng=rng)
        variables = compression_variables(
            few,
            sample["initial_solid_fraction"],
            boundary=sample["boundary"],
            law=law,
            loading=sample["loading"],
            strain_step=sample["strain_step"],
        )
        seconds = trial(
            positions,
            few,
            edge,
            variables,
            inputs=inputs,
            folder=Path(path).parent,
            log=snakemake.log[0],
        )
        refined = min(sample["refined_seeds"], len(sample["seeds"]))
        plans[name] = sample_plan(sample, refined, grading, law, seconds)
    time_step = declared_variables(inputs / "in.compress")["time_step"]
    text = preview_text(plans, settings.cores, time_step)
    write_text(settings.text, text)
    print(text)
