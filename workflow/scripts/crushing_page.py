"""Write the page of the samples whose grains break."""

from pathlib import Path

from branchcrush.files.tables import read_json, read_table, write_text
from branchcrush.records import recorded_job
from branchcrush.study.crushing_page import CrushingPage, render_crushing

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
        )
        for k, name in enumerate(params.samples)
    ]
    template = Path(params.template).read_text(encoding="utf-8")
    write_text(snakemake.output.page, render_crushing(template, pages))
