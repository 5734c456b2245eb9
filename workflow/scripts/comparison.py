"""Put the samples beside each other, a row each."""

from branchcrush.jobs import job
from branchcrush.report import comparison_row
from branchcrush.tables import provenance, read_json, write_table

with job(snakemake.log[0]):
    files = zip(
        snakemake.params.samples, snakemake.input.fits, snakemake.input.summaries, strict=True
    )
    rows = [comparison_row(name, read_json(fit), read_json(model)) for name, fit, model in files]
    write_table(snakemake.output[0], rows, provenance(samples=snakemake.params.samples))
