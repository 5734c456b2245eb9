"""The text of a file, whatever program wrote it: UTF-8, UTF-16 with its mark, Windows-1252."""

import re
from os import PathLike
from pathlib import Path

from branchcrush.errors import GradingError

# A table of a million sizes has some 20 MB.
_LARGEST = 50_000_000
# What begins a zip (.xlsx, .ods) and a workbook of old (.xls).
ZIP, OLD_WORKBOOK = b"PK\x03\x04", b"\xd0\xcf\x11\xe0"


def raw_content(path: str | PathLike[str]) -> bytes:
    """Return the bytes of a file that a user named.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    bytes

    Raises
    ------
    GradingError
        When it is missing, a folder, of more than 50 MB, or cannot be read.

    Examples
    --------
    >>> raw_content("nowhere.csv")
    Traceback (most recent call last):
    branchcrush.errors.GradingError: nowhere.csv: there is no such file in ...
    """
    path = Path(path)
    if path.is_dir():
        raise GradingError(f"{path}: is a folder; give the name of a file in it")
    try:
        if path.stat().st_size > _LARGEST:
            raise GradingError(
                f"{path}: has more than the {_LARGEST / 1e6:g} MB that a table may have: write it "
                "with fewer digits or fewer lines"
            )
        return path.read_bytes()
    except FileNotFoundError:
        raise GradingError(
            f"{path}: there is no such file in {Path.cwd()}; names are relative to that folder"
        ) from None
    except OSError as error:
        raise GradingError(f"{path}: cannot be read: {error.strerror}") from None


def decoded(raw: bytes, path: str | PathLike[str]) -> str:
    r"""Return the text that bytes are, its lines ended by line feeds.

    Parameters
    ----------
    raw : bytes
    path : path-like
        Begins a message.

    Returns
    -------
    str

    Raises
    ------
    GradingError
        When they are no text, or there is none.

    Examples
    --------
    >>> decoded("Öffnung".encode("cp1252"), "sand.csv")
    'Öffnung'
    """
    # The mark that spreadsheets begin "Unicode text" with.
    marked = raw[:2] in (b"\xff\xfe", b"\xfe\xff")
    text = None
    for encoding in ["utf-16"] if marked else ["utf-8-sig", "cp1252"]:
        try:
            text = raw.decode(encoding)
            break
        except UnicodeDecodeError:
            continue
    # Any bytes but five are Windows-1252; those of a picture hold control characters too.
    if text is None or re.search(r"[\x00-\x08\x0e-\x1f\x7f]", text):
        old = raw[:4] == OLD_WORKBOOK
        hint = " (it is an old .xls)" if old else ""
        raise GradingError(
            f"{path}: is no text in UTF-8, UTF-16 or Windows-1252{hint}; save the table as CSV in "
            "UTF-8 or as .xlsx"
        )
    if not text.strip():
        raise GradingError(f"{path}: is empty; write one row of numbers on each line")
    return text.replace("\r\n", "\n").replace("\r", "\n")
