"""Put the samples beside each other, a row each, and describe all files of the study."""

from pathlib import Path

from branchcrush.files.datapackage import data_package
from branchcrush.files.encoding import json_page
from branchcrush.files.machine import machine, software
from branchcrush.files.tables import study_provenance, write_json, write_table, write_text
from branchcrush.records import recorded_job
from branchcrush.results.package import Package
from branchcrush.results.sample import Sample
from branchcrush.study.comparison import comparison_row

with recorded_job(snakemake):
    output, params, samples = snakemake.output, snakemake.params, snakemake.params.samples
    study = Package(Path(output.table).parent)
    rows = [
        comparison_row(one.name, one.fit, one.thermodynamics.summary, one.certificate.summary)
        for one in (Sample(study, sample=name) for name in samples)
    ]
    origin = study_provenance(samples)
    write_table(output.table, rows, origin)
    seeds = {name: sample["seeds"] for name, sample in samples.items()}
    package = data_package(seeds, params.run_again, params.measured, params.breaking, params.read)
    write_json(output.package, package, {**origin, "software": software(), "machine": machine()})
    write_text(output.config, json_page(params.config))
