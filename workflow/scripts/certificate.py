"""Judge every saved state, and find the jamming point of every packing."""

from branchcrush.files.tables import provenance, read_packing, read_table, write_table
from branchcrush.packings.contact_laws import contact_law
from branchcrush.records import recorded_job
from branchcrush.samples.certificate import certificate_tables, limits_of

with recorded_job(snakemake):
    sample, files = snakemake.params.sample, snakemake.input
    states, points = certificate_tables(
        contact_law(**sample["contact"]),
        sample["seeds"],
        [read_table(path) for path in files.paths],
        [read_table(path) for path in files.steps],
        [read_packing(path)[1] for path in files.packings],
        limits_of(sample["packing"]),
    )
    origin = provenance(sample=snakemake.wildcards.sample, config=sample)
    write_table(snakemake.output.states, states, origin)
    write_table(snakemake.output.jamming, points, origin)
