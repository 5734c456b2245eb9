"""Fit the energy-split function at the end of the path, and its exponent along it."""

from branchcrush import gradings
from branchcrush.energy_split import bin_edges
from branchcrush.ensemble import exponents_along_path, final_energy_split
from branchcrush.jobs import job
from branchcrush.tables import provenance, read_table, write_json, write_table

with job(snakemake.log[0]):
    settings = dict(snakemake.params.energy_split)
    sample = snakemake.params.sample
    edges = bin_edges(
        *gradings.from_parameters(**sample["grading"]).support(), settings.pop("bins")
    )
    paths = [read_table(path) for path in snakemake.input.paths]
    contacts = [read_table(path) for path in snakemake.input.contacts]
    table, fit = final_energy_split(contacts, paths, edges, **settings)
    along = exponents_along_path(contacts, paths, edges, **settings)
    origin = provenance(
        sample=snakemake.wildcards.sample,
        seeds=sample["seeds"],
        config=snakemake.params.energy_split,
    )
    write_table(snakemake.output.table, table, origin)
    write_table(snakemake.output.path, along, origin)
    write_json(snakemake.output.fit, fit, origin)
