"""Write the page that a person opens."""

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.files.tables import read_json, read_table, write_text
from branchcrush.records import recorded_job
from branchcrush.study.pages import (
    SamplePage,
    finding_records,
    page_template,
    render_findings,
    render_report,
)

with recorded_job(snakemake):
    files, params = snakemake.input, snakemake.params
    rows = read_table(files.rows)
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
            row=row,
            view=read_json(view),
        )
        for (name, settings), (fit, *others), figures, forms, row, view in zip(
            params.samples.items(),
            results,
            drawn,
            files.forms,
            finding_records(rows),
            files.views,
            strict=True,
        )
    ]
    report, findings = (page_template(path, params.glossary) for path in params.templates)
    shown = {name: files[f"findings_{name}"] for name in params.findings}
    together = render_findings(findings, rows, shown) if len(pages) > 1 else ""
    write_text(snakemake.output[0], render_report(report, pages, together, params.measured))
