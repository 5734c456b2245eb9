"""What a table's own header says, before it is known how the table is to be read."""

from os import PathLike

from branchcrush.files.columns import read_columns
from branchcrush.files.declared import Declared
from branchcrush.files.headers import Words

_BOTH_EDGES = ("lower", "upper", "value")


def header_words(path: str | PathLike[str], form: str, declared: Declared) -> Words:
    r"""Return the words above the columns of a table.

    Parameters
    ----------
    path : path-like
    form : {"sieve", "density", "histogram", "radii"}
    declared : Declared
        Of which the columns and the sheet are taken.

    Returns
    -------
    Words

    Raises
    ------
    GradingError
        When the file is not to be read at all, or its columns are not known.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "sand.csv")
    ...     _ = path.write_text("Siebweite [mm];Durchgang [%]\n2;100\n1;0\n")
    ...     words = header_words(path, "sieve", Declared())
    >>> words.units(), words.values()
    ({'mm'}, {'percent_finer'})
    """
    names = ("size",) if form == "radii" else ("size", "value")
    wide = _BOTH_EDGES if form == "histogram" else ()
    if declared.columns:
        names = _BOTH_EDGES if len(declared.columns) == 3 else names
    table = read_columns(path, names, declared.columns, declared.sheet, unfilled=True, wide=wide)
    # A column alone has its words in the title.
    return Words(title=" ".join([*table.heads, table.title])) if form == "radii" else table.words
