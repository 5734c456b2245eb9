"""Draw the packings of a sample: their grading, two states, the loading path, the certificate."""

from itertools import islice

import numpy as np

from branchcrush.config.build import grading_of
from branchcrush.files.tables import read_json, read_packing, read_table
from branchcrush.jobs import job
from branchcrush.lammps.files import read_dump
from branchcrush.packings.contact_laws import OVERLAP_FLAG
from branchcrush.plotting import certificate, gradings, loading
from branchcrush.plotting.packings import plot_packing
from branchcrush.plotting.style import SIZE, drawn, figure
from branchcrush.samples.ensemble import end_of_loading, stacked

WIDE, SQUARE = (2 * SIZE[0], SIZE[1]), (2 * SIZE[0], 2 * SIZE[1])

with job(snakemake.log[0]):
    files, output, dpi = snakemake.input, snakemake.output, snakemake.params.dpi
    paths = [read_table(path) for path in files.paths]
    path = stacked(paths)

    with figure(output.fig3_grading, dpi) as ax:
        gradings.plot_grading(read_table(files.grading), ax)

    # The first seed, before and after, to one scale.
    positions, radii, edge = read_packing(files.packings[0])
    last = end_of_loading(paths[0])
    end = next(islice(read_dump(files.particles[0]), int(last["state"]), None))
    _, radius_max = grading_of(snakemake.params.sample["grading"]).support()
    with figure(output.fig4_packing, dpi, WIDE, (1, 2)) as (before, after):
        plot_packing(positions, radii, edge, extent=edge, radius_max=radius_max, ax=before)
        plot_packing(
            np.column_stack([end[axis] for axis in "xyz"]),
            end["radius"],
            last["volume_m3"] ** (1 / 3),
            extent=edge,
            radius_max=radius_max,
            ax=after,
        )
        before.set_title(rf"placed at random, $\phi$ = {paths[0]['solid_fraction'][0]:.3f}")
        after.set_title(rf"compressed, $\phi$ = {last['solid_fraction']:.3f}")

    with figure(output.loading_path, dpi, SQUARE, (2, 2)) as panels:
        summary = read_json(files.summary)
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
