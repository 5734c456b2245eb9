"""Compare the first seeds with themselves at twice the strain steps."""

from branchcrush.convergence import convergence_table
from branchcrush.energy_split import bin_edges
from branchcrush.grading_files import grading_of
from branchcrush.jobs import job
from branchcrush.tables import provenance, read_table, write_table

with job(snakemake.log[0]):
    sample, files = snakemake.params.sample, snakemake.input
    edges = bin_edges(*grading_of(sample["grading"]).support(), snakemake.params.bins)
    certificates = [read_table(path) for path in files.certificates]
    runs = [
        [[read_table(path) for path in files[f"{run}{kind}"]] for kind in ("paths", "contacts")]
        for run in ("", "refined_")
    ]
    table = convergence_table(certificates, *runs, edges)
    origin = provenance(sample=snakemake.wildcards.sample, config=sample)
    write_table(snakemake.output[0], table, origin)
