"""Predict the crushing of a sample without a simulation, beside the simulated one."""

from branchcrush.config.build import grading_of
from branchcrush.config.sample import breakage_of
from branchcrush.files.tables import provenance, read_table, write_json, write_table
from branchcrush.packings.contact_laws import contact_law
from branchcrush.records import recorded_job
from branchcrush.samples.crushing_predicted import measured_states
from branchcrush.samples.crushing_prediction import crushing_prediction

with recorded_job(snakemake):
    files, output, sample = snakemake.input, snakemake.output, snakemake.params.sample
    law, rules = contact_law(**sample["contact"]), breakage_of(sample["breakage"])
    measured = {
        seed: measured_states(
            read_table(path), read_table(grains, columns=["state", "radius_m"]), rules, law
        )
        for seed, path, grains in zip(sample["seeds"], files.paths, files.grains, strict=True)
    }
    results = crushing_prediction(
        grading_of(sample["grading"]),
        law,
        rules,
        measured,
        walls=sample["boundary"] == "walls",
        confidence=snakemake.params.confidence,
    )
    origin = provenance(sample=snakemake.wildcards.sample, config=sample)
    write_table(output.predicted, results.predicted, origin)
    write_table(output.beside, results.beside, origin)
    write_json(output.summary, results.summary, origin)
