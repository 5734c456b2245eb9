"""What the rules share: the settings of a sample, its files, and the code a job depends on."""

from functools import cache
from pathlib import Path

from branchcrush.config.gradings import grading_data_files
from branchcrush.config.names import REFINED
from branchcrush.config.packing_files import frame_files
from branchcrush.config.sample import breakage_of, sample_of
from branchcrush.files.dictionary import dictionary_digest
from branchcrush.source_files import source_digest
from branchcrush.study.cost import packing_request, reading_request

# Of this project: a workflow that uses it as a module has another basedir.
ROOT = Path(workflow.current_basedir).parents[1]
SAMPLES = {name: sample.settings() for name, sample in SETTINGS.samples.items()}
# The first seeds again with twice the strain steps, for the certificate's convergence.
REFINED_SAMPLES = {
    name + REFINED: sample.settings(refinement=2)
    for name, sample in SETTINGS.samples.items()
    if sample.refined_seeds
}
# Packings that another code made: read, not compressed here.
READ = {name for name, sample in SAMPLES.items() if sample["packing"]}
# What a laboratory measured, by name of the material.
MEASURED = {name: material.settings() for name, material in SETTINGS.measured.items()}
# Of every interval from resampling seeds.
INTERVALS = {key: getattr(SETTINGS.energy_split, key) for key in ("confidence", "resamples")}


wildcard_constraints:
    sample="|".join(map(re.escape, [*SAMPLES, *REFINED_SAMPLES])),
    seed=r"\d+",
    material="|".join(map(re.escape, MEASURED)) or "none",


def settings_of(wildcards):
    return {**SAMPLES, **REFINED_SAMPLES}[wildcards.sample]


def section(*keys):
    """Return a params function for some keys of the sample, as plain values."""

    def values(wildcards, input):
        chosen = {key: settings_of(wildcards)[key] for key in keys}
        if "grading" in chosen and wildcards.sample in READ:
            # Of the grains themselves, wherever a module's prefix puts them.
            chosen["grading"] = {**chosen["grading"], "file": str(input.data)}
        return chosen

    return values


@cache
def request_of(sample, ask, crushed, attempt):
    """Return what a job of a sample asks a cluster for; all of its packings are alike."""
    settings = {**SAMPLES, **REFINED_SAMPLES}[sample]
    breakage = breakage_of(settings["breakage"]) if crushed else None
    return ask(None if sample in READ else sample_of(settings), breakage, attempt)


def asked(resource, crushed=False, ask=packing_request):
    """Return a resources function: mem_mb or runtime that a packing asks a cluster for."""
    return lambda wildcards, attempt: getattr(
        request_of(wildcards.sample, ask, crushed, attempt), resource
    )


def asked_to_read(crushed=False):
    """Return a resources function: mem_mb to read the contacts of all packings of a sample."""
    return asked("mem_mb", crushed, reading_request)


def data_files(wildcards):
    """Return the files that the sample's grading is read from."""
    if wildcards.sample in READ:
        return [f"results/{wildcards.sample}/radii.csv"]
    return data_of(settings_of(wildcards))


def data_of(settings):
    """Return the files that a grading is read from; a module's prefix does not move them."""
    return [local(file) for file in grading_data_files(settings["grading"])]


def history_files(wildcards):
    """Return the file of the user's history of loads, if there is one."""
    file = SETTINGS.thermodynamics.history.file
    return [local(file)] if file else []


def samples_where(kept):
    """Return a constraint of the wildcard `sample` to some of all samples."""
    return (
        "|".join(re.escape(name) for name in [*SAMPLES, *REFINED_SAMPLES] if kept(name)) or "(?!)"
    )


def packing_files(kind):
    """Return an input function for the files of grains or contacts that a packing is read from."""

    def files(wildcards):
        name = settings_of(wildcards)["packing"][kind][int(wildcards.seed) - 1]
        return [local(file) for file in frame_files(name)]

    return files


def of_seeds(file, of, seeds):
    return [f"results/{of}/seed_{seed}/{file}" for seed in seeds]


def of_all_seeds(file):
    """Return an input function for a file of every seed of the sample."""
    return lambda wildcards: of_seeds(file, wildcards.sample, settings_of(wildcards)["seeds"])


def of_read_seeds(file):
    """Return an input function for a file of every packing that was read, of none made here."""

    def files(wildcards):
        return of_all_seeds(file)(wildcards) if wildcards.sample in READ else []

    return files


def of_first_seed(file):
    """Return an input function for a file of the one seed whose packing is drawn."""
    return lambda wildcards: of_seeds(file, wildcards.sample, settings_of(wildcards)["seeds"][:1])


def of_first_read_seed(file):
    """Return an input function for a file of the packing that is drawn, if it was read."""
    return lambda wildcards: of_read_seeds(file)(wildcards)[:1]


def of_refined_sample(file):
    """Return an input function for a file of the sample with twice the steps, if there is one."""

    def files(wildcards):
        name = wildcards.sample + REFINED
        return [f"results/{name}/{file}"] if name in REFINED_SAMPLES else []

    return files


def of_refined_seeds(file):
    """Return an input function for a file of every seed that is run again with twice the steps."""

    def files(wildcards):
        name = wildcards.sample + REFINED
        return (
            of_seeds(file, name, REFINED_SAMPLES[name]["seeds"]) if name in REFINED_SAMPLES else []
        )

    return files


def code(script, *others):
    """Return what stands for a script, the modules it runs and other files that it reads."""
    # One text, where each file as an input would be looked at and recorded with every output.
    return source_digest(workflow.source_path(f"../scripts/{script}.py"), others)


GLOSSARY = str(ROOT / "docs/glossary.md")


# The view of grains in three dimensions, which pages include.
VIEWER = [
    f"viewer/{name}"
    for name in ("viewer.html.jinja", "viewer.css", "data.js", "draw.js", "viewer.js")
]


def page_files(*parts, page):
    """Return the files that a page is rendered from: its template, its parts, and what all share."""
    shared = ["base.html.jinja", "parts.html.jinja", "page.css", "page.js"]
    own = [name if "." in name else f"{name}.html.jinja" for name in (page, *parts)]
    return [*(str(ROOT / "workflow/report" / name) for name in own + shared), GLOSSARY]


def as_svg(names, folder="{sample}"):
    """Return the same figures as SVG, which are drawn beside the PNG, as outputs by name."""
    return {f"{name}_svg": f"results/figures/{folder}/{name}.svg" for name in names}


def figure(name):
    """Return a figure of a sample, as an output that `snakemake --report` holds."""
    return report(
        f"results/figures/{{sample}}/{name}.png",
        caption=f"../report/captions/{name}.rst",
        category="Sample {sample}",
        subcategory="Figures",
        labels={"figure": name.replace("_", " ")},
    )


def table(name, holds):
    """Return a table of a sample, in the same way, with words for what it holds."""
    return report(
        f"results/{{sample}}/{name}.csv",
        caption="../report/captions/table.rst",
        category="Sample {sample}",
        subcategory="Tables",
        labels={"table": name.replace("_", " "), "holds": holds},
    )


def study_figure(name):
    """Return a figure of all samples, in the same way."""
    return report(
        f"results/figures/findings/{name}.png",
        caption=f"../report/captions/findings_{name}.rst",
        category="All samples",
        subcategory="Figures",
        labels={"figure": name},
    )


def study_table(name, holds):
    """Return a table of all samples, in the same way."""
    return report(
        f"results/{name}.csv",
        caption="../report/captions/table.rst",
        category="All samples",
        subcategory="Tables",
        labels={"table": name, "holds": holds},
    )
