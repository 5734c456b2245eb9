"""Crush the packing of a seed in LAMMPS: its grains break where they are overloaded."""

from pathlib import Path

from branchcrush.checkpoints import checkpoint_of
from branchcrush.config.sample import breakage_of, sample_of
from branchcrush.files.tables import provenance, read_packing, write_table
from branchcrush.lammps.compression import sample_variables
from branchcrush.lammps.crush import crush
from branchcrush.records import recorded_job

folder = Path(snakemake.output.path).parent
with recorded_job(snakemake) as beside:
    params, output, ranks = snakemake.params, snakemake.output, snakemake.threads
    name, seed = snakemake.wildcards.sample, int(snakemake.wildcards.seed)
    packing = read_packing(snakemake.input.packing)
    tables = crush(
        *packing,
        sample_variables(sample_of(params.sample), packing[1]),
        breakage_of(params.sample["breakage"]),
        seed=seed,
        inputs=params.inputs,
        folder=folder,
        log=snakemake.log[0],
        ranks=ranks,
        keep_dumps=params.keep_dumps,
        checkpoint=checkpoint_of(output.record),
        code=params.code,
    )
    beside += map(str, folder.glob("*.dump.gz"))
    origin = provenance(sample=name, seed=seed, ranks=ranks, config=params.sample)
    for kind, table in tables._asdict().items():
        write_table(output[kind], table, origin)
