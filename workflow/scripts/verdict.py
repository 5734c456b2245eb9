"""Say whether the sample is certified, and why or why not."""

from branchcrush.certificate import sample_certificate
from branchcrush.jobs import job
from branchcrush.tables import provenance, read_json, read_table, write_json
from branchcrush.unloading import unloading_summary

with job(snakemake.log[0]):
    files = snakemake.input
    paths, jamming = [read_table(path) for path in files.paths], read_table(files.jamming)
    certificate = sample_certificate(
        read_table(files.states),
        paths,
        jamming,
        read_table(files.convergence),
        read_json(files.grading),
    )
    certificate["unloading"] = unloading_summary(paths, jamming)
    origin = provenance(sample=snakemake.wildcards.sample, config=snakemake.params.sample)
    write_json(snakemake.output[0], certificate, origin)
