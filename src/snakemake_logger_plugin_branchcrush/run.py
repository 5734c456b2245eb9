"""What is known of a run: which jobs there are, which are done, and how long it may take."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

# Of the packings that run a second time with twice the strain steps. The same as in config.names,
# which is not imported: it imports pydantic, and a screen begins at once.
REFINED = "-refined"
_LATEST = 8


@dataclass(frozen=True)
class Job:
    """A job that has begun.

    Examples
    --------
    >>> print(Job(7, "compression", {"sample": "paper", "seed": "3"}, "", 0.0))
    paper seed 3
    >>> print(Job(8, "energy_split", {"sample": "paper"}, "", 0.0))
    energy split of paper
    """

    number: int
    rule: str
    wildcards: Mapping[str, str]
    log: str
    begun: float  # [s]
    log_before: tuple[int, ...] = ()  # mark of a log that an earlier run left

    @property
    def is_packing(self) -> bool:
        """Whether it compresses a packing; in a module rules have a name before their own."""
        return is_rule(self.rule, "compression")

    @property
    def is_refined(self) -> bool:
        """Whether its packing has twice the strain steps, and takes twice the time."""
        return self.wildcards.get("sample", "").endswith(REFINED)

    def __str__(self) -> str:
        of = self.wildcards.get("sample", "")
        if "seed" in self.wildcards:
            of += f" seed {self.wildcards['seed']}"
        if self.is_packing and of:
            return of
        name = self.rule.replace("_", " ")
        return f"{name} of {of}" if of else name


def is_rule(name: str, rule: str) -> bool:
    """Return whether a name is that of a rule, or its name in a module.

    Parameters
    ----------
    name, rule : str

    Returns
    -------
    bool

    Examples
    --------
    >>> is_rule("compression", "compression"), is_rule("sand_compression", "compression")
    (True, True)
    """
    return name == rule or name.endswith(f"_{rule}")


@dataclass
class Run:
    """The jobs of a run, as Snakemake's events tell of them.

    Examples
    --------
    >>> run = Run()
    >>> run.plan({"compression": 3, "report": 1, "all": 1, "total": 5})
    >>> run.begin(Job(1, "compression", {"sample": "paper", "seed": "1"}, "", 10.0))
    >>> run.finish(1, 70.0)
    Job(...)
    >>> run.packings, run.packings_done, run.seconds_left(70.0)
    (3, 1, 120.0)
    """

    counts: dict[str, int] = field(default_factory=dict)
    running: dict[int, Job] = field(default_factory=dict)
    finished: list[Job] = field(default_factory=list)
    failed: list[tuple[Job, str]] = field(default_factory=list)  # and not yet done by a retry
    seconds: list[tuple[bool, float]] = field(default_factory=list)  # of packings done
    at_once: int = 0  # most packings that have run beside each other

    def plan(self, counts: Mapping[str, int]) -> None:
        """Take the numbers of jobs of each rule.

        Parameters
        ----------
        counts : dict of int
            And `total`.
        """
        self.counts = {rule: number for rule, number in counts.items() if rule != "total"}

    def begin(self, job: Job) -> None:
        """Take a job that begins.

        Parameters
        ----------
        job : Job
        """
        self.running[job.number] = job
        self.at_once = max(self.at_once, len(self.running_packings))

    def finish(self, number: int, now: float) -> Job | None:
        """Take the end of a job, and return it.

        Parameters
        ----------
        number : int
        now : float
            [s]

        Returns
        -------
        Job or None
            None where it was not known.
        """
        job = self.running.pop(number, None)
        self._forget_failure(number)
        if job is not None:
            self.finished.append(job)
            if job.is_packing:
                self.seconds.append((job.is_refined, now - job.begun))
        return job

    def fail(self, number: int, reason: str) -> Job | None:
        """Take the failure of a job, and return it.

        Parameters
        ----------
        number : int
        reason : str

        Returns
        -------
        Job or None
            None where it was not known.
        """
        job = self.running.pop(number, None)
        if job is not None:
            self._forget_failure(number)
            self.failed.append((job, reason))
        return job

    def _forget_failure(self, number: int) -> None:
        """Take back that a job failed: with `--retries` only its last try counts."""
        self.failed = [(job, reason) for job, reason in self.failed if job.number != number]

    @property
    def packings(self) -> int:
        """How many packings there are to compress."""
        return sum(n for rule, n in self.counts.items() if is_rule(rule, "compression"))

    @property
    def packings_done(self) -> int:
        """How many of them are compressed."""
        return sum(job.is_packing for job in self.finished)

    @property
    def running_packings(self) -> list[Job]:
        """Those that run."""
        return [job for job in self.running.values() if job.is_packing]

    @property
    def running_others(self) -> list[Job]:
        """Jobs beside them."""
        return [job for job in self.running.values() if not job.is_packing]

    @property
    def steps(self) -> int:
        """How many other jobs there are; `all` does nothing."""
        return sum(self.counts.values()) - self.packings - self.targets

    @property
    def steps_done(self) -> int:
        """How many of them have ended well."""
        return sum(not (job.is_packing or is_rule(job.rule, "all")) for job in self.finished)

    @property
    def targets(self) -> int:
        """How many jobs stand for the whole."""
        return sum(n for rule, n in self.counts.items() if is_rule(rule, "all"))

    def has_finished(self, rules: Sequence[str]) -> bool:
        """Return whether a job of one of some rules has ended well.

        Parameters
        ----------
        rules : list of str

        Returns
        -------
        bool
        """
        return any(is_rule(job.rule, rule) for job in self.finished for rule in rules)

    def seconds_left(self, now: float) -> float | None:
        """Return about how long the packings that are not done will take.

        As long as the latest ones took; those with twice the steps, which come first, count only
        until another is done.

        Parameters
        ----------
        now : float
            [s]

        Returns
        -------
        float or None
            [s]; None before the first is done.
        """
        if not self.seconds:
            return None
        plain = [seconds for is_refined, seconds in self.seconds if not is_refined]
        latest = (plain or [seconds for _, seconds in self.seconds])[-_LATEST:]
        one = sum(latest) / len(latest)
        running = self.running_packings
        waiting = max(0, self.packings - self.packings_done - len(running))
        rest = sum(max(0.0, one - (now - job.begun)) for job in running)
        return (waiting * one + rest) / max(1, self.at_once)


def job_of(record: Any, now: float, log_before: tuple[int, ...]) -> Job:
    """Return the job of a record of Snakemake's that tells of its beginning.

    Parameters
    ----------
    record : logging.LogRecord
    now : float
        [s]
    log_before : tuple of int

    Returns
    -------
    Job
    """
    logs = list(getattr(record, "log", None) or [])
    wildcards = dict(getattr(record, "wildcards", None) or {})
    log = str(logs[0]) if logs else ""
    return Job(record.jobid, record.rule_name, wildcards, log, now, log_before)


def duration_text(seconds: float) -> str:
    """Return a duration as a person says it.

    Parameters
    ----------
    seconds : float
        [s]

    Returns
    -------
    str

    Examples
    --------
    >>> [duration_text(seconds) for seconds in (0.4, 59.4, 60, 754, 5400)]
    ['0 s', '59 s', '1 min', '13 min', '1 h 30 min']
    """
    if seconds < 59.5:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60.0)
    if minutes < 60:
        return f"{minutes} min"
    return f"{minutes // 60} h {minutes % 60} min"


def time_left_text(seconds: float | None) -> str:
    """Return the time left for packings as text; empty where it is not known.

    Parameters
    ----------
    seconds : float or None
        [s]

    Returns
    -------
    str

    Examples
    --------
    >>> time_left_text(700.0), time_left_text(5.0), time_left_text(None)
    ('about 12 min left', 'less than a minute left', '')
    """
    if seconds is None:
        return ""
    return "less than a minute left" if seconds < 59.5 else f"about {duration_text(seconds)} left"
