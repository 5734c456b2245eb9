"""Draw the packings of a sample: their grading, two states, the loading path, the certificate."""

from itertools import islice

from branchcrush.config.build import grading_of
from branchcrush.files.tables import read_json, read_packing, read_table
from branchcrush.jobs import job
from branchcrush.lammps.files import read_dump
from branchcrush.plotting import packing_figures as figures
from branchcrush.samples.ensemble import end_of_loading, stacked

with job(snakemake.log[0]):
    files, output, dpi = snakemake.input, snakemake.output, snakemake.params.dpi
    paths = [read_table(path) for path in files.paths]
    states, jamming = read_table(files.states), read_table(files.jamming)
    # The first seed, before and after.
    packing, last = read_packing(files.packings[0]), int(end_of_loading(paths[0])["state"])
    frame = next(islice(read_dump(files.particles[0]), last, None))
    _, largest = grading_of(snakemake.params.sample["grading"]).support()

    figures.draw_grading(output.fig3_grading, dpi, read_table(files.grading))
    figures.draw_packing(output.fig4_packing, dpi, packing, frame, paths[0], largest)
    figures.draw_loading_path(output.loading_path, dpi, stacked(paths), read_json(files.summary))
    figures.draw_certificate(output.certificate, dpi, states, jamming, read_json(files.certificate))
