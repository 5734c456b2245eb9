"""Write the page that a person opens."""

from pathlib import Path

from branchcrush.files.tables import write_text
from branchcrush.records import recorded_job
from branchcrush.results.package import Package
from branchcrush.results.sample import Sample
from branchcrush.results.study import Study
from branchcrush.study.pages import SamplePage, finding_records, render_findings, render_report
from branchcrush.study.templates import page_template

with recorded_job(snakemake):
    params = snakemake.params
    package = Package(Path(snakemake.output[0]).parent)
    rows = Study(package).findings.data
    records = zip(params.samples.items(), finding_records(rows), strict=True)
    pages = [
        SamplePage.of(Sample(package, sample=name), settings, params.figures, row)
        for (name, settings), row in records
    ]
    report, findings = (page_template(path, params.glossary) for path in params.templates)
    figures = {name: package.figure("findings", name) for name in params.findings}
    together = render_findings(findings, rows, figures) if len(pages) > 1 else ""
    write_text(snakemake.output[0], render_report(report, pages, together, params.measured))
