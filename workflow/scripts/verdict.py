"""Hold the first seeds against those at twice the strain steps, and judge the sample."""

from branchcrush.config.build import grading_of
from branchcrush.energy.fit import EnergySplitFit
from branchcrush.files.tables import provenance, read_json, read_table, write_json, write_table
from branchcrush.records import recorded_job
from branchcrush.samples.certificate import limits_of
from branchcrush.samples.seed_branches import ENERGY_COLUMNS
from branchcrush.samples.verdict import Refined, verdict_results

with recorded_job(snakemake):
    sample, files = snakemake.params.sample, snakemake.input
    refined = None
    if files.refined_paths:
        refined = Refined(
            read_table(files.refined_states[0]),
            read_table(files.refined_jamming[0]),
            [read_table(path) for path in files.refined_paths],
            lambda number, state: read_table(
                files.refined_contacts[number], ENERGY_COLUMNS, [state]
            ),
        )
    convergence, certificate = verdict_results(
        grading_of(sample["grading"]),
        read_table(files.states),
        read_table(files.jamming),
        [read_table(path) for path in files.paths],
        refined=refined,
        report=read_json(files.grading),
        fit=EnergySplitFit.read(read_json(files.fit)),
        bins=snakemake.params.bins,
        limits=limits_of(sample["packing"]),
        readings=[read_json(path) for path in files.readings],
    )
    origin = provenance(sample=snakemake.wildcards.sample, config=sample)
    write_table(snakemake.output.convergence, convergence, origin)
    write_json(snakemake.output.certificate, certificate, origin)
