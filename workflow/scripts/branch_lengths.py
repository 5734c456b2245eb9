"""Measure who touches whom along the loading, and the branch lengths, beside what is predicted."""

from branchcrush.branches.lengths import branch_length_table, branch_statistics
from branchcrush.branches.predictions import binned_predictions, fine_edges, predictions
from branchcrush.config.build import grading_of
from branchcrush.errors import FitError
from branchcrush.files.seeds import read_contacts
from branchcrush.files.tables import no_data, provenance, read_table, write_json, write_table
from branchcrush.jobs import job
from branchcrush.samples.branch_lengths import (
    contact_number_rows,
    coordination_table,
    length_prediction_rows,
    sample_classes,
    seed_contacts,
    touching_summary,
)
from branchcrush.samples.ensemble import certified_loading, mean_path
from branchcrush.statistics.bins import bin_edges

with job(snakemake.log[0]):
    files, params = snakemake.input, snakemake.params
    grading = grading_of(params.sample["grading"])
    try:
        used, paths = certified_loading(
            read_table(files.certificate), [read_table(path) for path in files.paths]
        )
        states = paths[0]["state"].to_list()
        classes = sample_classes(grading, *read_contacts(files, used[0]), states[-1])
        seeds = [
            seed_contacts(grading, classes, *read_contacts(files, number), states)
            for number in used
        ]
        jamming = read_table(files.jamming)["jamming_solid_fraction_loading"].iloc[used]
        fine, path = fine_edges(*grading.support()), mean_path(paths, jamming.mean())
        models = predictions(grading, fine)
        rows = length_prediction_rows(seeds, models, fine, path, **params.intervals)
        numbers, pairs = contact_number_rows(seeds, models, classes, path, **params.intervals)
        coordination = coordination_table(seeds, paths, jamming)
        touching = touching_summary(seeds, models, rows, path, **params.intervals)

        lengths, edges = [seed.length for seed in seeds], bin_edges(*grading.support(), params.bins)
        table = branch_length_table(lengths, grading, edges, binned_predictions(models, edges))
        statistics = branch_statistics(
            [seed.radius for seed in seeds],
            lengths,
            [path["volume_m3"].iloc[-1] for path in paths],
            [path["coordination_number"].iloc[-1] for path in paths],
            grading,
        )
    except FitError as error:
        table, statistics = no_data(error)
        rows, numbers, pairs, coordination, touching = *[table] * 4, statistics
    origin = provenance(sample=snakemake.wildcards.sample, config=params.sample)
    for name, result in (
        ("table", table),
        ("predictions", rows),
        ("numbers", numbers),
        ("pairs", pairs),
        ("coordination", coordination),
    ):
        write_table(snakemake.output[name], result, origin)
    write_json(snakemake.output.statistics, statistics, origin)
    write_json(snakemake.output.touching, touching, origin)
