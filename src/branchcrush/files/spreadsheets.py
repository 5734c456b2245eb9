"""Sheets of a workbook (.xlsx) as lines of cells, as text files have them."""

import datetime
import io
import warnings
import zipfile
from os import PathLike

from branchcrush.errors import GradingError

# Unpacked, and in cells: a table of a million sizes has less. A few bytes can stand for any number.
_LARGEST, _MOST_CELLS = 200_000_000, 3_000_000


def workbook_cells(
    raw: bytes, path: str | PathLike[str], sheet: str | int | None = None
) -> tuple[list[list[str]], str, list[str]]:
    """Return the cells of one sheet as text, row by row from the first.

    Parameters
    ----------
    raw : bytes
        Of the workbook.
    path : path-like
        Begins a message.
    sheet : str or int, optional
        Its name, or its number from 1; the first when left out.

    Returns
    -------
    rows : list of list of str
        Cells that are shown as percent are numbers of percent.
    name : str
        Of the sheet.
    others : list of str
        Names of the other sheets.

    Raises
    ------
    GradingError
        When it is no workbook, or has no such sheet.

    Examples
    --------
    >>> import openpyxl
    >>> book, content = openpyxl.Workbook(), io.BytesIO()
    >>> book.active.append([0.5, "all"])
    >>> book.save(content)
    >>> workbook_cells(content.getvalue(), "sand.xlsx")
    ([['0.5', 'all']], 'Sheet', [])
    """
    import openpyxl  # slow to import, for workbooks alone

    try:
        with zipfile.ZipFile(io.BytesIO(raw)) as archive:
            size = sum(each.file_size for each in archive.infolist())
        if size > _LARGEST:
            raise GradingError(
                f"{path}: has more than the {_LARGEST / 1e6:g} MB that a table may have when it is "
                "unpacked: save the one sheet as CSV"
            )
        with warnings.catch_warnings():
            # Of styles and extensions that no table of numbers needs.
            warnings.simplefilter("ignore")
            shown = openpyxl.load_workbook(io.BytesIO(raw), data_only=True)
            typed = openpyxl.load_workbook(io.BytesIO(raw))
    except GradingError:
        raise
    except Exception:  # whatever openpyxl meets in what is none: it has no error of its own
        raise GradingError(
            f"{path}: is no text in UTF-8 and no workbook (.xlsx); save the table as CSV in UTF-8 "
            "or as .xlsx"
        ) from None
    names = [each.title for each in shown.worksheets]
    name = _chosen(names, sheet, path)
    cells = shown[name].max_row * shown[name].max_column
    if cells > _MOST_CELLS:
        raise GradingError(
            f"{path}: sheet '{name}' goes to row {shown[name].max_row} and column "
            f"{shown[name].max_column}, and may have {_MOST_CELLS} cells: save the table alone"
        )
    rows = [
        [_text(cell, written.value) for cell, written in zip(row, formulas, strict=True)]
        for row, formulas in zip(shown[name].iter_rows(), typed[name].iter_rows(), strict=True)
    ]
    return rows, name, [other for other in names if other != name]


def _chosen(names, sheet, path):
    """Return the name of the sheet that is asked for."""
    if not names:
        raise GradingError(f"{path}: has no sheet of cells; save the table as CSV in UTF-8")
    if sheet is None:
        return names[0]
    if sheet in names:
        return sheet
    if isinstance(sheet, int) and 1 <= sheet <= len(names):
        return names[sheet - 1]
    quoted = ", ".join(f"'{name}'" for name in names)
    raise GradingError(f"{path}: sheet = {sheet!r}: there is none; the sheets are {quoted}")


def _text(cell, written):
    """Return what a cell shows, as text that says a number with all its digits."""
    value = cell.value
    if value is None:
        formula = isinstance(written, str) and written.startswith("=")
        # Else a row would go missing without a word.
        return f"{written} (never calculated: open and save the workbook)" if formula else ""
    if isinstance(value, bool):
        return str(value)
    if isinstance(value, (datetime.date, datetime.time)):
        return f"the date {value:%Y-%m-%d} (set the cell to text)" if hasattr(value, "year") else ""
    if isinstance(value, (int, float)) and "%" in str(cell.number_format):
        # 0.07 * 100 is 7.000000000000001.
        return repr(float(f"{value * 100:.12g}"))
    return repr(value) if isinstance(value, (int, float)) else str(value).strip()
