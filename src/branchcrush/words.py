"""Words that messages of all rooms share."""

from collections.abc import Iterable


def few(names: Iterable[str], most: int = 3) -> str:
    """Return the first of some names, and how many more there are.

    Parameters
    ----------
    names : iterable of str
    most : int
        That are named.

    Returns
    -------
    str

    Examples
    --------
    >>> few(["sand", "silt"]), few("abcde")
    ('sand, silt', 'a, b, c and 2 more')
    """
    named = list(names)
    more = f" and {len(named) - most} more" if len(named) > most else ""
    return ", ".join(named[:most]) + more
