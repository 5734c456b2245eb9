"""Put the samples beside each other, a row each."""

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.files.tables import read_json, study_provenance, write_table
from branchcrush.records import recorded_job
from branchcrush.study.comparison import comparison_row

with recorded_job(snakemake):
    files, samples = snakemake.input, snakemake.params.samples
    rows = [
        comparison_row(name, EnergySplitFit.read(read_json(fit)), *map(read_json, others))
        for name, fit, *others in zip(
            samples, files.fits, files.summaries, files.certificates, strict=True
        )
    ]
    write_table(snakemake.output[0], rows, study_provenance(samples))
