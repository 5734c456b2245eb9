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
from branchcrush.plotting.packing_figures import draw_grading
from branchcrush.study.preview import preview_text, sample_plan

with job(snakemake.log[0]):
    params, inputs = snakemake.params, Path(snakemake.params.inputs)
    plans = {}
    for (name, settings), path in zip(params.samples.items(), params.figures, strict=True):
        sample = sample_of(settings)
        rng = np.random.default_rng(sample.seeds[0])
        radii = sampled_radii(sample.grading, sample.grains, sample.sampling, rng)
        ultimate = ultimate_grading(sample.grading, params.ultimate_alpha)
        draw_grading(path, params.dpi, grading_table(sample.grading, [radii], ultimate))
        seconds = trial(sample, rng, inputs=inputs, folder=Path(path).parent, log=snakemake.log[0])
        plans[name] = sample_plan(sample, seconds, ultimate)
    text = preview_text(
        plans, params.cores, declared_variables(inputs / "in.compress")["time_step"]
    )
    write_text(params.text, text)
    print(text)
