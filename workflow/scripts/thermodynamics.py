"""Draw the curves of every form of the crushing model from the measured elastic energy."""

from branchcrush.config.build import grading_of
from branchcrush.config.history import history_loads
from branchcrush.energy.fit import EnergySplitFit
from branchcrush.files.tables import provenance, read_json, read_table, write_json, write_table
from branchcrush.packings.contact_laws import contact_law
from branchcrush.records import recorded_job
from branchcrush.samples.thermodynamics import crushing_results

with recorded_job(snakemake):
    files, params = snakemake.input, snakemake.params
    results = crushing_results(
        EnergySplitFit.read(read_json(files.fit)),
        read_table(files.certificate),
        [read_table(path) for path in files.paths],
        grading_of(params.sample["grading"]),
        contact_law(**params.sample["contact"]),
        read_table(files.numbers),
        params.thermodynamics,
        read_table(files.jamming),
        history_loads(params.thermodynamics["history"]),
        params.confidence,
    )
    origin = provenance(sample=snakemake.wildcards.sample, config=params.thermodynamics)
    for name in ("curves", "forms", "events", "elastic"):
        write_table(snakemake.output[name], getattr(results, name), origin)
    write_json(snakemake.output.summary, results.summary, origin)
