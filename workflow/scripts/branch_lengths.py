"""Measure the distribution of branch lengths at the end of the loading."""

from branchcrush.branch_lengths import branch_length_table, branch_statistics
from branchcrush.branches import LENGTH_COLUMNS, state_lengths
from branchcrush.energy_split import bin_edges
from branchcrush.ensemble import certified_loading
from branchcrush.errors import FitError
from branchcrush.grading_files import grading_of
from branchcrush.jobs import job
from branchcrush.tables import (
    no_data,
    provenance,
    read_packing,
    read_table,
    write_json,
    write_table,
)

with job(snakemake.log[0]):
    files, sample = snakemake.input, snakemake.params.sample
    grading = grading_of(sample["grading"])
    paths = [read_table(path) for path in files.paths]
    try:
        used, paths = certified_loading(read_table(files.certificate), paths)
        end = paths[0]["state"].iloc[-1]
        lengths = [
            state_lengths(read_table(files.contacts[number], LENGTH_COLUMNS), end)
            for number in used
        ]
        edges = bin_edges(*grading.support(), snakemake.params.bins)
        table = branch_length_table(lengths, grading, edges)
        statistics = branch_statistics(
            [read_packing(files.packings[number])[1] for number in used],
            lengths,
            [path["volume_m3"].iloc[-1] for path in paths],
            [path["coordination_number"].iloc[-1] for path in paths],
            grading,
        )
    except FitError as error:
        table, statistics = no_data(error)
    origin = provenance(sample=snakemake.wildcards.sample, config=sample)
    write_table(snakemake.output.table, table, origin)
    write_json(snakemake.output.statistics, statistics, origin)
