"""Draw the curves of the crushing model from the measured exponent and elastic energy."""

from branchcrush.config.build import grading_of
from branchcrush.errors import AdmissibilityError, FitError
from branchcrush.files.tables import (
    no_data,
    provenance,
    read_json,
    read_table,
    write_json,
    write_table,
)
from branchcrush.gradings.curves import ultimate_grading
from branchcrush.jobs import job
from branchcrush.samples.ensemble import certified_loading, on_the_way_in
from branchcrush.samples.thermodynamics import crushing_curves
from branchcrush.statistics.intervals import Interval

with job(snakemake.log[0]):
    files, model = snakemake.input, snakemake.params.thermodynamics
    initial = grading_of(snakemake.params.sample["grading"])
    fit = read_json(files.fit)
    paths = [read_table(path) for path in files.paths]
    try:
        if "reason" in fit:
            raise FitError(fit["reason"])
        used, _ = certified_loading(read_table(files.certificate), paths)
        curves, summary = crushing_curves(
            on_the_way_in(paths, used),
            Interval(fit["exponent"], fit["exponent_low"], fit["exponent_high"]),
            initial,
            ultimate_grading(initial, model["ultimate_alpha"]),
            fit["reference_length_m"],
            model["critical_energy"],
            model["hardening_exponent"],
        )
    except (FitError, AdmissibilityError) as error:
        curves, summary = no_data(error)
    origin = provenance(sample=snakemake.wildcards.sample, config=model)
    write_table(snakemake.output.curves, curves, origin)
    write_json(snakemake.output.summary, summary, origin)
