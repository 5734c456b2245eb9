"""What Snakemake's records become: lines or a table while the run goes on, and its last lines."""

import os
import re
import sys
import threading
import time
from collections.abc import Callable
from logging import LogRecord
from typing import Any

from snakemake_interface_logger_plugins.common import LogEvent

from snakemake_logger_plugin_branchcrush.closing import closing_lines, seen_from
from snakemake_logger_plugin_branchcrush.lines import Lines
from snakemake_logger_plugin_branchcrush.processes import (
    ProcessOutput,
    copy_of,
    descriptor_of,
    is_terminal,
)
from snakemake_logger_plugin_branchcrush.progress import (
    Progress,
    failure_message,
    log_mark,
    packing_progress,
)
from snakemake_logger_plugin_branchcrush.run import (
    Run,
    duration_text,
    is_rule,
    job_of,
    time_left_text,
)

# What Snakemake says of its own doings, and what is said here in other words.
_CHATTER = (
    "Assuming unrestricted shared filesystem usage",
    "Building DAG of jobs",
    "Using shell: ",
    "Conda environments: ignored",
    "Singularity containers: ignored",
    "Group jobs: inactive",
    "Select jobs to execute",
    "Shutting down, this might take some time",
    "Removing output files of failed job",
    "Exiting because a job execution failed",
    "Complete log(s): ",
    "Elapsed time: ",
    "None",
)
_INTERRUPTED = ("Terminating processes on user request", "Cancelling snakemake on user request")
_REASONS = re.compile(
    "Missing output files|Incomplete output files|Updated input files|"
    "Input files updated by another job|Set of input files has changed|Code has changed|"
    "Params have changed|Software environment definition has changed|Forced execution|"
    "Rules with neither input nor output files are always executed"
)
# Of a process that ended with an error or a signal.
_ENDED = re.compile(r"(died with <Signals\.\w+|returned non-zero exit status -?\d+)")


