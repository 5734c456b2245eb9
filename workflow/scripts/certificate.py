"""Judge every saved state, and find the jamming point of every packing."""

from branchcrush.files.tables import provenance, read_packing, read_table, write_table
from branchcrush.jobs import job
from branchcrush.loading.states import stress_floor
from branchcrush.packings.contact_laws import contact_law
from branchcrush.samples.certificate import jamming_points, state_certificates

with job(snakemake.log[0]):
    sample, files = snakemake.params.sample, snakemake.input
    law, seeds = contact_law(**sample["contact"]), sample["seeds"]
    paths = [read_table(path) for path in files.paths]
    floors = [stress_floor(read_packing(path)[1], law) for path in files.packings]
    steps = [read_table(path) for path in files.steps]
    points = jamming_points(seeds, steps, paths, law.exponent, floors)
    origin = provenance(sample=snakemake.wildcards.sample, config=sample)
    write_table(snakemake.output.states, state_certificates(seeds, paths), origin)
    write_table(snakemake.output.jamming, points, origin)
