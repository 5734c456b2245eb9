"""branchcrush: from a grading to the energy split of its branches and the crushing model."""

from snakemake.exceptions import WorkflowError
from snakemake.utils import min_version

from branchcrush.config import checked_config
from branchcrush.errors import ConfigError

min_version("9.15")


configfile: "config.yaml"


try:
    SETTINGS = checked_config(config)
except ConfigError as error:
    raise WorkflowError(str(error)) from None


include: "workflow/rules/common.smk"
include: "workflow/rules/packing.smk"
include: "workflow/rules/compression.smk"
include: "workflow/rules/branch_lengths.smk"
include: "workflow/rules/energy_split.smk"
include: "workflow/rules/thermodynamics.smk"
include: "workflow/rules/report.smk"
include: "workflow/rules/convergence.smk"


rule all:
    default_target: True
    input:
        "results/comparison.csv",
        "results/report.html",
