"""Fit the energy-split function at the end of the loading, and its exponent along it."""

from branchcrush.config.build import grading_of
from branchcrush.files.tables import provenance, read_table, write_json, write_table
from branchcrush.records import recorded_job
from branchcrush.samples.energy_split import energy_split_results
from branchcrush.samples.seed_branches import COLUMNS

with recorded_job(snakemake):
    files, params = snakemake.input, snakemake.params
    tables, fit = energy_split_results(
        grading_of(params.sample["grading"]),
        read_table(files.certificate),
        [read_table(path) for path in files.paths],
        read_table(files.jamming),
        lambda number: read_table(files.contacts[number], COLUMNS),
        **params.energy_split,
    )
    origin = provenance(
        sample=snakemake.wildcards.sample,
        seeds=params.sample["seeds"],
        config=params.energy_split,
    )
    for name, table in tables.items():
        write_table(snakemake.output[name], table, origin)
    write_json(snakemake.output.fit, fit.result(), origin)
