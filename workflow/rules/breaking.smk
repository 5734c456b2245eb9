# What the rules of crushing.smk, crushed_grains.smk and crushing_results.smk share of the samples
# whose grains break.

BREAKING = [name for name, sample in SAMPLES.items() if sample["breakage"]]
CRUSHING_TABLES = {
    "states": "crushing_states",
    "means": "crushing_means",
    "gradings": "crushing_gradings",
    "lengths": "crushing_lengths",
    "line": "crushing_line",
    "beside": "crushing_beside_forms",
    "predicted": "crushing_predicted",
    "beside_predicted": "crushing_beside_predicted",
}
CRUSHING_FIGURES = [
    "crushed_line",
    "crushed_gradings",
    "crushed_lengths",
    "crushed_energy",
    "crushed_measures",
    "crushed_forms",
    "crushed_predicted",
    "crushed_packing",
]
GRAINS_FIGURES = ["who_breaks", "split_of_crushed"]
CRUSHING_PAGE = str(ROOT / "workflow/report/crushing.html.jinja")


def of_crushed_seeds(file):
    """Return an input function for a file of the crushing of every seed of the sample."""
    return lambda wildcards: of_seeds(
        file, f"{wildcards.sample}/crushing", settings_of(wildcards)["seeds"]
    )


def of_halved_seeds(file):
    """Return an input function for a file of every seed that is crushed with half the steps."""

    def files(wildcards):
        name = wildcards.sample + REFINED
        seeds = REFINED_SAMPLES[name]["seeds"] if name in REFINED_SAMPLES else []
        return of_seeds(file, f"{name}/crushing", seeds)

    return files
