"""branchcrush: from a grading to the energy split of its branches and the crushing model."""

from snakemake.utils import min_version

min_version("9.17")


include: "workflow/rules/settings.smk"


# The first, and so the default, but not a module's over a rule of the workflow that uses it.
rule all:
    input:
        "results/comparison.csv",
        "results/datapackage.json",
        "results/report.html",
        ["results/measured.html"] if SETTINGS.measured else [],
        ["results/crushing.html"] if any(s.breakage for s in SETTINGS.samples.values()) else [],


include: "workflow/rules/out_of_date.smk"
include: "workflow/rules/one_run.smk"
include: "workflow/rules/common.smk"
include: "workflow/rules/compression.smk"
include: "workflow/rules/reading.smk"
include: "workflow/rules/breaking.smk"
include: "workflow/rules/crushing.smk"
include: "workflow/rules/crushed_grains.smk"
include: "workflow/rules/grading.smk"
include: "workflow/rules/certificate.smk"
include: "workflow/rules/branch_lengths.smk"
include: "workflow/rules/energy_split.smk"
include: "workflow/rules/sharing.smk"
include: "workflow/rules/thermodynamics.smk"
include: "workflow/rules/report.smk"
include: "workflow/rules/crushing_results.smk"
include: "workflow/rules/materials.smk"
include: "workflow/rules/measured.smk"
include: "workflow/rules/preview.smk"


onstart:
    # Without a limit on jobs begun each second, which for each job that ends looks for another one
    # each second from then on.
    if workflow.local_exec:
        workflow.scheduler.job_rate_limiter = None
