"""Draw the radii of a seed, place the grains at random, and compress them in LAMMPS."""

from pathlib import Path

import numpy as np

from branchcrush.checkpoints import checkpoint_of
from branchcrush.config.sample import sample_of
from branchcrush.files.tables import provenance, write_packing, write_table
from branchcrush.lammps.compression import compress, placed_packing, sample_variables
from branchcrush.lammps.files import write_data_file
from branchcrush.records import recorded_job

folder = Path(snakemake.output.path).parent
with recorded_job(snakemake) as beside:
    params, output, ranks = snakemake.params, snakemake.output, snakemake.threads
    name, seed = snakemake.wildcards.sample, int(snakemake.wildcards.seed)
    origin = provenance(sample=name, seed=seed, ranks=ranks, config=params.sample)
    sample = sample_of(params.sample)
    packing = placed_packing(sample, np.random.default_rng(seed))
    write_packing(output.packing, *packing, origin)
    write_data_file(output.data, *packing)
    tables = compress(
        *packing,
        sample_variables(sample, packing.radii),
        inputs=params.inputs,
        folder=folder,
        log=snakemake.log[0],
        ranks=ranks,
        keep_dumps=params.keep_dumps,
        checkpoint=checkpoint_of(output.record),
        code=params.code,
    )
    beside += map(str, folder.glob("*.dump.gz"))
    for kind, table in tables._asdict().items():
        write_table(output[kind], table, origin)
