"""Draw the packings of a sample: grading, two states, certificate, and who touches and carries."""

from itertools import chain

from branchcrush.config.build import grading_of
from branchcrush.files.tables import provenance, read_json, read_packing, read_table, write_json
from branchcrush.lammps.files import read_dump
from branchcrush.packings.contact_laws import contact_law
from branchcrush.plotting import network_figures as networks
from branchcrush.plotting import packing_figures as figures
from branchcrush.records import kept_dump, recorded_job
from branchcrush.study.viewer_states import packing_view, saved_grains

with recorded_job(snakemake):
    files, output, params = snakemake.input, snakemake.output, snakemake.params
    path, packing, dpi = read_table(files.path[0]), read_packing(files.packing[0]), params.dpi
    # The first seed, before and after.
    compressed = read_table(files.compressed[0])
    states, jamming = read_table(files.states), read_table(files.jamming)
    numbers, shared = read_json(files.numbers), read_json(files.shared)
    tables = {name: read_table(files[name]) for name in params.tables}
    _, largest = grading_of(params.sample["grading"]).support()

    figures.draw_grading(output.fig3_grading, dpi, read_table(files.grading))
    # Of a packing that another code made.
    reading = next(map(read_json, files.reading), None)
    drawn = packing, compressed, path, largest
    figures.draw_packing(output.fig4_packing, dpi, *drawn, reading=reading)
    figures.draw_certificate(output.certificate, dpi, states, jamming, read_json(files.certificate))
    networks.draw_who_touches_whom(output.who_touches_whom, dpi, numbers, tables, largest)
    networks.draw_sharing(output.sharing, dpi, shared, tables, largest)
    contacts = read_table(files.contacts[0])
    networks.draw_chains(output.force_chains, dpi, compressed, contacts, path, reading)
    networks.draw_rose(output.contact_rose, dpi, contacts, path)

    frames = chain.from_iterable(map(read_dump, kept_dump(files.path[0], snakemake)))
    view = packing_view(
        saved_grains(frames, packing, compressed, path),
        path,
        contacts,
        read_table(files.walls[0]),
        contact_exponent=contact_law(**params.sample["contact"]).exponent,
        periodic=params.sample["boundary"] == "periodic",
        views=params.views,
        reading=reading,
    )
    origin = provenance(sample=snakemake.wildcards.sample, config=params.sample)
    write_json(output.view, view, origin)
