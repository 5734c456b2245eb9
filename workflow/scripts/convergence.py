"""Compare the first seeds with themselves at twice the strain steps."""

from branchcrush.branches import ENERGY_COLUMNS, state_sums
from branchcrush.convergence import convergence_table
from branchcrush.energy_split import bin_edges
from branchcrush.ensemble import end_of_loading
from branchcrush.grading_files import grading_of
from branchcrush.jobs import job
from branchcrush.tables import provenance, read_table, write_table

with job(snakemake.log[0]):
    sample, files = snakemake.params.sample, snakemake.input
    edges = bin_edges(*grading_of(sample["grading"]).support(), snakemake.params.bins)
    certificates = [read_table(path) for path in files.certificates]
    runs = []
    for run in ("", "refined_"):
        paths = [read_table(path) for path in files[f"{run}paths"]]
        sums = [
            state_sums(read_table(table, ENERGY_COLUMNS), end_of_loading(path)["state"], edges)
            for path, table in zip(paths, files[f"{run}contacts"], strict=True)
        ]
        runs.append((paths, sums))
    table = convergence_table(certificates, *runs)
    origin = provenance(sample=snakemake.wildcards.sample, config=sample)
    write_table(snakemake.output[0], table, origin)
