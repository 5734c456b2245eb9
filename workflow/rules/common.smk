"""What the rules share: the settings of a sample, its files, and the code a job depends on."""

from pathlib import Path

from branchcrush.config.schema import REFINED
from branchcrush.config.gradings import grading_data_files
from branchcrush.source_files import source_digest

# Of this project: a workflow that uses it as a module has another basedir.
ROOT = Path(workflow.current_basedir).parents[1]
SAMPLES = {name: sample.settings() for name, sample in SETTINGS.samples.items()}
# The first seeds again with twice the strain steps, for the certificate's convergence.
REFINED_SAMPLES = {
    name + REFINED: sample.settings(refinement=2)
    for name, sample in SETTINGS.samples.items()
    if sample.refined_seeds
}
# Of every interval from resampling seeds.
INTERVALS = {key: getattr(SETTINGS.energy_split, key) for key in ("confidence", "resamples")}


wildcard_constraints:
    sample="|".join(map(re.escape, [*SAMPLES, *REFINED_SAMPLES])),
    seed=r"\d+",


def sample_of(wildcards):
    return {**SAMPLES, **REFINED_SAMPLES}[wildcards.sample]


def section(*keys):
    """Return a params function for some keys of the sample, as plain values."""
    return lambda wildcards: {key: sample_of(wildcards)[key] for key in keys}


def data_files(wildcards):
    """Return the files that the sample's grading is read from."""
    return grading_data_files(sample_of(wildcards)["grading"])


def of_seeds(file, of, seeds):
    return [f"results/{of}/seed_{seed}/{file}" for seed in seeds]


def of_all_seeds(file):
    """Return an input function for a file of every seed of the sample."""
    return lambda wildcards: of_seeds(file, wildcards.sample, sample_of(wildcards)["seeds"])


def of_first_seed(file):
    """Return an input function for a file of the one seed whose packing is drawn."""
    return lambda wildcards: of_seeds(file, wildcards.sample, sample_of(wildcards)["seeds"][:1])


def of_refined_seeds(file, refined):
    """Return an input function for a file of the seeds run twice, in one or the other run."""

    def files(wildcards):
        name = wildcards.sample + REFINED
        seeds = REFINED_SAMPLES[name]["seeds"] if name in REFINED_SAMPLES else []
        return of_seeds(file, name if refined else wildcards.sample, seeds)

    return files


def code(script, *others):
    """Return what stands for a script, the modules it runs and other files that it reads."""
    # One text, where each file as an input would be looked at and recorded with every output.
    return source_digest(workflow.source_path(f"../scripts/{script}.py"), others)
