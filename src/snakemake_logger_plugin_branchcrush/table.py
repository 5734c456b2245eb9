"""The form of a terminal: what runs in a table that moves, above it what has ended."""

import os
from collections.abc import Mapping
from typing import TextIO

from rich import box
from rich.console import Console, Group, RenderableType
from rich.live import Live
from rich.table import Table
from rich.text import Text

from snakemake_logger_plugin_branchcrush.progress import Progress, stress_text
from snakemake_logger_plugin_branchcrush.run import Run, duration_text, time_left_text

# Lines of the terminal that are not for running packings: head, counts and the other jobs.
_BESIDES = 6
_OTHERS = 3


class MovingTable:
    """Draws a run at the foot of a terminal, and texts above it.

    Parameters
    ----------
    stream : TextIO
        The terminal.
    colour : bool
    """

    interval = 1.0

    def __init__(self, stream: TextIO, colour: bool = True) -> None:
        self._stream = stream
        self._console = Console(file=stream, force_terminal=True, no_color=not colour)
        self._live: Live | None = None

    def say(self, text: str, is_error: bool = False, timed: bool = False) -> None:
        """Write a text above the table.

        Parameters
        ----------
        text : str
        is_error : bool
            In red.
        timed : bool
            Of no concern where one looks on.
        """
        # Long lines are left to the terminal, which puts them together again when copied.
        style = "red" if is_error else ""
        self._console.print(Text(text, style), soft_wrap=True)

    def wants(self, now: float) -> bool:
        """Return that the table may always be drawn anew.

        Parameters
        ----------
        now : float
            [s]

        Returns
        -------
        bool
        """
        return True

    def show(self, run: Run, progress: Mapping[int, Progress | None], now: float) -> None:
        """Draw the run.

        Parameters
        ----------
        run : Run
        progress : dict of Progress
            By the numbers of jobs; None before a packing's first strain step.
        now : float
            [s]
        """
        # Of the terminal itself: the streams that rich would ask are taken from the jobs.
        if self._stream.isatty():
            self._console.size = os.get_terminal_size(self._stream.fileno())
        drawn = drawing(run, progress, now, self._console.height)
        if self._live is None:
            self._live = Live(
                console=self._console,
                auto_refresh=False,
                transient=True,
                redirect_stdout=False,
                redirect_stderr=False,
            )
            self._live.start()
            # A run that is killed would leave a terminal without it.
            self._console.show_cursor(True)
        self._live.update(drawn, refresh=True)

    def close(self) -> None:
        """Take the table away; what was said above it stays."""
        if self._live is not None:
            self._live.stop()
            self._live = None


def drawing(
    run: Run, progress: Mapping[int, Progress | None], now: float, height: int
) -> RenderableType:
    """Return what a terminal shows of a run.

    Parameters
    ----------
    run : Run
    progress : dict of Progress
        By the numbers of jobs.
    now : float
        [s]
    height : int
        Lines of the terminal.

    Returns
    -------
    rich renderable
    """
    parts: list[RenderableType] = []
    running = run.running_packings
    room = max(1, height - _BESIDES)
    if running:
        table = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False)
        table.add_column("packing", no_wrap=True, overflow="ellipsis")
        for name in ("state", "phi", "stress", "time"):
            table.add_column(name, justify="right", no_wrap=True)
        for job in running[:room]:
            at = progress.get(job.number)
            known = ("begins", "", "")
            if at is not None:
                state = f"{at.state} of {at.last_state}"
                known = (state, f"{at.solid_fraction:.3f}", stress_text(at.mean_stress))
            table.add_row(Text(str(job)), *known, duration_text(now - job.begun))
        parts.append(table)
    if len(running) > room:
        parts.append(_line(f"and {len(running) - room} packings more"))
    others = run.running_others
    if others:
        more = f", and {len(others) - _OTHERS} more" if len(others) > _OTHERS else ""
        parts.append(_line("now: " + ", ".join(map(str, others[:_OTHERS])) + more))
    parts.append(_line(counts_text(run, now)))
    return Group(*parts)


def counts_text(run: Run, now: float) -> str:
    """Return how many jobs are done, run and are left, and how long that may take.

    Parameters
    ----------
    run : Run
    now : float
        [s]

    Returns
    -------
    str

    Examples
    --------
    >>> run = Run()
    >>> run.plan({"compression": 3, "report": 1, "all": 1})
    >>> counts_text(run, 0.0)
    'packings: 0 done, 0 running, 3 left; other steps: 0 of 1'
    """
    running, words = len(run.running_packings), []
    if run.packings:
        left = max(0, run.packings - run.packings_done - running)
        words.append(f"packings: {run.packings_done} done, {running} running, {left} left")
        time_left = time_left_text(run.seconds_left(now))
        if time_left and (left or running):
            words[0] += f", {time_left}"
    if run.steps:
        words.append(f"{'other ' if words else ''}steps: {run.steps_done} of {run.steps}")
    return "; ".join(words)


def _line(text: str) -> Text:
    """Return a text as one line of the terminal, cut at its edge."""
    return Text(text, no_wrap=True, overflow="ellipsis")
