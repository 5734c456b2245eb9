"""Draw all samples together."""

from branchcrush.files.tables import read_table
from branchcrush.plotting import study_figures as figures
from branchcrush.plotting.study import sample_styles
from branchcrush.records import recorded_job
from branchcrush.study.kinds import SampleKind

with recorded_job(snakemake):
    files, output, params = snakemake.input, snakemake.output, snakemake.params
    styles = sample_styles({name: SampleKind.of(s) for name, s in params.samples.items()})
    rows, states = read_table(files.rows), read_table(files.states)
    paths, branches, grains, stress, forces = (
        dict(zip(params.samples, map(read_table, files[kind]), strict=True))
        for kind in ("paths", "branches", "grains", "stress", "forces")
    )
    figures.draw_exponents(output.exponents, params.dpi, paths, styles)
    figures.draw_lengths(output.lengths, params.dpi, rows)
    figures.draw_energies(output.energies, params.dpi, rows)
    figures.draw_coordination(output.coordination, params.dpi, states, styles)
    figures.draw_shielding(output.shielding, params.dpi, branches, grains, styles)
    figures.draw_forces(output.forces, params.dpi, stress, forces, styles)
