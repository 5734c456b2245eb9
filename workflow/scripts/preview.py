"""Draw the grading of every sample, and tell what the study will cost on this machine."""

from pathlib import Path

import numpy as np

from branchcrush.config.build import sample_of
from branchcrush.files.tables import write_text
from branchcrush.gradings.curves import grading_table, ultimate_grading
from branchcrush.gradings.sampling import sampled_radii
from branchcrush.jobs import job
from branchcrush.lammps.compression import trial
from branchcrush.lammps.run import declared_variables
from branchcrush.plotting.gradings import plot_grading
from branchcrush.plotting.style import figure
from branchcrush.study.preview import preview_text, sample_plan

with job(snakemake.log[0]):
    settings, inputs = snakemake.params, Path(snakemake.input.inputs[0]).parent
    plans = {}
    for (name, plain), path in zip(settings.samples.items(), settings.figures, strict=True):
        sample = sample_of(plain)
        rng = np.random.default_rng(sample.seeds[0])
        radii = sampled_radii(sample.grading, sample.grains, sample.sampling, rng)
        with figure(path, settings.dpi) as ax:
            ultimate = ultimate_grading(sample.grading, settings.ultimate_alpha)
            plot_grading(grading_table(sample.grading, [radii], ultimate), ax)
        seconds = trial(sample, rng, inputs=inputs, folder=Path(path).parent, log=snakemake.log[0])
        plans[name] = sample_plan(sample, seconds)
    time_step = declared_variables(inputs / "in.compress")["time_step"]
    text = preview_text(plans, settings.cores, time_step)
    write_text(settings.text, text)
    print(text)
