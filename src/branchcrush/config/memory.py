"""Whether the jobs of a study fit into the memory of this machine, told before they start."""

from os import PathLike
from pathlib import Path

from branchcrush.config.sample import number_of_grains
from branchcrush.config.schema import Config
from branchcrush.errors import ConfigError
from branchcrush.files.memory import Memory
from branchcrush.loading.memory import at_a_time, expected_memory, is_too_much, memory_words
from branchcrush.loading.targets import Loading, planned_steps


def memory_warnings(
    study: Config, cores: int, memory: Memory | None, folder: str | PathLike[str] = "."
) -> list[str]:
    """Return what to say of jobs that take more memory than is free, a line for each sample.

    Of grains that break only the first ones are counted.

    Parameters
    ----------
    study : Config
    cores : int
        That jobs share.
    memory : Memory or None
        From `files.memory.machine_memory`; nothing is said where it is not known.
    folder : path-like
        Of the study; packings that are there are not counted.

    Returns
    -------
    list of str

    Raises
    ------
    ConfigError
        When one job alone takes clearly more than the machine has; a line for each sample.

    Examples
    --------
    >>> from branchcrush.config.schema import checked_config
    >>> grading = {"form": "single", "size": "radius", "unit": "mm", "value": 1}
    >>> loading = {"edge_reduction": 0.4}
    >>> sample = {"grading": grading, "grains": 10**6, "seeds": 2, "loading": loading}
    >>> study = checked_config({"samples": {"fine": sample}})
    >>> memory_warnings(study, 2, Memory(64e9, 20e9))
    ['fine: 2 jobs at a time take about 31.3 GB of memory, and 20.0 GB are free: take --cores 1']
    """
    told, refused = [], []
    for name, sample in study.samples.items() if memory is not None else ():
        settings = sample.settings()
        seeds = settings["seeds"]
        made = [Path(folder, "results", name, f"seed_{seed}", "path.csv") for seed in seeds]
        if settings["packing"] or all(path.exists() for path in made):
            continue
        loading, grains = Loading(**settings["loading"]), number_of_grains(settings)
        first, step = settings["initial_solid_fraction"], settings["strain_step"]
        _, states = planned_steps(loading, first, step)
        jobs, ranks = at_a_time(len(seeds), settings["ranks"], cores)
        need = expected_memory(grains, states, ranks)
        words = memory_words(need, jobs, ranks, memory.total, memory.available)
        if is_too_much(need, memory.total):
            refused.append(f"config: samples.{name}.grains = {grains}: {words}")
        elif words:
            told.append(f"{name}: {words}")
    if refused:
        raise ConfigError("\n".join(refused))
    return told
