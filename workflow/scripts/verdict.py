"""Compare the first seeds with themselves at twice the strain steps, and judge the sample."""

from branchcrush.config.build import grading_of
from branchcrush.energy.fit import EnergySplitFit
from branchcrush.files.tables import provenance, read_json, read_table, write_json, write_table
from branchcrush.records import recorded_job
from branchcrush.samples.seed_branches import ENERGY_COLUMNS
from branchcrush.samples.verdict import verdict_results

with recorded_job(snakemake):
    sample, files = snakemake.params.sample, snakemake.input
    convergence, certificate = verdict_results(
        grading_of(sample["grading"]),
        read_table(files.states),
        read_table(files.jamming),
        [read_table(path) for path in files.all_paths],
        refined_states=[read_table(path) for path in files.refined_states],
        once=(
            [read_table(path) for path in files.paths],
            lambda number, state: read_table(files.contacts[number], ENERGY_COLUMNS, [state]),
        ),
        twice=(
            [read_table(path) for path in files.refined_paths],
            lambda number, state: read_table(
                files.refined_contacts[number], ENERGY_COLUMNS, [state]
            ),
        ),
        report=read_json(files.grading),
        fit=EnergySplitFit.read(read_json(files.fit)),
        bins=snakemake.params.bins,
    )
    origin = provenance(sample=snakemake.wildcards.sample, config=sample)
    write_table(snakemake.output.convergence, convergence, origin)
    write_json(snakemake.output.certificate, certificate, origin)
