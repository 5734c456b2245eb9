"""branchcrush: from a grading to the energy split of its branches and the crushing model."""

import sys

from snakemake.exceptions import WorkflowError
from snakemake.utils import min_version

from branchcrush.config.schema import checked_config
from branchcrush.config.file import code_problem, config_file_problem
from branchcrush.errors import ConfigError

min_version("9.17")

# What was named on the command line: read by then, and held to what config.yaml is held to.
for file in workflow.overwrite_configfiles:
    if problem := config_file_problem(file, whole=False):
        raise WorkflowError(problem)
if problem := code_problem(config):
    raise WorkflowError(f"config: {problem}")

if "samples" not in config:
    if problem := config_file_problem("config.yaml"):
        raise WorkflowError(problem)

    configfile: "config.yaml"


def only_previewed():
    """Return whether nothing but a preview is asked for, which shows grains that are too few."""
    if "preview" not in sys.argv:
        return False
    # Snakemake itself tells its targets only after it has read this file.
    from snakemake.cli import get_argument_parser

    return get_argument_parser().parse_known_args(sys.argv[1:])[0].targets == ["preview"]


try:
    if workflow.is_main_process:
        from branchcrush.config.checks import checked_study

        SETTINGS = checked_study(config, few_grains=only_previewed())
    else:  # a job of a study that was checked
        SETTINGS = checked_config(config)
except ConfigError as error:
    raise WorkflowError(str(error)) from None


# The first, and so the default, but not a module's over a rule of the workflow that uses it.
rule all:
    input:
        "results/comparison.csv",
        "results/datapackage.json",
        "results/report.html",
        "results/findings.html",


include: "workflow/rules/out_of_date.smk"
include: "workflow/rules/one_run.smk"
include: "workflow/rules/common.smk"
include: "workflow/rules/compression.smk"
include: "workflow/rules/grading.smk"
include: "workflow/rules/certificate.smk"
include: "workflow/rules/branch_lengths.smk"
include: "workflow/rules/energy_split.smk"
include: "workflow/rules/sharing.smk"
include: "workflow/rules/thermodynamics.smk"
include: "workflow/rules/report.smk"
include: "workflow/rules/preview.smk"


onstart:
    # Without a limit on jobs begun each second, which for each job that ends looks for another one
    # each second from then on.
    if workflow.local_exec:
        workflow.scheduler.job_rate_limiter = None
