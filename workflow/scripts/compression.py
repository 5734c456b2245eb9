"""Compress one packing in LAMMPS."""

from pathlib import Path

from branchcrush.contact_law import contact_law
from branchcrush.jobs import job
from branchcrush.simulation import compress, compression_variables
from branchcrush.tables import provenance, read_packing, write_table

with job(snakemake.log[0]):
    sample, seed = snakemake.params.sample, int(snakemake.wildcards.seed)
    positions, radii, edge = read_packing(snakemake.input.packing)
    variables = compression_variables(
        radii,
        sample["initial_solid_fraction"],
        boundary=sample["boundary"],
        law=contact_law(**sample["contact"]),
        loading=sample["loading"],
        strain_step=sample["strain_step"],
    )
    result = compress(
        positions,
        radii,
        edge,
        variables,
        inputs=Path(snakemake.input.inputs[0]).parent,
        folder=Path(snakemake.output.path).parent,
        log=snakemake.log[0],
    )
    origin = provenance(sample=snakemake.wildcards.sample, seed=seed, config=sample)
    for name, table in result._asdict().items():
        write_table(snakemake.output[name], table, origin)
