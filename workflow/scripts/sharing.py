"""Measure how grains and branches share energy, force and stress, near jamming and at the end."""

from branchcrush.config.build import grading_of
from branchcrush.errors import FitError
from branchcrush.files.seeds import read_contacts
from branchcrush.files.tables import no_data, provenance, read_table, write_json, write_table
from branchcrush.jobs import job
from branchcrush.packings.contact_laws import contact_law
from branchcrush.packings.network import state_networks
from branchcrush.samples.branch_lengths import sample_classes
from branchcrush.samples.ensemble import certified_loading, named_states
from branchcrush.samples.sharing import TABLES, both_states, shared_in_state
from branchcrush.statistics.bins import bin_edges

with job(snakemake.log[0]):
    files, params = snakemake.input, snakemake.params
    grading = grading_of(params.sample["grading"])
    edges = bin_edges(*grading.support(), params.bins)
    exponent = contact_law(**params.sample["contact"]).exponent
    try:
        used, paths = certified_loading(
            read_table(files.certificate), [read_table(path) for path in files.paths]
        )
        names = named_states(paths[0])
        states = [int(paths[0]["state"].iloc[row]) for row in names.values()]
        networks = []
        for number in used:
            packing = read_contacts(files, number, vectors=True)
            if not networks:
                classes = sample_classes(grading, *packing, states[-1])
            networks.append(dict(zip(states, state_networks(*packing, states), strict=True)))
        found = {
            (where, state): shared_in_state(
                [seed[state] for seed in networks],
                edges,
                classes,
                exponent,
                **params.intervals,
            )
            for where, state in zip(names, states, strict=True)
        }
        tables, summary = both_states(found)
    except FitError as error:
        table, summary = no_data(error)
        tables = dict.fromkeys(TABLES, table)
    origin = provenance(sample=snakemake.wildcards.sample, config=params.sample)
    for name, table in tables.items():
        write_table(snakemake.output[name], table, origin)
    write_json(snakemake.output.summary, summary, origin)
