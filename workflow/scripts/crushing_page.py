"""Write the page of the samples whose grains break."""

from branchcrush.files.tables import read_json, read_table, write_text
from branchcrush.records import recorded_job
from branchcrush.study.crushing_page import CrushingPage, render_crushing
from branchcrush.study.templates import page_template

with recorded_job(snakemake):
    files, params = snakemake.input, snakemake.params
    pages = [
        CrushingPage(
            name,
            read_json(files.summaries[k]),
            {figure: files[figure][k] for figure in params.figures},
            read_table(files.means[k]),
            read_table(files.beside[k]),
            read_json(files.grains[k])["sentences"],
            read_json(files.predicted[k]),
            read_json(files.views[k]),
        )
        for k, name in enumerate(params.samples)
    ]
    template = page_template(params.template, params.glossary)
    write_text(snakemake.output.page, render_crushing(template, pages))
