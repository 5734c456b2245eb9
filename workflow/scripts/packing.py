"""Draw the radii of a seed and place the grains at random."""

import numpy as np

from branchcrush.grading_files import grading_of
from branchcrush.jobs import job
from branchcrush.lammps_files import write_data_file
from branchcrush.packing import cube_edge, random_packing
from branchcrush.sampling import sampled_radii
from branchcrush.tables import provenance, write_packing

with job(snakemake.log[0]):
    sample, seed = snakemake.params.sample, int(snakemake.wildcards.seed)
    rng = np.random.default_rng(seed)
    radii = sampled_radii(grading_of(sample["grading"]), sample["grains"], sample["sampling"], rng)
    edge = cube_edge(radii, sample["initial_solid_fraction"])
    periodic = sample["boundary"] == "periodic"
    positions = random_packing(radii, edge, periodic=periodic, rng=rng)
    origin = provenance(sample=snakemake.wildcards.sample, seed=seed, config=sample)
    write_packing(snakemake.output.packing, positions, radii, edge, origin)
    write_data_file(snakemake.output.data, positions, radii, edge)
