"""Put the samples beside each other, a row each."""

from branchcrush.files.tables import provenance, read_json, write_table
from branchcrush.jobs import job
from branchcrush.study.comparison import comparison_row

with job(snakemake.log[0]):
    kinds = (snakemake.input.fits, snakemake.input.summaries, snakemake.input.certificates)
    rows = [
        comparison_row(name, *(read_json(path) for path in files))
        for name, *files in zip(snakemake.params.samples, *kinds, strict=True)
    ]
    write_table(snakemake.output[0], rows, provenance(samples=snakemake.params.samples))
