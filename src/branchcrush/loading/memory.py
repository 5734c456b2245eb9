"""How much memory jobs are expected to take, and what to say where there is less."""

# Interpreter, libraries and LAMMPS [bytes], and a contact in all tables of all states.
_BASE, _CONTACT, _CONTACTS_PER_GRAIN = 350e6, 300.0, 3.0
# Interpreter and libraries of a job that reads packings, and a contact that it holds [bytes]:
# benchmarks/results/analysis.json, where it took 80 to 140.
_READING_BASE, _READ_CONTACT = 150e6, 150.0
# Whose contacts are held of all packings at once: the first that is certified, and the end.
_STATES_OF_ALL = 2
# What is expected may be half as much again.
_CLEARLY = 1.5


def expected_memory(grains: float, states: int, ranks: int = 1) -> float:
    """Return about how much memory a job takes that compresses a packing.

    Parameters
    ----------
    grains : float
        N at the end of the loading.
    states : int
        Saved on the way; the loose packing and the end of the approach come besides.
    ranks : int
        MPI processes that share the packing.

    Returns
    -------
    float
        Of all ranks together [bytes].

    Examples
    --------
    >>> expected_memory(1e6, 15) / 1e9
    15.65
    """
    return _BASE * ranks + _CONTACT * _CONTACTS_PER_GRAIN * grains * (states + 2)


def expected_reading_memory(grains: float, states: int, packings: int) -> float:
    """Return about how much memory a job takes that reads the contacts of all packings.

    It holds those of one packing in all its states, and of all packings in two of them.

    Parameters
    ----------
    grains : float
        Of a packing, at the end of the loading.
    states : int
        Saved on the way.
    packings : int

    Returns
    -------
    float
        [bytes]

    Examples
    --------
    >>> expected_reading_memory(1e4, 15, 1000) / 1e9
    9.2265
    """
    states_held = states + 2 + _STATES_OF_ALL * packings
    return _READING_BASE + _READ_CONTACT * _CONTACTS_PER_GRAIN * grains * states_held


def at_a_time(packings: int, ranks: int, cores: int) -> tuple[int, int]:
    """Return how many packings are at work at a time, and on how many cores each.

    Parameters
    ----------
    packings : int
    ranks : int
        MPI processes that are to share a packing.
    cores : int
        That all share.

    Returns
    -------
    jobs, ranks : int

    Examples
    --------
    >>> at_a_time(5, 2, 7), at_a_time(2, 1, 7), at_a_time(5, 8, 2)
    ((3, 2), (2, 1), (1, 2))
    """
    ranks = min(ranks, cores)
    return min(cores // ranks, packings), ranks


def is_too_much(need: float, total: float) -> bool:
    """Return whether a job needs clearly more memory than a machine has.

    Parameters
    ----------
    need : float
        From `expected_memory` [bytes].
    total : float
        Of the machine [bytes].

    Returns
    -------
    bool

    Examples
    --------
    >>> is_too_much(9e9, 8e9), is_too_much(13e9, 8e9)
    (False, True)
    """
    return need > _CLEARLY * total


def memory_words(need: float, jobs: int, ranks: int, total: float, available: float) -> str:
    """Return what to say of jobs that take more memory than is free, or nothing.

    Parameters
    ----------
    need : float
        Of one job [bytes].
    jobs : int
        That run at a time.
    ranks : int
        Cores of each.
    total, available : float
        What the machine has, and what is free of it [bytes].

    Returns
    -------
    str

    Examples
    --------
    >>> memory_words(3e9, 2, 1, 8e9, 5e9)
    '2 jobs at a time take about 6.0 GB of memory, and 5.0 GB are free: take --cores 1'
    >>> memory_words(2e9, 2, 1, 8e9, 5e9)
    ''
    """
    if need * jobs <= available:
        return ""
    fewer = int(available // need)
    advice = "ask for fewer grains or loading.states"
    if is_too_much(need, total):
        return (
            f"a job takes about {need / 1e9:.1f} GB of memory, and the machine has "
            f"{total / 1e9:.1f} GB: {advice}, or take a larger machine"
        )
    if 0 < fewer < jobs:
        advice = f"take --cores {fewer * ranks}"
    takes = f"{jobs} jobs at a time take" if jobs > 1 else "a job takes"
    return (
        f"{takes} about {need * jobs / 1e9:.1f} GB of memory, and {available / 1e9:.1f} GB are "
        f"free: {advice}"
    )
