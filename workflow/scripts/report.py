"""Write the page that a person opens."""

from pathlib import Path

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.files.tables import read_json, read_table, write_text
from branchcrush.records import recorded_job
from branchcrush.study.pages import SamplePage, render_report

with recorded_job(snakemake):
    files, params = snakemake.input, snakemake.params
    # Files of every kind are in the order of the samples.
    names = ("fits", "summaries", "statistics", "certificates", "gradings")
    results = zip(*(map(read_json, files[name]) for name in names), strict=True)
    drawn = zip(*(files[name] for name in params.figures), strict=True)
    pages = [
        SamplePage(
            name,
            settings,
            EnergySplitFit.read(fit),
            *others,
            figures=dict(zip(params.figures, figures, strict=True)),
            forms=read_table(forms),
        )
        for (name, settings), (fit, *others), figures, forms in zip(
            params.samples.items(), results, drawn, files.forms, strict=True
        )
    ]
    template = Path(params.template).read_text(encoding="utf-8")
    write_text(snakemake.output[0], render_report(template, pages, params.measured))
