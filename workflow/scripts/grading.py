"""Write the target grading beside what the seeds realise, and how well they stand for it."""

from branchcrush.config.build import grading_of
from branchcrush.files.tables import provenance, read_packing, write_json, write_table
from branchcrush.gradings.curves import grading_table, ultimate_grading
from branchcrush.gradings.representativity import representativity, representativity_report
from branchcrush.jobs import job
from branchcrush.loading.targets import Loading

with job(snakemake.log[0]):
    sample = snakemake.params.sample
    grading = grading_of(sample["grading"])
    radii = [read_packing(path)[1] for path in snakemake.input.packings]
    ultimate = ultimate_grading(grading, snakemake.params.ultimate_alpha)
    end = Loading(**sample["loading"]).end(sample["initial_solid_fraction"])
    report = representativity_report(
        representativity(grading, sample["grains"], end), grading, radii
    )
    origin = provenance(sample=snakemake.wildcards.sample, config=sample)
    write_table(snakemake.output.table, grading_table(grading, radii, ultimate), origin)
    write_json(snakemake.output.summary, report, origin)
