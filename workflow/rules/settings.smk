"""Settings: what the command line and config.yaml hold -> `SETTINGS`, checked, or what is wrong."""

import logging
import sys

from snakemake.exceptions import WorkflowError

from branchcrush.config.file import code_problem, config_file_problem
from branchcrush.config.schema import checked_config
from branchcrush.errors import ConfigError

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
    # Snakemake itself tells its targets only after it has read this file, as one_run.smk asks it.
    from snakemake.cli import get_argument_parser

    return get_argument_parser().parse_known_args(sys.argv[1:])[0].targets == ["preview"]


try:
    if workflow.is_main_process:
        from branchcrush.config.checks import checked_study

        SETTINGS = checked_study(config, few_grains=only_previewed())
    else:  # a job of a study that was checked
        SETTINGS = checked_config(config)
except ConfigError as error:
    # On a full disk Snakemake cannot write its own log, and would say so in tracebacks.
    logging.raiseExceptions = False
    raise WorkflowError(str(error)) from None
