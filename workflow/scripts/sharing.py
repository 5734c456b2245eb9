"""Measure how grains and branches share energy, force and stress, near jamming and at the end."""

from itertools import islice

from branchcrush.contact_law import contact_law
from branchcrush.energy_split import bin_edges
from branchcrush.ensemble import certified_loading
from branchcrush.errors import FitError
from branchcrush.fabric import branch_vectors
from branchcrush.grading_files import grading_of
from branchcrush.jobs import job
from branchcrush.lammps_files import read_dump
from branchcrush.networks import state_network
from branchcrush.seed_files import read_contacts
from branchcrush.sharing import TABLES, both_states, shared_in_state
from branchcrush.tables import no_data, provenance, read_table, write_json, write_table
from branchcrush.touching import sample_classes


def frame_of(dump, state):
    return next(islice(read_dump(dump), state, None))


with job(snakemake.log[0]):
    files, params = snakemake.input, snakemake.params
    grading = grading_of(params.sample["grading"])
    edges = bin_edges(*grading.support(), params.bins)
    exponent = contact_law(**params.sample["contact"]).exponent
    try:
        used, paths = certified_loading(
            read_table(files.certificate), [read_table(path) for path in files.paths]
        )
        last = int(paths[0]["state"].iloc[-1])
        classes = sample_classes(grading, *read_contacts(files, used[0]), last)
        found = {}
        for where, row in (("near_jamming", 0), ("end", -1)):
            state = int(paths[0]["state"].iloc[row])
            found[where, state] = shared_in_state(
                [state_network(*read_contacts(files, number), state) for number in used],
                [branch_vectors(frame_of(files.pairs[number], state)) for number in used],
                edges,
                classes,
                exponent,
                **params.intervals,
            )
        tables, summary = both_states(found)
    except FitError as error:
        table, summary = no_data(error)
        tables = dict.fromkeys(TABLES, table)
    origin = provenance(sample=snakemake.wildcards.sample, config=params.sample)
    for name, table in tables.items():
        write_table(snakemake.output[name], table, origin)
    write_json(snakemake.output.summary, summary, origin)
