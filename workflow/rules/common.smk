"""What the rules share: the settings of a sample, its files, and the code a job depends on."""

from branchcrush.config import REFINED, refined
from branchcrush.source_files import source_files

SAMPLES = dict(SETTINGS.samples)
# No result of `all`: only `convergence` asks for them.
REFINED_SAMPLES = {name + REFINED: refined(sample) for name, sample in SAMPLES.items()}


wildcard_constraints:
    sample="|".join(map(re.escape, [*SAMPLES, *REFINED_SAMPLES])),
    seed=r"\d+",


def sample_of(wildcards):
    return {**SAMPLES, **REFINED_SAMPLES}[wildcards.sample]


def section(*keys):
    """Return a params function for some keys of the sample, as plain values."""
    return lambda wildcards: sample_of(wildcards).model_dump(include=set(keys))


def of_all_seeds(file):
    """Return an input function for a file of every seed of the sample."""
    return lambda wildcards: [
        f"results/{wildcards.sample}/seed_{seed}/{file}" for seed in sample_of(wildcards).seeds
    ]


def code(script):
    """Return the modules that a script runs: an edit of one reruns the jobs that depend on it."""
    return source_files(workflow.source_path(f"../scripts/{script}.py"))
