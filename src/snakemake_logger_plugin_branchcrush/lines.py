"""The plain form: a line for each job that ends, for a pipe, a file, a cluster or a test server."""

import time
from collections.abc import Mapping
from typing import TextIO

from snakemake_logger_plugin_branchcrush.progress import Progress
from snakemake_logger_plugin_branchcrush.run import Run, time_left_text

# After so long without a word, where the packings are [s].
_SILENCE = 30.0
_NAMED = 4


class Lines:
    """Writes lines, each whole and with the time of day.

    Parameters
    ----------
    stream : TextIO
    """

    # How often a run is to be shown [s].
    interval = 1.0

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._spoken = time.monotonic()

    def say(self, text: str, is_error: bool = False, timed: bool = False) -> None:
        """Write a text.

        Parameters
        ----------
        text : str
        is_error : bool
            Of no concern where nothing has a colour.
        timed : bool
            Whether the time of day comes before it.
        """
        before = time.strftime("%H:%M:%S ") if timed else ""
        self._stream.write(f"{before}{text}\n")
        self._stream.flush()
        self._spoken = time.monotonic()

    def wants(self, now: float) -> bool:
        """Return whether it is time to show the run again.

        Parameters
        ----------
        now : float
            [s]

        Returns
        -------
        bool
        """
        return now - self._spoken >= _SILENCE

    def show(self, run: Run, progress: Mapping[int, Progress | None], now: float) -> None:
        """Write where the packings are.

        Parameters
        ----------
        run : Run
        progress : dict of Progress
            By the numbers of jobs; None before a packing's first strain step.
        now : float
            [s]
        """
        for job in run.running_packings[:_NAMED]:
            self.say(f"{job}: {progress.get(job.number) or 'begins'}", timed=True)
        more = len(run.running_packings) - _NAMED
        if more > 0:
            self.say(f"and {more} packings more", timed=True)
        if run.running_others and not run.running_packings:
            others = ", ".join(map(str, run.running_others[:_NAMED]))
            self.say(f"{others}: still at it", timed=True)
        left = time_left_text(run.seconds_left(now))
        if run.packings > run.packings_done and left:
            self.say(f"{run.packings_done} of {run.packings} packings done, {left}", timed=True)
        self._spoken = now

    def close(self) -> None:
        """Do nothing: every line was written when it was said."""
