"""Draw what the crushing of a sample shows."""

from branchcrush.files.tables import provenance, read_json, read_table, write_json
from branchcrush.packings.contact_laws import contact_law
from branchcrush.plotting import crushed_figures as figures
from branchcrush.plotting.crushed_lengths import draw_lengths
from branchcrush.plotting.crushing_predicted import draw_crushing_predicted
from branchcrush.records import recorded_job
from branchcrush.study.viewer_states import packing_view

with recorded_job(snakemake):
    files, output, dpi = snakemake.input, snakemake.output, snakemake.params.dpi
    tables = {name: read_table(files[name]) for name in snakemake.params.tables}
    summary, prediction = read_json(files.summary), read_json(files.prediction)
    controls = [read_table(path) for path in files.controls]
    grains, path = read_table(files.grains[0]), read_table(files.path[0])

    figures.draw_line(output.crushed_line, dpi, tables, controls, summary)
    figures.draw_gradings(output.crushed_gradings, dpi, tables["gradings"], summary)
    draw_lengths(output.crushed_lengths, dpi, tables["lengths"], summary)
    figures.draw_energy(output.crushed_energy, dpi, tables["means"], summary)
    figures.draw_measures(output.crushed_measures, dpi, tables["means"], tables["beside"], summary)
    figures.draw_forms(output.crushed_forms, dpi, tables["means"], tables["beside"], controls)
    predictions = tables["predicted"], tables["beside_predicted"], prediction["reason"]
    draw_crushing_predicted(output.crushed_predicted, dpi, *predictions)
    figures.draw_packing(output.crushed_packing, dpi, grains, path, summary)
    sample = snakemake.params.sample
    view = packing_view(
        grains,
        path,
        read_table(files.contacts[0]),
        read_table(files.walls[0]),
        contact_exponent=contact_law(**sample["contact"]).exponent,
        periodic=sample["boundary"] == "periodic",
        views=snakemake.params.views,
    )
    origin = provenance(sample=snakemake.wildcards.sample, config=sample)
    write_json(output.view, view, origin)
