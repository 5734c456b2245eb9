"""Write the target grading beside what the seeds realise, and how well they stand for it."""

from branchcrush.config.build import grading_of, size_fits
from branchcrush.config.sample import number_of_grains
from branchcrush.files.tables import provenance, read_packing, write_json, write_table
from branchcrush.loading.targets import Loading
from branchcrush.records import recorded_job
from branchcrush.samples.grading import grading_results, mean_packing

with recorded_job(snakemake):
    sample = snakemake.params.sample
    packings = [read_packing(path) for path in snakemake.input.packings]
    if sample["packing"]:
        asked = mean_packing(packings)
    else:
        end = Loading(**sample["loading"]).end(sample["initial_solid_fraction"])
        asked = number_of_grains(sample), end
    table, report = grading_results(
        grading_of(sample["grading"]),
        *asked,
        [radii for _, radii, _ in packings],
        ultimate_alpha=snakemake.params.ultimate_alpha,
        fits=size_fits(sample["grading"]),
    )
    origin = provenance(sample=snakemake.wildcards.sample, config=sample)
    write_table(snakemake.output.table, table, origin)
    write_json(snakemake.output.summary, report, origin)
