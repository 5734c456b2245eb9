"""Write the target grading beside the one that the seeds realise."""

from branchcrush import gradings
from branchcrush.jobs import job
from branchcrush.tables import provenance, read_packing, write_table

with job(snakemake.log[0]):
    grading = gradings.from_parameters(**snakemake.params.sample["grading"])
    radii = [read_packing(path)[1] for path in snakemake.input.packings]
    table = gradings.grading_table(grading, radii)
    origin = provenance(sample=snakemake.wildcards.sample, config=snakemake.params.sample)
    write_table(snakemake.output[0], table, origin)
