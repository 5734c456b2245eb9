"""Draw the radii of a seed, place the grains at random, and compress them in LAMMPS."""

from pathlib import Path

import numpy as np

from branchcrush.config.build import grading_of
from branchcrush.files.tables import provenance, write_packing, write_table
from branchcrush.gradings.sampling import sampled_radii
from branchcrush.jobs import job
from branchcrush.lammps.compression import compress, compression_variables
from branchcrush.lammps.files import write_data_file
from branchcrush.packings.contact_laws import contact_law
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing

with job(snakemake.log[0]):
    sample, seed = snakemake.params.sample, int(snakemake.wildcards.seed)
    output, fraction = snakemake.output, sample["initial_solid_fraction"]
    name, ranks = snakemake.wildcards.sample, snakemake.threads
    origin = provenance(sample=name, seed=seed, ranks=ranks, config=sample)

    rng = np.random.default_rng(seed)
    radii = sampled_radii(grading_of(sample["grading"]), sample["grains"], sample["sampling"], rng)
    edge, periodic = cube_edge(radii, fraction), sample["boundary"] == "periodic"
    positions = random_packing(radii, edge, periodic=periodic, rng=rng)
    write_packing(output.packing, positions, radii, edge, origin)
    write_data_file(output.data, positions, radii, edge)

    variables = compression_variables(
        radii,
        fraction,
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
        folder=Path(output.path).parent,
        log=snakemake.log[0],
        ranks=ranks,
    )
    for name, table in result._asdict().items():
        write_table(output[name], table, origin)
