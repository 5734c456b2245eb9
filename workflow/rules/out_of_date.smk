"""What is out of date: decided by what files, code and configuration hold, not by times and paths.

Every job leaves a record of what made its results. Once Snakemake knows the jobs of a run, the
records are held against what is there now, and the jobs that do not fit are forced.
"""

import functools

from snakemake.dag import DAG
from snakemake.io import remove_flag
from snakemake.logging import logger
from snakemake.settings.types import RerunTrigger

from branchcrush.records import out_of_date
from branchcrush.records_words import dumps_not_kept, kept_of_other_versions, lines_of


# Of the inputs of all rules that follow: their times decide nothing.
inputflags:
    ancient,


def recorded(jobs):
    """Return the jobs whose results have a record."""
    return [job for job in jobs if "record" in job.output.keys()]


def by_content(update_needrun, is_module):
    """Return Snakemake's choice of the jobs to run, with those that do not fit what is there."""

    @functools.wraps(update_needrun)
    async def update(dag, create_inventory=False):
        if not (create_inventory and dag.workflow.is_main_process):
            return await update_needrun(dag, create_inventory)
        if not is_module:
            # Nor does what Snakemake notes of earlier runs, which is lost with its folder.
            dag.workflow.dag_settings.rerun_triggers = frozenset({RerunTrigger.MTIME})
        cases = out_of_date(recorded(dag.jobs))
        for case in cases:
            dag.forcefiles.update(case.job.output)
        await update_needrun(dag, create_inventory)
        # What follows is brought about by its inputs as ever, which have to count for it.
        running = set(dag.needrun_jobs())
        following = set(dag.bfs(dag.depending, *running)) - running
        for file in (file for job in following for file in job.input):
            remove_flag(file, "ancient")
        if following:
            await update_needrun(dag)
        report_cases(dag, cases)

    return update


def report_cases(dag, cases):
    """Tell which jobs are done again and why, but for those that only follow from others."""
    above = [case.job for case in cases]
    below = {job for start in above for job in dag.bfs(dag.depending, start) if job is not start}
    for line in lines_of(case for case in cases if case.job not in below):
        logger.info(line)
    running = set(dag.needrun_jobs())
    kept = [job for job in recorded(dag.jobs) if job not in running]
    for line in (kept_of_other_versions(kept), dumps_not_kept(kept)):
        if line:
            logger.info(line)


# Snakemake offers no place between the two. Once, however many modules include this.
if workflow.is_main_process and not hasattr(DAG.update_needrun, "__wrapped__"):
    # The rules of a workflow that uses this as a module need the triggers that its user chose.
    is_module = workflow.modifier.parent_modifier is not None
    DAG.update_needrun = by_content(DAG.update_needrun, is_module)
