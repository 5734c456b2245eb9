"""Write the page of what a laboratory measured."""

from branchcrush.files.tables import read_json, write_text
from branchcrush.records import recorded_job
from branchcrush.study.measured_page import MeasuredPage, render_measured
from branchcrush.study.templates import page_template

with recorded_job(snakemake):
    files, params = snakemake.input, snakemake.params
    fits = dict(zip(params.compressed, zip(files.fits, files.curves, strict=True), strict=True))
    pages = []
    for name, breakage, drawn in zip(
        params.materials, files.breakages, files.gradings, strict=True
    ):
        fit, figure = fits.get(name, (None, None))
        compression = fit and read_json(fit)
        pages.append(MeasuredPage(name, read_json(breakage), drawn, compression, figure))
    template = page_template(params.template, params.glossary)
    write_text(snakemake.output.page, render_measured(template, pages))
