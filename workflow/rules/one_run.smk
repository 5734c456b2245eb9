"""One run in a folder at a time, by a lock that goes with the process that holds it."""

from functools import partial

from snakemake.logging import logger

from branchcrush.config.memory import memory_warnings
from branchcrush.errors import ConfigError, RunError
from branchcrush.files.memory import machine_memory
from branchcrush.runs import join_run, one_run


def alone(execute):
    """Return Snakemake's execution of a workflow such that no other run is in the folder."""

    def execute_alone(*arguments, executor_plugin, **settings):
        # A folder that Snakemake locks stays locked when it is killed. What a job left unfinished
        # is made anew, whatever profile is read.
        workflow.execution_settings.lock = False
        workflow.dag_settings.force_incomplete = True
        execution = partial(execute, *arguments, executor_plugin=executor_plugin, **settings)
        # What Snakemake takes it for: settings.smk is read before that, and asks the command line.
        only_preview = set(workflow.dag_settings.targets) == {"preview"}
        if executor_plugin.common_settings.dryrun_exec or only_preview:
            return execution()
        try:
            # On a cluster jobs have the memory of other machines.
            here = executor_plugin.common_settings.local_exec
            cores = workflow.resource_settings.cores or 1
            for line in memory_warnings(SETTINGS, cores, machine_memory()) if here else ():
                logger.warning(line)
            with one_run(cluster=not here):
                return execution()
        except (ConfigError, RunError) as error:
            raise WorkflowError(str(error)) from None

    return execute_alone


# Jobs that Snakemake starts as processes of its own belong to its run. Nothing else that the
# command line can ask for, but for a run, calls this.
if workflow.is_main_process and not hasattr(workflow, "alone"):
    workflow.alone = True
    workflow.execute = alone(workflow.execute)
elif not workflow.is_main_process:
    # Snakemake itself in a job of a cluster: before it removes results, which may be another run's.
    join_run()
