"""Put the samples beside each other, a row each, and describe all files of the study."""

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.files.datapackage import data_package
from branchcrush.files.tables import read_json, study_provenance, write_json, write_table
from branchcrush.records import recorded_job
from branchcrush.study.comparison import comparison_row

with recorded_job(snakemake):
    files, params, samples = snakemake.input, snakemake.params, snakemake.params.samples
    rows = [
        comparison_row(name, EnergySplitFit.read(read_json(fit)), *map(read_json, others))
        for name, fit, *others in zip(
            samples, files.fits, files.summaries, files.certificates, strict=True
        )
    ]
    origin = study_provenance(samples)
    write_table(snakemake.output.table, rows, origin)
    seeds = {name: sample["seeds"] for name, sample in samples.items()}
    package = data_package(seeds, params.run_again, params.measured, params.breaking, params.read)
    write_json(snakemake.output.package, package, origin)
