"""Draw the curves of the crushing model from the measured exponent and elastic energy."""

from branchcrush.config.build import grading_of
from branchcrush.energy.fit import EnergySplitFit
from branchcrush.files.tables import provenance, read_json, read_table, write_json, write_table
from branchcrush.records import recorded_job
from branchcrush.samples.thermodynamics import crushing_results

with recorded_job(snakemake):
    files, model = snakemake.input, snakemake.params.thermodynamics
    curves, summary = crushing_results(
        EnergySplitFit.read(read_json(files.fit)),
        read_table(files.certificate),
        [read_table(path) for path in files.paths],
        grading_of(snakemake.params.sample["grading"]),
        **model,
    )
    origin = provenance(sample=snakemake.wildcards.sample, config=model)
    write_table(snakemake.output.curves, curves, origin)
    write_json(snakemake.output.summary, summary, origin)
