"""Put the crushing of all seeds of a sample together, beside laws and forms of the model."""

from functools import partial

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.files.tables import provenance, read_json, read_table, write_json, write_table
from branchcrush.packings.contact_laws import contact_law
from branchcrush.records import recorded_job
from branchcrush.samples.crushed import crushed_results, read_crushing
from branchcrush.samples.crushed_sizes import Crushable

with recorded_job(snakemake):
    files, params = snakemake.input, snakemake.params
    breakage, settings = params.sample["breakage"], dict(params.thermodynamics)
    law = contact_law(**params.sample["contact"])
    sample = Crushable(
        breakage["smallest_diameter"],
        breakage["size_exponent"],
        settings.pop("ultimate_alpha"),
        law,
    )
    settings["exponent"] = EnergySplitFit.read(read_json(files.fit)).exponent.estimate
    seeds = params.sample["seeds"]
    runs, halved = (
        {
            seed: partial(read_crushing, read_table, *of_seed)
            for seed, *of_seed in zip(numbers, *tables, strict=True)
        }
        for numbers, tables in (
            (seeds, (files.paths, files.grains, files.contacts)),
            (params.halved, (files.halved_paths, files.halved_grains, files.halved_contacts)),
        )
    )
    controls = {seed: read_table(path) for seed, path in zip(seeds, files.controls, strict=True)}
    results = crushed_results(runs, halved, controls, sample, settings, params.intervals)
    origin = provenance(sample=snakemake.wildcards.sample, config=params.sample)
    for name in ("states", "means", "gradings", "lengths", "line", "beside"):
        write_table(snakemake.output[name], getattr(results, name), origin)
    write_json(snakemake.output.summary, results.summary, origin)
