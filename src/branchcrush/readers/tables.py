"""Text tables with a header: commas, semicolons, tabs or white space between the columns."""

from collections.abc import Sequence
from os import PathLike

from branchcrush.errors import ReadingError
from branchcrush.readers.frames import ColumnFrame
from branchcrush.readers.texts import lines_of, listed, numbers_of, significant_digits, text_of

_DELIMITERS = (",", ";", "\t")
# What export.text and export.textExt of YADE write, by the word after #format.
_YADE = {
    "x_y_z_r": "x y z radius",
    "x_y_z_r_matId": "x y z radius matId",
    "id_x_y_z_r_matId": "id x y z radius matId",
}


def read_columns(path: str | PathLike[str], names: Sequence[str]) -> ColumnFrame:
    r"""Return some columns of a text table, by the names in its header.

    Parameters
    ----------
    path : path-like
        Its first line that is no comment names the columns; a header may itself begin with #.
    names : sequence of str
        Which columns are wanted.

    Returns
    -------
    ColumnFrame

    Raises
    ------
    ReadingError
        When a name is not in the header, or a line is not made of as many columns.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "contacts.csv")
    ...     _ = path.write_text("id1,id2,kind,fn\n3,4,linear,2.5\n")
    ...     read_columns(path, ["id2", "fn"]).columns["fn"].tolist()
    [2.5]
    """
    text = text_of(path)
    lines = text.splitlines()
    place = next(n for n, line in enumerate(lines) if line.strip())
    while lines[place].lstrip().startswith("#") and place + 1 < len(lines):
        following = lines[place + 1].split()
        # The last comment above numbers is the header, if there is none without #.
        if following and _is_number(following[0].split(",")[0]):
            break
        place += 1
    header = lines[place].lstrip("# ")
    delimiter = next((mark for mark in _DELIMITERS if mark in header), None)
    found = [name.strip().strip('"') for name in header.split(delimiter)]
    missing = [name for name in names if name not in found]
    if missing:
        raise ReadingError(
            f"{path}: it has no column {listed(missing)}; its header has {listed(found)}: "
            "name the columns as they stand there"
        )
    block = [line for line in lines[place + 1 :] if line.strip()]
    used = [found.index(name) for name in names]
    values = numbers_of(
        block, len(found), str(path), first=place + 2, delimiter=delimiter, used=used
    )
    columns = dict(zip(names, values.T, strict=True))
    # People's own tables often lack it.
    whole = text.endswith("\n")
    cut = () if whole else (f"{path}: the last line has no end: is the file whole?",)
    return ColumnFrame(str(path), columns, digits=significant_digits(block, delimiter), notes=cut)


def read_yade_text(path: str | PathLike[str]) -> ColumnFrame:
    r"""Return the spheres that YADE's export.text or export.textExt wrote.

    Parameters
    ----------
    path : path-like
        Its format is told in the line #format; without, it is x_y_z_r.

    Returns
    -------
    ColumnFrame
        x, y, z, radius [m], and id where the file has it.

    Raises
    ------
    ReadingError
        When the format is none of spheres, or a line breaks off.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "spheres.txt")
    ...     _ = path.write_text("#format id_x_y_z_r_matId\n6 0 0 0 0.5 1\n")
    ...     read_yade_text(path).columns["id"].tolist()
    [6.0]
    """
    lines = lines_of(path)
    told = [line.split()[1:] for line in lines if line.startswith("#format")]
    kind = told[0][0][:60] if told and told[0] else "x_y_z_r"
    if kind not in _YADE:
        raise ReadingError(
            f"{path}: its format is {kind}, and one of {', '.join(_YADE)} is needed: write it by "
            "export.textExt(file, format='id_x_y_z_r_matId')"
        )
    names = _YADE[kind].split()
    first = next((n for n, line in enumerate(lines) if not line.startswith("#")), len(lines))
    block = [line for line in lines[first:] if line.strip() and not line.startswith("#")]
    values = numbers_of(block, len(names), str(path), first=first + 1)
    columns = dict(zip(names, values.T, strict=True))
    return ColumnFrame(str(path), columns, digits=significant_digits(block))


def _is_number(word):
    try:
        float(word)
    except ValueError:
        return False
    return True
