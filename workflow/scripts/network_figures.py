"""Draw the contact network of a sample: who touches whom, and who carries what."""

from branchcrush.config.build import grading_of
from branchcrush.files.tables import read_json, read_table
from branchcrush.jobs import job
from branchcrush.plotting import branches, forces, shielding
from branchcrush.plotting.style import SIZE, drawn, figure

with job(snakemake.log[0]):
    files, output, dpi = snakemake.input, snakemake.output, snakemake.params.dpi
    numbers, shared = read_json(files.numbers), read_json(files.shared)
    by_branch = shared if "reason" in shared else shared["end"]["shielding"]["branches"]
    _, largest = grading_of(snakemake.params.sample["grading"]).support()

    def draw(panels, plots):
        for ax, (plot, result, table, *data) in zip(panels.flat, plots, strict=True):
            drawn(plot, result, read_table(files[table]), *data, ax=ax)

    with figure(output.who_touches_whom, dpi, (2 * SIZE[0], 2 * SIZE[1]), (2, 2)) as panels:
        draw(
            panels,
            (
                (branches.plot_contact_numbers, numbers, "contact_numbers", numbers, largest),
                (branches.plot_pairs, numbers, "contact_pairs", numbers, largest),
                (branches.plot_distances, numbers, "predictions"),
                (branches.plot_mean_lengths, numbers, "predictions", largest),
            ),
        )
    with figure(output.sharing, dpi, (2 * SIZE[0], 4 * SIZE[1]), (4, 2)) as panels:
        panels.flat[-1].set_axis_off()
        draw(
            panels.flat[:-1],
            (
                (shielding.plot_branch_shielding, by_branch, "shielding_branches", shared),
                (shielding.plot_grain_shielding, shared, "shielding_grains"),
                (forces.plot_force_distribution, shared, "force_distribution", shared),
                (forces.plot_force_by_length, shared, "force_by_length", shared, largest),
                (forces.plot_stress_by_radius, shared, "stress_by_radius", largest),
                (forces.plot_stress_sharing, shared, "stress_sharing", shared),
                (forces.plot_fabric, shared, "fabric", shared),
            ),
        )
