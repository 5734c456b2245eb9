"""Draw the figures of a sample."""

from branchcrush.certificate import OVERLAP_FLAG
from branchcrush.ensemble import end_of_loading, stacked
from branchcrush.grading_files import grading_of
from branchcrush.jobs import job
from branchcrush.lammps_files import read_dump
from branchcrush.plotting import certificate, crushing, distributions, energy, loading
from branchcrush.plotting.spheres import plot_packing
from branchcrush.plotting.style import SIZE, figure, reason
from branchcrush.tables import read_json, read_packing, read_table

WIDE, SQUARE = (2 * SIZE[0], SIZE[1]), (2 * SIZE[0], 2 * SIZE[1])


def drawn(plot, result, *data, ax):
    """Draw a result, or say why there is none."""
    return reason(ax, result["reason"]) if "reason" in result else plot(*data, ax=ax)


with job(snakemake.log[0]):
    files, output, dpi = snakemake.input, snakemake.output, snakemake.params.dpi
    fit, summary = read_json(files.fit), read_json(files.summary)
    split, model = read_table(files.split), read_table(files.curves)
    paths = [read_table(path) for path in files.paths]
    path = stacked(paths)
    _, radius_max = grading_of(snakemake.params.sample["grading"]).support()

    with figure(output.fig3_grading, dpi) as ax:
        distributions.plot_grading(read_table(files.grading), ax)

    # The first seed, before and after, to one scale.
    positions, radii, edge = read_packing(files.packings[0])
    last = end_of_loading(paths[0])
    end = read_dump(files.particles[0])[int(last["state"])]
    with figure(output.fig4_packing, dpi, WIDE, (1, 2)) as (before, after):
        plot_packing(positions, radii, edge, extent=edge, radius_max=radius_max, ax=before)
        plot_packing(
            end[["x", "y", "z"]].to_numpy(),
            end["radius"].to_numpy(),
            last["volume_m3"] ** (1 / 3),
            extent=edge,
            radius_max=radius_max,
            ax=after,
        )
        before.set_title(rf"placed at random, $\phi$ = {paths[0]['solid_fraction'][0]:.3f}")
        after.set_title(rf"compressed, $\phi$ = {last['solid_fraction']:.3f}")

    with figure(output.fig5_energy_split, dpi) as ax:
        drawn(energy.plot_energy_split, fit, split, fit, ax=ax)
    with figure(output.fig6_cubic, dpi) as ax:
        drawn(energy.plot_cubic, fit, split, fit, ax=ax)
    with figure(output.fig7_branch_lengths, dpi) as ax:
        table, statistics = read_table(files.lengths), read_json(files.statistics)
        drawn(distributions.plot_branch_lengths, statistics, table, statistics, radius_max, ax=ax)
    with figure(output.exponent_path, dpi) as ax:
        drawn(energy.plot_exponent_path, fit, read_table(files.split_path), fit, ax=ax)

    with figure(output.loading_path, dpi, SQUARE, (2, 2)) as panels:
        loading.plot_mean_stress(path, panels[0, 0])
        loading.plot_energy_balance(path, panels[0, 1])
        loading.plot_coordination(path, panels[1, 0])
        drawn(loading.plot_elastic_law, summary, path, summary, ax=panels[1, 1])

    with figure(output.certificate, dpi, SQUARE, (2, 2)) as panels:
        states, verdict = read_table(files.states), read_json(files.certificate)
        certificate.plot_rest(states, verdict["limits"], panels[0, 0])
        certificate.plot_overlaps(states, OVERLAP_FLAG, panels[0, 1])
        certificate.plot_dissipation(states, panels[1, 0])
        certificate.plot_jamming(read_table(files.jamming), panels[1, 1])

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
