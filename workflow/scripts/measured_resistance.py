"""Fit the resistance to crushing to a compression curve that a laboratory measured."""

from branchcrush.config.build import compression_of, grading_of
from branchcrush.files.tables import provenance, write_json, write_table
from branchcrush.packings.contact_laws import contact_law
from branchcrush.plotting.measured import draw_compression
from branchcrush.records import recorded_job
from branchcrush.samples.measured import ultimate_of
from branchcrush.samples.measured_resistance import resistance_results

with recorded_job(snakemake):
    output, material = snakemake.output, snakemake.params.material
    test = material["compression"]
    before, table = grading_of(material["before"]), compression_of(test)
    curve, line, summary = resistance_results(
        table.stress,
        table.strain,
        before,
        ultimate_of(before, material["ultimate_alpha"], material["ultimate_smallest"]),
        law=contact_law(**test["contact"]),
        initial_void_ratio=test.get("initial_void_ratio"),
        **{key: test[key] for key in ("lateral_stress_ratio", "share_of_affine")},
    )
    origin = provenance(material=snakemake.wildcards.material, config=material)
    write_table(output.curve, curve, origin)
    write_table(output.line, line, origin)
    write_json(output.summary, {**summary, "remarks": table.remarks}, origin)
    draw_compression(output.figure, snakemake.params.dpi, curve, line, summary.get("reason"))
