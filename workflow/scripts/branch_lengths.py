"""Measure the distribution of branch lengths at the end of the loading path."""

from branchcrush import gradings
from branchcrush.branch_lengths import branch_length_table, branch_statistics
from branchcrush.energy_split import bin_edges
from branchcrush.ensemble import final_branches
from branchcrush.jobs import job
from branchcrush.tables import provenance, read_packing, read_table, write_json, write_table

with job(snakemake.log[0]):
    grading = gradings.from_parameters(**snakemake.params.sample["grading"])
    radii = [read_packing(path)[1] for path in snakemake.input.packings]
    ends = [read_table(path).iloc[-1] for path in snakemake.input.paths]
    lengths = final_branches([read_table(path) for path in snakemake.input.contacts])
    edges = bin_edges(*grading.support(), snakemake.params.bins)
    origin = provenance(sample=snakemake.wildcards.sample, config=snakemake.params.sample)
    write_table(snakemake.output.table, branch_length_table(lengths, grading, edges), origin)
    volumes = [end["volume_m3"] for end in ends]
    kappa = [end["coordination_number"] for end in ends]
    statistics = branch_statistics(radii, lengths, volumes, kappa, grading)
    write_json(snakemake.output.statistics, statistics, origin)
