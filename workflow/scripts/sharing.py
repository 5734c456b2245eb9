"""Measure how grains and branches share energy, force and stress, near jamming and at the end."""

from branchcrush.config.build import grading_of
from branchcrush.files.seeds import read_contacts
from branchcrush.files.tables import provenance, read_table, write_json, write_table
from branchcrush.packings.contact_laws import contact_law
from branchcrush.records import recorded_job
from branchcrush.samples.sharing import sharing_results

with recorded_job(snakemake):
    files, params = snakemake.input, snakemake.params
    tables, summary = sharing_results(
        grading_of(params.sample["grading"]),
        contact_law(**params.sample["contact"]).exponent,
        read_table(files.certificate),
        [read_table(path) for path in files.paths],
        lambda number, states: read_contacts(files, number, vectors=True, states=states),
        bins=params.bins,
        **params.intervals,
    )
    origin = provenance(sample=snakemake.wildcards.sample, config=params.sample)
    for name, table in tables.items():
        write_table(snakemake.output[name], table, origin)
    write_json(snakemake.output.summary, summary, origin)
