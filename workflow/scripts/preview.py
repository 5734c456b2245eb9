"""Draw the grading of every sample, and tell what the study will cost on this machine."""

from pathlib import Path

from branchcrush.command.preview import study_preview
from branchcrush.jobs import job

with job(snakemake.log[0]):
    params = snakemake.params
    text = study_preview(
        params.samples,
        dict(zip(params.samples, params.figures, strict=True)),
        params.text,
        inputs=Path(params.inputs),
        log=snakemake.log[0],
        ultimate_alpha=params.ultimate_alpha,
        dpi=params.dpi,
        cores=params.cores,
        measured=params.measured,
    )
    print(text, end="")
