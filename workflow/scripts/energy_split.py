"""Fit the energy-split function at the end of the loading, and its exponent along it."""

from branchcrush.config.build import grading_of
from branchcrush.energy.fit import EnergySplitFit
from branchcrush.errors import FitError
from branchcrush.files.tables import no_data, provenance, read_table, write_json, write_table
from branchcrush.jobs import job
from branchcrush.samples.energy_split import (
    COLUMNS,
    end_state,
    exponents_along_path,
    final_energy_split,
    seed_branches,
)
from branchcrush.samples.ensemble import certified_loading
from branchcrush.statistics.bins import bin_edges

with job(snakemake.log[0]):
    files, sample = snakemake.input, snakemake.params.sample
    settings = dict(snakemake.params.energy_split)
    edges = bin_edges(*grading_of(sample["grading"]).support(), settings.pop("bins"))
    paths = [read_table(path) for path in files.paths]
    known = None
    try:
        used, paths = certified_loading(read_table(files.certificate), paths)
        branches = [
            seed_branches(read_table(files.contacts[number], COLUMNS), paths[0]["state"], edges)
            for number in used
        ]
        jamming = read_table(files.jamming)["jamming_solid_fraction_loading"].iloc[used].mean()
        known = end_state(branches, paths, jamming)
        table, fit = final_energy_split(branches, paths, edges, jamming, **settings)
        along = exponents_along_path(branches, paths, jamming, **settings)
    except FitError as error:
        table, _ = no_data(error)
        along, fit = table, EnergySplitFit.without(str(error), known).result()
    origin = provenance(
        sample=snakemake.wildcards.sample,
        seeds=sample["seeds"],
        config=snakemake.params.energy_split,
    )
    write_table(snakemake.output.table, table, origin)
    write_table(snakemake.output.path, along, origin)
    write_json(snakemake.output.fit, fit, origin)
