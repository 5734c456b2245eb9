"""Compare every sample with itself at twice the strain steps."""

from branchcrush.config import REFINED
from branchcrush.jobs import job
from branchcrush.report import convergence_rows
from branchcrush.tables import provenance, read_json, read_table, write_table

with job(snakemake.log[0]):
    samples, files = snakemake.params.samples, snakemake.input
    paths = {}
    for path in files.paths:
        paths.setdefault(path.split("/")[1], []).append(read_table(path))
    rows = []
    for name, steps, fit, refined in zip(
        samples, snakemake.params.steps, files.fits, files.refined, strict=True
    ):
        once = (read_json(fit), paths[name])
        twice = (read_json(refined), paths[name + REFINED])
        rows += convergence_rows(name, steps, once, twice)
    write_table(snakemake.output[0], rows, provenance(samples=samples))