class Screen:
    """The screen of a run.

    Parameters
    ----------
    settings : OutputSettingsLoggerInterface
        Of Snakemake.
    stream : TextIO, optional
        Where to show; the standard error stream, or the standard output of a dry run.
    """

    def __init__(self, settings: Any, stream: Any = None) -> None:
        self.run = Run()
        self.nothing_to_do = self.is_interrupted = False
        self._settings, self._lock = settings, threading.RLock()
        self._quiet = {choice.name for choice in settings.quiet or ()}
        self._start_folder, self._begun = os.getcwd(), time.monotonic()
        self._is_closed, self._plan, self._ended = False, "", ""
        self._progress: dict[int, Progress | None] = {}
        self._output: ProcessOutput | None = None
        self._stop = threading.Event()
        standard = sys.stdout if settings.stdout else sys.stderr
        self._descriptor = descriptor_of(standard) if stream is None else None
        self._stream = copy_of(standard, self._descriptor) if stream is None else stream
        self._is_wanted = not self._quiet & {"ALL", "RULES", "PROGRESS"}
        self._is_terminal = self._stream.isatty() and os.environ.get("TERM") != "dumb"
        self._form: Any = Lines(self._stream)
        self._whole: Any = None
        if settings.verbose or settings.debug_dag:
            from snakemake.logging import ColorizingTextHandler

            self._whole = ColorizingTextHandler(settings.nocolor, self._stream)
            self._is_wanted = False
        elif self._is_terminal and not settings.dryrun:
            from snakemake_logger_plugin_branchcrush.table import MovingTable

            self._form = MovingTable(self._stream, colour=not settings.nocolor)

    def take(self, record: LogRecord, whole: Callable[[LogRecord], str]) -> None:
        """Show a record, or what it changes.

        Parameters
        ----------
        record : logging.LogRecord
        whole : callable
            Returns the text that Snakemake makes of a record.
        """
        takers = {
            LogEvent.RUN_INFO: self._planned,
            LogEvent.JOB_INFO: self._began,
            LogEvent.JOB_FINISHED: self._finished,
            LogEvent.JOB_ERROR: self._failed,
            LogEvent.GROUP_ERROR: self._group_failed,
            LogEvent.ERROR: self._error,
            LogEvent.SHELLCMD: self._command,
            None: self._message,
        }
        with self._lock:
            if self._whole is not None:
                self._whole.setFormatter(_Formatter(whole))
                self._whole.emit(record)
            take = takers.get(getattr(record, "event", None))
            if take is not None:
                take(record)

    def close(self) -> None:
        """Take the table away, give the streams back, and say how the run ended; once."""
        with self._lock:
            if self._is_closed:
                return
            self._is_closed = True
        self._stop.set()
        if self._output is not None:
            self._output.close()
        with self._lock:
            self._form.close()
            if self._settings.dryrun and self._plan:
                self._form.say(self._plan)
            if not (self._settings.dryrun or "ALL" in self._quiet):
                lines = closing_lines(
                    self.run,
                    nothing_to_do=self.nothing_to_do,
                    is_interrupted=self.is_interrupted,
                    seconds=time.monotonic() - self._begun,
                    start_folder=self._start_folder,
                )
                is_error = bool(self.run.failed) and not self.is_interrupted
                for line in lines:
                    self._form.say(line, is_error=is_error)
            if self._descriptor is not None:
                self._stream.close()

    def _planned(self, record: Any) -> None:
        """Take how many jobs there are, and begin to watch them."""
        if self._settings.dryrun:
            # Told after the jobs, where it is seen; the second time it is the same.
            self._plan = record.getMessage().rstrip() if self._whole is None else ""
            return
        self.run.plan(record.stats)
        packings, steps = self.run.packings, self.run.steps
        words = [f"{packings} packings"] if packings else []
        words += [f"{steps} {'other ' if words else ''}steps"] if steps else []
        self._say(f"to do: {' and '.join(words) or 'nothing'}", timed=True)
        if self._whole is None and self._descriptor is not None:
            descriptors = [self._descriptor]
            if self._is_terminal and is_terminal(1) and self._descriptor != 1:
                descriptors.append(1)
            self._output = ProcessOutput(descriptors, self._from_job)
        threading.Thread(target=self._watch, name="screen", daemon=True).start()

    def _began(self, record: Any) -> None:
        """Take a job that begins, or that would in a dry run."""
        before = log_mark(record.log[0]) if record.log else ()
        job = job_of(record, time.monotonic(), before)
        if self._settings.dryrun:
            if not is_rule(job.rule, "all"):
                reason = ", ".join(_REASONS.findall(record.reason)).lower()
                # The rule's name first, as Snakemake's own lines have it.
                of = str(job) if job.is_packing else str(job).partition(" of ")[2]
                self._say(f"rule {job.rule}: {of + '; ' if of else ''}{reason}")
            return
        self.run.begin(job)
        self._show(time.monotonic())

    def _finished(self, record: Any) -> None:
        """Say that a job has ended."""
        now = time.monotonic()
        job = self.run.finish(record.job_id, now)
        if job is None or is_rule(job.rule, "all"):
            return
        self._progress.pop(job.number, None)
        self._show(now)
        if not job.is_packing:
            self._say(f"{job} done ({self.run.steps_done} of {self.run.steps} steps)", timed=True)
            return
        at = packing_progress(job.log)
        left = time_left_text(self.run.seconds_left(now))
        counts = f"{self.run.packings_done} of {self.run.packings} packings"
        if self.run.packings > self.run.packings_done and left:
            counts += f", {left}"
        took = duration_text(now - job.begun)
        self._say(f"{job}: {f'{at}, ' if at else ''}done in {took} ({counts})", timed=True)

    def _failed(self, record: Any) -> None:
        """Say that a job has failed, why, and where its log is."""
        number = record.jobid
        job = self.run.running.get(number)
        if job is None:
            # Its beginning was not told (--quiet), or it has failed before and was started again.
            job = job_of(record, time.monotonic(), ())
            if any(failed.number == number for failed, _ in self.run.failed):
                return
            self.run.begin(job)
        self.is_interrupted |= "SIGINT" in self._ended
        message = failure_message(job.log) if log_mark(job.log) != job.log_before else ""
        # Of a job that a cluster ended, its scheduler tells why, in a log of its own.
        scheduler = getattr(record, "rule_msg", None)
        reason = message or self._ended or scheduler or "it left no message"
        at = record.log[-1] if scheduler and not message else job.log
        self._ended = ""
        self.run.fail(number, reason)
        self._progress.pop(number, None)
        self._show(time.monotonic())
        if not self.is_interrupted:
            log = f" (log: {seen_from(self._start_folder, at)})" if at else ""
            self._say(f"FAILED {job}: {reason}{log}", is_error=True, timed=True, always=True)

    def _group_failed(self, record: Any) -> None:
        """Take the jobs of a group that has failed, of which some may have ended well."""
        for info in record.job_error_info:
            if info["jobid"] in self.run.running:
                failed = LogRecord("", 0, "", 0, "", None, None)
                failed.__dict__.update(info, wildcards={})
                self._failed(failed)

    def _error(self, record: Any) -> None:
        """Show an error whole, but not that of a job's process: its failure is told by its log."""
        text = record.getMessage()
        if text.startswith(_INTERRUPTED):
            self.is_interrupted = True
        elif "CalledProcessError" in text and (ended := _ENDED.search(text)):
            words = ended.group().replace("died with <Signals.", "its process was ended by ")
            self._ended = words.replace("returned", "its process returned")
            return
        elif "At least one job did not complete successfully" in text and self.run.failed:
            return
        if not (self.is_interrupted and "CalledProcessError" in text):
            self._say(text, is_error=True, always=True)

    def _message(self, record: Any) -> None:
        """Show what Snakemake says, but for its chatter."""
        text = record.getMessage()
        self.is_interrupted |= text.startswith(_INTERRUPTED)
        self.nothing_to_do |= text.startswith("Nothing to be done")
        if text and not text.startswith(_CHATTER):
            self._say(text, is_error=record.levelname in ("ERROR", "CRITICAL"), always=True)

    def _command(self, record: Any) -> None:
        """Show a command of the shell, which Snakemake hands on with --printshellcmds alone."""
        command = getattr(record, "shellcmd", None) or getattr(record, "cmd", None)
        if command:
            self._say(command, always=True)

    def _from_job(self, line: str) -> None:
        """Show what a job wrote, but for the message that its failure is told by."""
        with self._lock:
            if not (self._stream.closed or line.startswith("branchcrush: ")):
                self._form.say(line)

    def _say(
        self, text: str, is_error: bool = False, timed: bool = False, always: bool = False
    ) -> None:
        """Show a text; where only little is wanted, those that always are."""
        if self._is_wanted or (always and self._whole is None):
            self._form.say(text, is_error=is_error, timed=timed)

    def _watch(self) -> None:
        """Show the run anew from time to time."""
        while not self._stop.wait(self._form.interval):
            with self._lock:
                self._show(time.monotonic())

    def _show(self, now: float) -> None:
        """Look where the packings are, and show the run, where that is wanted now."""
        if self._stop.is_set() or not self._is_wanted or not self._form.wants(now):
            return
        for job in self.run.running_packings:
            # A block of the log may hold no strain step: what was known is kept.
            known = packing_progress(job.log) if log_mark(job.log) != job.log_before else None
            self._progress[job.number] = known or self._progress.get(job.number)
        self._form.show(self.run, self._progress, now)


class _Formatter:
    """Makes Snakemake's own text of a record."""

    def __init__(self, whole: Callable[[LogRecord], str]) -> None:
        self.format = whole
