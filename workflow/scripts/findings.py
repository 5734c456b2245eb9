"""Put the findings of all samples beside each other, a row each, and all their states."""

from pathlib import Path

from branchcrush.files.tables import stacked_tables, study_provenance, write_table
from branchcrush.records import recorded_job
from branchcrush.results.package import Package
from branchcrush.results.sample import Sample
from branchcrush.study.findings import finding_rows
from branchcrush.study.results import SampleResults

with recorded_job(snakemake):
    output, params = snakemake.output, snakemake.params
    study = Package(Path(output.rows).parent)
    samples = [
        SampleResults.of(Sample(study, sample=name), settings)
        for name, settings in params.samples.items()
    ]
    origin = study_provenance(params.samples, **params.intervals)
    write_table(output.rows, finding_rows(samples, **params.intervals), origin)
    paths, states = ({one.name: getattr(one, k) for one in samples} for k in ("path", "states"))
    write_table(output.exponents, stacked_tables(paths), origin)
    write_table(output.states, stacked_tables(states), origin)
