"""Draw the figures of a sample."""

from branchcrush import gradings
from branchcrush.ensemble import stacked
from branchcrush.jobs import job
from branchcrush.lammps_files import read_dump
from branchcrush.plotting import crushing, distributions, energy, loading
from branchcrush.plotting.spheres import plot_packing
from branchcrush.plotting.style import SIZE, figure
from branchcrush.tables import read_json, read_packing, read_table

WIDE = (2 * SIZE[0], SIZE[1])

with job(snakemake.log[0]):
    files, output, dpi = snakemake.input, snakemake.output, snakemake.params.dpi
    fit, summary = read_json(files.fit), read_json(files.summary)
    split, model = read_table(files.split), read_table(files.curves)
    path = stacked([read_table(seed) for seed in files.paths])
    _, radius_max = gradings.from_parameters(**snakemake.params.sample["grading"]).support()

    with figure(output.fig3_grading, dpi) as ax:
        distributions.plot_grading(read_table(files.grading), ax)

    # The first seed, before and after, to one scale.
    positions, radii, edge = read_packing(files.packings[0])
    end = read_dump(files.particles[0])[-1]
    final_edge = path[path["seed_number"] == 0]["volume_m3"].iloc[-1] ** (1 / 3)
    with figure(output.fig4_packing, dpi, WIDE, (1, 2)) as (before, after):
        plot_packing(positions, radii, edge, extent=edge, radius_max=radius_max, ax=before)
        places = end[["x", "y", "z"]].to_numpy()
        plot_packing(
            places,
            end["radius"].to_numpy(),
            final_edge,
            extent=edge,
            radius_max=radius_max,
            ax=after,
        )
        ends = path[path["seed_number"] == 0]["solid_fraction"]
        before.set_title(rf"placed at random, $\phi$ = {ends.iloc[0]:.3f}")
        after.set_title(rf"compressed, $\phi$ = {ends.iloc[-1]:.3f}")

    with figure(output.fig5_energy_split, dpi) as ax:
        energy.plot_energy_split(split, fit, ax)
    with figure(output.fig6_cubic, dpi) as ax:
        energy.plot_cubic(split, fit, ax)
    with figure(output.fig7_branch_lengths, dpi) as ax:
        table, statistics = read_table(files.lengths), read_json(files.statistics)
        distributions.plot_branch_lengths(table, statistics, radius_max, ax)
    with figure(output.exponent_path, dpi) as ax:
        energy.plot_exponent_path(read_table(files.split_path), fit, ax)

    with figure(output.loading_path, dpi, (2 * SIZE[0], 2 * SIZE[1]), (2, 2)) as panels:
        loading.plot_mean_stress(path, panels[0, 0])
        loading.plot_energy_balance(path, panels[0, 1])
        loading.plot_coordination(path, panels[1, 0])
        loading.plot_elastic_law(path, summary, panels[1, 1])

    with figure(output.crushing_model, dpi, (2 * SIZE[0], 3 * SIZE[1]), (3, 2)) as panels:
        crushing.plot_reference_energy(model, panels[0, 0])
        crushing.plot_family(
            model, "free_energy_J_per_m3", r"free energy $\Psi$ [MJ/m³]", panels[0, 1]
        )
        crushing.plot_family(model, "stress_Pa", r"mean stress $\sigma$ [MPa]", panels[1, 0])
        crushing.plot_crushing(model, summary, panels[1, 1])
        crushing.plot_driving_force(model, panels[2, 0])
        crushing.plot_dissipation(model, panels[2, 1])
