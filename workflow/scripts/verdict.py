"""Compare the first seeds with themselves at twice the strain steps, and judge the sample."""

from branchcrush.config.build import grading_of
from branchcrush.files.tables import provenance, read_json, read_table, write_json, write_table
from branchcrush.jobs import job
from branchcrush.samples.certificate import sample_certificate
from branchcrush.samples.convergence import convergence_table
from branchcrush.samples.energy_split import ENERGY_COLUMNS, state_sums
from branchcrush.samples.ensemble import end_of_loading
from branchcrush.samples.unloading import unloading_summary
from branchcrush.statistics.bins import bin_edges

with job(snakemake.log[0]):
    sample, files = snakemake.params.sample, snakemake.input
    edges = bin_edges(*grading_of(sample["grading"]).support(), snakemake.params.bins)
    states, jamming = read_table(files.states), read_table(files.jamming)
    all_paths = [read_table(path) for path in files.all_paths]
    runs = []
    for run in ("", "refined_"):
        paths = [read_table(path) for path in files[f"{run}paths"]]
        sums = [
            state_sums(read_table(table, ENERGY_COLUMNS), end_of_loading(path)["state"], edges)
            for path, table in zip(paths, files[f"{run}contacts"], strict=True)
        ]
        runs.append((paths, sums))
    refined = [read_table(path) for path in files.refined_states]
    convergence = convergence_table([states, *refined] if refined else [], *runs)
    certificate = sample_certificate(
        states, all_paths, jamming, convergence, read_json(files.grading)
    )
    certificate["unloading"] = unloading_summary(all_paths, jamming)
    origin = provenance(sample=snakemake.wildcards.sample, config=sample)
    write_table(snakemake.output.convergence, convergence, origin)
    write_json(snakemake.output.certificate, certificate, origin)
