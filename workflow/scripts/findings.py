"""Put the findings of all samples beside each other, a row each, and all their states."""

import pandas as pd

from branchcrush.files.tables import provenance, read_json, read_table, write_table
from branchcrush.jobs import job
from branchcrush.study.exponents import common_distance
from branchcrush.study.findings import finding_row
from branchcrush.study.kinds import SampleKind

with job(snakemake.log[0]):
    files, samples = snakemake.input, snakemake.params.samples
    intervals = snakemake.params.intervals
    paths = [read_table(path) for path in files.paths]
    distance = common_distance([path for path in paths if "reason" not in path])
    states = [read_table(path) for path in files.states]
    rows = [
        finding_row(
            name, SampleKind.of(sample), *map(read_json, results), path, table, distance, intervals
        )
        for (name, sample), *results, path, table in zip(
            samples.items(), files.fits, files.numbers, files.shared, paths, states, strict=True
        )
    ]

    def together(tables):
        named = [t.assign(sample=name) for name, t in zip(samples, tables, strict=True)]
        return pd.concat(named, ignore_index=True)

    origin = provenance(samples=list(samples))
    write_table(snakemake.output.rows, rows, origin)
    write_table(snakemake.output.exponents, together(paths), origin)
    write_table(snakemake.output.states, together(states), origin)
