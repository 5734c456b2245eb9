"""Tell how far crushing came between two gradings that a laboratory measured."""

from branchcrush.config.build import grading_of
from branchcrush.files.tables import provenance, write_json, write_table
from branchcrush.plotting.measured import draw_gradings
from branchcrush.records import recorded_job
from branchcrush.samples.measured import breakage_results, grading_curves, ultimate_of

with recorded_job(snakemake):
    output, material = snakemake.output, snakemake.params.material
    before = grading_of(material["before"])
    after = material["after"] and grading_of(material["after"])
    way = {key: material[key] for key in ("ultimate_alpha", "ultimate_smallest")}
    ultimate = ultimate_of(before, *way.values())
    curves = grading_curves({"before": before, "after": after, "ultimate": ultimate})
    origin = provenance(material=snakemake.wildcards.material, config=material)
    write_table(output.curves, curves, origin)
    write_json(output.breakage, breakage_results(before, after, **way), origin)
    draw_gradings(output.figure, snakemake.params.dpi, curves)
