"""Compress one packing in LAMMPS."""

from pathlib import Path

from branchcrush.jobs import job
from branchcrush.simulation import compress, compression_variables
from branchcrush.tables import provenance, read_packing, write_table

with job(snakemake.log[0]):
    sample, seed = snakemake.params.sample, int(snakemake.wildcards.seed)
    positions, radii, edge = read_packing(snakemake.input.packing)
    variables = compression_variables(
        radii, edge, boundary=sample["boundary"], **sample["contact"], **sample["loading"]
    )
    path, contacts, walls = compress(
        positions,
        radii,
        edge,
        variables,
        inputs=Path(snakemake.input.inputs[0]).parent,
        folder=Path(snakemake.output.path).parent,
        log=snakemake.log[0],
    )
    origin = provenance(sample=snakemake.wildcards.sample, seed=seed, config=sample)
    write_table(snakemake.output.contacts, contacts, origin)
    write_table(snakemake.output.walls, walls, origin)
    write_table(snakemake.output.path, path, origin)
