"""Write the page that a person opens."""

from pathlib import Path

from branchcrush.files.tables import read_json, write_text
from branchcrush.jobs import job
from branchcrush.study.pages import render_report

with job(snakemake.log[0]):
    samples, files = snakemake.params.samples, snakemake.input

    def of(name, paths):
        return [path for path in paths if name in Path(path).parts]

    pages = [
        {
            "name": name,
            "settings": settings,
            "fit": read_json(of(name, files.fits)[0]),
            "model": read_json(of(name, files.summaries)[0]),
            "statistics": read_json(of(name, files.statistics)[0]),
            "certificate": read_json(of(name, files.certificates)[0]),
            "grading": read_json(of(name, files.gradings)[0]),
            "figures": {Path(path).stem: path for path in of(name, files.figures)},
        }
        for name, settings in samples.items()
    ]
    html = render_report(Path(files.template).read_text(encoding="utf-8"), pages)
    write_text(snakemake.output[0], html)
