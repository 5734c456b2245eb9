"""Draw who breaks in a sample, and how energy is split meanwhile."""

from branchcrush.files.tables import read_table
from branchcrush.plotting.crushed_grains import draw_split_of_crushed, draw_who_breaks
from branchcrush.records import recorded_job

with recorded_job(snakemake):
    files, output, dpi = snakemake.input, snakemake.output, snakemake.params.dpi
    who = (read_table(path) for path in (files.areas, files.curves, files.hazards))
    draw_who_breaks(output.who_breaks, dpi, *who)
    draw_split_of_crushed(
        output.split_of_crushed, dpi, read_table(files.exponents), read_table(files.loads)
    )
