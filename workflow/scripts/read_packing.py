"""Read a packing that another code made, as the states of a compression."""

from branchcrush.files.tables import provenance, write_json, write_packing, write_table
from branchcrush.packings.contact_laws import contact_law
from branchcrush.readers.packing import read_frames
from branchcrush.readers.report import reading_report
from branchcrush.readers.sources import source_of
from branchcrush.readers.states import first_packing, packing_tables
from branchcrush.records import recorded_job

with recorded_job(snakemake):
    files, output, sample = snakemake.input, snakemake.output, snakemake.params.sample
    name, seed = snakemake.wildcards.sample, int(snakemake.wildcards.seed)
    origin = provenance(sample=name, seed=seed, config=sample)
    law = contact_law(**sample["contact"])
    source = source_of(sample["packing"], files.grains, files.contacts, sample["boundary"])
    read = read_frames(source)
    write_packing(output.packing, *first_packing(read), origin)
    for kind, table in packing_tables(read, law)._asdict().items():
        write_table(output[kind], table, origin)
    write_json(output.report, reading_report(read, law, [*files.grains, *files.contacts]), origin)
