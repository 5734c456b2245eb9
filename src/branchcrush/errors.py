"""The errors a user can meet. Each message says what is wrong and what to do about it."""


class BranchcrushError(Exception):
    """Base class of all errors of this package."""


class ConfigError(BranchcrushError):
    """The configuration is not usable. The message has one line for each problem."""


class GradingError(BranchcrushError):
    """A grading or its file is not usable. The message has one line for each problem."""


class ReadingError(BranchcrushError):
    """Files that another code wrote are not usable. The message has one line for each problem."""


class PackingError(BranchcrushError):
    """The grains cannot be placed without overlap."""


class SimulationError(BranchcrushError):
    """LAMMPS cannot be loaded, stopped, or ended in a state that fails its checks."""


class RunError(BranchcrushError):
    """The folder is another run's. The message names it."""


class FitError(BranchcrushError):
    """The data carry too little to fit."""


class ResultsError(BranchcrushError):
    """A result that was asked for is not there, or has no such part."""


class ResultsWarning(UserWarning):
    """A result is of another version of this package."""
