"""Draw what is fitted to a sample: energy split, branch lengths, elastic law, crushing model."""

from branchcrush.config.build import grading_of
from branchcrush.energy.fit import EnergySplitFit
from branchcrush.files.tables import read_json, read_table
from branchcrush.plotting import crushing_figures as crushing
from branchcrush.plotting import fit_figures as figures
from branchcrush.records import recorded_job
from branchcrush.samples.ensemble import stacked

with recorded_job(snakemake):
    files, output, dpi = snakemake.input, snakemake.output, snakemake.params.dpi
    split, fit = read_table(files.split), EnergySplitFit.read(read_json(files.fit))
    lengths, statistics = read_table(files.lengths), read_json(files.statistics)
    curves, forms = read_table(files.curves), read_table(files.forms)
    model = read_json(files.summary)
    paths = stacked([read_table(path) for path in files.paths])
    _, largest = grading_of(snakemake.params.sample["grading"]).support()

    figures.draw_energy_split(output.fig5_energy_split, dpi, split, fit)
    figures.draw_cubic(output.fig6_cubic, dpi, split, fit)
    figures.draw_branch_lengths(output.fig7_branch_lengths, dpi, lengths, statistics, largest)
    figures.draw_exponent_path(output.exponent_path, dpi, read_table(files.split_path), fit)
    figures.draw_predictors(output.predictors, dpi, fit, read_table(files.ratio))
    figures.draw_compression_curve(output.compression_curve, dpi, paths)
    figures.draw_loading_path(output.loading_path, dpi, paths, model)
    crushing.draw_crushing_model(output.crushing_model, dpi, forms, curves, model)
    crushing.draw_crushing_energy(output.crushing_energy, dpi, forms, model)
    crushing.draw_crushing_yield(output.crushing_yield, dpi, forms, curves, model)
    crushing.draw_crushing_path(output.crushing_path, dpi, curves, model)
