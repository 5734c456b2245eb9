"""Draw the contact network of a sample: who touches whom, and who carries what."""

from branchcrush.config.build import grading_of
from branchcrush.files.tables import read_json, read_table
from branchcrush.jobs import job
from branchcrush.plotting import network_figures as figures

with job(snakemake.log[0]):
    files, output, params = snakemake.input, snakemake.output, snakemake.params
    numbers, shared = read_json(files.numbers), read_json(files.shared)
    tables = {name: read_table(files[name]) for name in params.tables}
    _, largest = grading_of(params.sample["grading"]).support()

    figures.draw_who_touches_whom(output.who_touches_whom, params.dpi, numbers, tables, largest)
    figures.draw_sharing(output.sharing, params.dpi, shared, tables, largest)
