"""Write the target grading beside what the seeds realise, and how well they stand for it."""

from branchcrush.config.build import grading_of, size_fits
from branchcrush.config.sample import number_of_grains
from branchcrush.files.tables import provenance, read_packing, write_json, write_table
from branchcrush.loading.targets import Loading
from branchcrush.records import recorded_job
from branchcrush.samples.grading import grading_results

with recorded_job(snakemake):
    sample = snakemake.params.sample
    table, report = grading_results(
        grading_of(sample["grading"]),
        number_of_grains(sample),
        Loading(**sample["loading"]).end(sample["initial_solid_fraction"]),
        [read_packing(path)[1] for path in snakemake.input.packings],
        ultimate_alpha=snakemake.params.ultimate_alpha,
        fits=size_fits(sample["grading"]),
    )
    origin = provenance(sample=snakemake.wildcards.sample, config=sample)
    write_table(snakemake.output.table, table, origin)
    write_json(snakemake.output.summary, report, origin)
