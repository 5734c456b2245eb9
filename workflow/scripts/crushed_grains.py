"""Tell who breaks and who survives in all seeds of a sample, and how energy is split meanwhile."""

from branchcrush.files.seeds import read_contacts
from branchcrush.files.tables import provenance, read_table, write_json, write_table
from branchcrush.records import recorded_job
from branchcrush.samples.crushed_grains import crushed_grains

with recorded_job(snakemake):
    files, sample = snakemake.input, snakemake.params.sample
    kinds = ("crushed_paths", "grains", "crushed_contacts", "crushed_walls", "breakages")
    results = crushed_grains(
        sample["seeds"],
        lambda number: tuple(read_table(getattr(files, kind)[number]) for kind in kinds),
        lambda number: (read_table(files.paths[number]), *read_contacts(files, number)),
        sample["breakage"],
        **snakemake.params.intervals,
    )
    origin = provenance(sample=snakemake.wildcards.sample, config=sample)
    *tables, _ = results._fields
    for name in tables:
        write_table(snakemake.output[name], getattr(results, name), origin)
    write_json(snakemake.output.summary, results.summary, origin)
