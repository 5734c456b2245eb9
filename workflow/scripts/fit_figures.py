"""Draw what is fitted to a sample: the energy split, branch lengths, and the crushing model."""

from branchcrush.config.build import grading_of
from branchcrush.files.tables import read_json, read_table
from branchcrush.jobs import job
from branchcrush.plotting import branches, crushing, energy, predictors
from branchcrush.plotting.style import SIZE, drawn, figure

with job(snakemake.log[0]):
    files, output, dpi = snakemake.input, snakemake.output, snakemake.params.dpi
    fit, summary = read_json(files.fit), read_json(files.summary)
    split, model = read_table(files.split), read_table(files.curves)
    _, radius_max = grading_of(snakemake.params.sample["grading"]).support()

    with figure(output.fig5_energy_split, dpi) as ax:
        drawn(energy.plot_energy_split, fit, split, fit, ax=ax)
    with figure(output.fig6_cubic, dpi) as ax:
        drawn(energy.plot_cubic, fit, split, fit, ax=ax)
    with figure(output.fig7_branch_lengths, dpi) as ax:
        table, statistics = read_table(files.lengths), read_json(files.statistics)
        drawn(branches.plot_branch_lengths, statistics, table, statistics, radius_max, ax=ax)
    with figure(output.exponent_path, dpi) as ax:
        drawn(energy.plot_exponent_path, fit, read_table(files.split_path), fit, ax=ax)
    with figure(output.predictors, dpi, (2 * SIZE[0], SIZE[1]), (1, 2)) as panels:
        drawn(predictors.plot_predictors, fit, fit, ax=panels[0])
        drawn(predictors.plot_slopes, fit, fit, ax=panels[1])

    with figure(output.crushing_model, dpi, (2 * SIZE[0], 3 * SIZE[1]), (3, 2)) as panels:
        free, stress = r"free energy $\Psi$ [MJ/m³]", r"mean stress $\sigma$ [MPa]"
        for ax, plot, *data in (
            (panels[0, 0], crushing.plot_reference_energy, model),
            (panels[0, 1], crushing.plot_family, model, "free_energy_J_per_m3", free),
            (panels[1, 0], crushing.plot_family, model, "stress_Pa", stress),
            (panels[1, 1], crushing.plot_crushing, model, summary),
            (panels[2, 0], crushing.plot_driving_force, model),
            (panels[2, 1], crushing.plot_dissipation, model),
        ):
            drawn(plot, summary, *data, ax=ax)
