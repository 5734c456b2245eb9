"""Put the findings of all samples beside each other, a row each, and all their states."""

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.files.tables import (
    read_json,
    read_table,
    stacked_tables,
    study_provenance,
    write_table,
)
from branchcrush.records import recorded_job
from branchcrush.study.findings import finding_rows
from branchcrush.study.kinds import SampleKind
from branchcrush.study.results import SampleResults

with recorded_job(snakemake):
    files, output, params = snakemake.input, snakemake.output, snakemake.params
    fits = [EnergySplitFit.read(read_json(path)) for path in files.fits]
    numbers, shared, certificates = (
        [read_json(path) for path in files[k]] for k in ("numbers", "shared", "certificates")
    )
    paths, states = ([read_table(path) for path in files[k]] for k in ("paths", "states"))
    kinds = map(SampleKind.of, params.samples.values())
    results = zip(
        params.samples, kinds, fits, numbers, shared, certificates, paths, states, strict=True
    )
    rows = finding_rows([SampleResults(*each) for each in results], **params.intervals)
    origin = study_provenance(params.samples, **params.intervals)
    write_table(output.rows, rows, origin)
    for path, tables in ((output.exponents, paths), (output.states, states)):
        write_table(path, stacked_tables(dict(zip(params.samples, tables, strict=True))), origin)
