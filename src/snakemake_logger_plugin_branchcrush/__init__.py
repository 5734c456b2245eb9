"""What one sees of a run: a table that moves in a terminal, plain lines elsewhere, and its end.

Snakemake finds this package by its name; `profiles/default/config.yaml` chooses it. Every process
of Snakemake imports it, a job's on a cluster too, so all that shows is imported when a run begins.
"""

from logging import LogRecord

from snakemake_interface_logger_plugins.base import LogHandlerBase


class LogHandler(LogHandlerBase):
    """Hand Snakemake's records to the screen of the run."""

    writes_to_stream = True
    writes_to_file = False
    # Snakemake's own: what `--quiet` leaves out does not get here.
    has_filter = False
    has_formatter = False
    needs_rulegraph = False

    def __post_init__(self) -> None:
        """Open the screen."""
        from snakemake_logger_plugin_branchcrush.screen import Screen

        self._screen = Screen(self.common_settings)

    def emit(self, record: LogRecord) -> None:
        """Show a record, or what it changes.

        Parameters
        ----------
        record : logging.LogRecord
        """
        try:
            self._screen.take(record, self.format)
        except Exception:
            self.handleError(record)

    def close(self) -> None:
        """Say how the run ended."""
        self._screen.close()
        super().close()
