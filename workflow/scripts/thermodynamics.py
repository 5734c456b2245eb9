"""Draw the curves of the crushing model from the measured exponent and elastic energy."""

from branchcrush import gradings
from branchcrush.crushing_curves import crushing_curves
from branchcrush.energy_split import Interval
from branchcrush.jobs import job
from branchcrush.tables import provenance, read_json, read_table, write_json, write_table

with job(snakemake.log[0]):
    model = snakemake.params.thermodynamics
    initial = gradings.from_parameters(**snakemake.params.sample["grading"])
    fit = read_json(snakemake.input.fit)
    curves, summary = crushing_curves(
        [read_table(path) for path in snakemake.input.paths],
        Interval(fit["exponent"], fit["exponent_low"], fit["exponent_high"]),
        initial,
        gradings.fractal(*initial.support(), model["ultimate_alpha"]),
        fit["reference_length_m"],
        model["critical_energy"],
        model["hardening_exponent"],
    )
    origin = provenance(sample=snakemake.wildcards.sample, config=model)
    write_table(snakemake.output.curves, curves, origin)
    write_json(snakemake.output.summary, summary, origin)
