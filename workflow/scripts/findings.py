"""Put the findings of all samples beside each other, a row each, and all their states."""

import pandas as pd

from branchcrush.exponent_paths import common_distance
from branchcrush.findings import coordination_rows, finding_row
from branchcrush.jobs import job
from branchcrush.tables import provenance, read_json, read_table, write_table

with job(snakemake.log[0]):
    files, samples = snakemake.input, snakemake.params.samples
    paths = [read_table(path) for path in files.paths]
    distance = common_distance([path for path in paths if "reason" not in path])
    loading, states, rows = iter(files.loading), [], []
    for number, (name, sample) in enumerate(samples.items()):
        seeds = [read_table(next(loading)) for _ in sample["seeds"]]
        jamming = read_table(files.jamming[number])["jamming_solid_fraction_loading"]
        states.append(coordination_rows(name, seeds, jamming))
        results = (read_json(files[kind][number]) for kind in ("fits", "numbers", "shared"))
        rows.append(finding_row(name, sample, *results, paths[number], states[-1], distance))
    along = [path.assign(sample=name) for name, path in zip(samples, paths, strict=True)]
    origin = provenance(samples=list(samples))
    write_table(snakemake.output.rows, rows, origin)
    write_table(snakemake.output.exponents, pd.concat(along, ignore_index=True), origin)
    write_table(snakemake.output.states, pd.concat(states, ignore_index=True), origin)
