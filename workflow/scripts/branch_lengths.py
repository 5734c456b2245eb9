"""Measure who touches whom along the loading, and the branch lengths, beside what is predicted."""

from branchcrush.config.build import grading_of
from branchcrush.files.seeds import read_contacts
from branchcrush.files.tables import provenance, read_table, write_json, write_table
from branchcrush.records import recorded_job
from branchcrush.samples.branch_lengths import branch_length_results

with recorded_job(snakemake):
    files, params = snakemake.input, snakemake.params
    tables, results = branch_length_results(
        grading_of(params.sample["grading"]),
        read_table(files.certificate),
        [read_table(path) for path in files.paths],
        read_table(files.jamming),
        lambda number: read_contacts(files, number),
        bins=params.bins,
        **params.intervals,
    )
    origin = provenance(sample=snakemake.wildcards.sample, config=params.sample)
    for name, table in tables.items():
        write_table(snakemake.output[name], table, origin)
    for name, result in results.items():
        write_json(snakemake.output[name], result, origin)
