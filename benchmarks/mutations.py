"""Files damaged in the ways in which files are: cut, spliced, edited by hand, of other programs.

Every choice is one of the generator that is given: a seeded one, or one that Hypothesis leads.
"""

import io
import re
import zipfile

# What a cell may hold that is no usual number.
ODD_NUMBERS = (
    "0", "-1", "-0", "nan", "inf", "-inf", "1e308", "-1e308", "1.7976931348623157e308", "1e-320",
    "5e-324", "1e400", "1e18", "1e19", "1e30", "0.5", "3", "100", "1e6", "0x10", "0170", "1_000",
    "1,5", "1;5", "1:30", "٣", "²", "½", "1e", "-", "+", ".", "9" * 400, "0." + "3" * 60,
    "9223372036854775808", "-9223372036854775809", "4294967296", "1.0000000000000002", "1d3", "",
)  # fmt: skip
ODD_WORDS = (
    b"", b"#", b"# ", b"#4", b"pan", b"total", b"ITEM:", b"ITEM: ATOMS", b"ITEM: BOX BOUNDS",
    b"True", b"null", b"~", b"!!bool x", b"!!int ''", b"!!timestamp x", b"&a", b"*a", b"<<: *a",
    b"{", b"}", b"[", b"]", b": ", b"- ", b"'", b'"', b"|", b">", b"%", b"\t", b"\r", b"\n",
    b"\n\n", b"\x00", b"\x0c", b"\x1c", b"\x85", b"\xc2\x85", b"\xe2\x80\xa8", b"\xef\xbb\xbf",
    b"\xff\xfe", b"\xb5", b"\xc3", "é".encode(), "µm".encode(), "‏".encode(), b"id", b"x",
    b"radius", b"__a__", b"POINTS 3 double", b"LINES 2 6", b"POINT_DATA 4", b"CELL_DATA 9",
    b"SCALARS a double 1", b"VECTORS", b"LOOKUP_TABLE", b"#format x_y_z_r", b"#format",
    b"2020-13-45", b"12:30:45",
)  # fmt: skip
_NUMBER = re.compile(rb"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")
_WORD = re.compile(rb"[^\s,;:]+")
_MARKS = (b",", b";", b"\t", b" ", b"\n", b"\r\n", b"|", b".")
# Of text around a place, in which a number or a word is looked for.
_NEAR = 400
# What grows stays fast to read.
_MOST = 300_000


def mutated(rng, data, others=()):
    """Return a file damaged in one to five ways.

    Parameters
    ----------
    rng : random.Random
    data : bytes
    others : sequence of bytes
        Of other files, which its end may be taken from.

    Returns
    -------
    bytes
    """
    if data[:4] == b"PK\x03\x04" and rng.random() < 0.8:
        return _of_archive(rng, data, others)
    for _ in range(rng.choice((1, 1, 1, 2, 3, 5))):
        data = rng.choice(_WAYS)(rng, data, others)[:_MOST]
    return data


def _of_archive(rng, data, others):
    """Return a zip with one of its files damaged."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    name = rng.choice([*files, *(name for name in files if "sheet" in name)] * 2)
    files[name] = mutated(rng, files[name], others)
    written = io.BytesIO()
    with zipfile.ZipFile(written, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return written.getvalue()


def _place(rng, data):
    return rng.randrange(len(data) + 1)


def _byte(rng, data, others):
    place = _place(rng, data)
    return data[:place] + bytes([rng.randrange(256)]) + data[place + 1 :]


def _cut_out(rng, data, others):
    first, last = sorted((_place(rng, data), _place(rng, data)))
    if rng.random() < 0.7:
        last = min(last, first + rng.choice((1, 2, 10, 100)))
    return data[:first] + data[last:]


def _cut_off(rng, data, others):
    return data[: _place(rng, data)]


def _twice(rng, data, others):
    first = _place(rng, data)
    part = data[first : first + rng.choice((1, 5, 50, 500, 5000))]
    return data[:first] + part * rng.choice((2, 2, 3, 100)) + data[first:]


def _insert(rng, data, others):
    place = _place(rng, data)
    return data[:place] + rng.choice(ODD_WORDS) + data[place:]


def _long(rng, data, others):
    """Put in what is longer than any cell, with a quote before it or without."""
    place = _place(rng, data)
    part = rng.choice((b"7", b"a", b"a b ", b"1,", b"[", b"- ", b"(")) * rng.choice(
        (30, 3000, 140_000)
    )
    return data[:place] + rng.choice((b"", b'"', b"\n")) + part + data[place:]


def _replace(pattern, choices):
    """Return a way: something that a pattern finds near a place becomes another thing."""

    def replace(rng, data, others):
        place = _place(rng, data)
        found = pattern.search(data, max(0, place - 1), place + _NEAR)
        if found is None:
            return data
        chosen = rng.choice(choices)
        chosen = chosen if isinstance(chosen, bytes) else chosen.encode()
        return data[: found.start()] + chosen + data[found.end() :]

    return replace


def _lines(rng, data, others):
    """Delete, repeat, exchange or move lines."""
    lines = data.split(b"\n")
    one, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    what = rng.choice(("delete", "repeat", "exchange", "move", "join", "often"))
    if what == "delete":
        del lines[one : one + rng.choice((1, 1, 2, 9))]
    elif what == "repeat":
        lines.insert(other, lines[one])
    elif what == "exchange":
        lines[one], lines[other] = lines[other], lines[one]
    elif what == "move":
        lines.insert(other, lines.pop(one))
    elif what == "join":
        lines[one : one + 2] = [b" ".join(lines[one : one + 2])]
    else:
        lines[one:one] = [lines[one]] * min(rng.choice((10, 1000)), _MOST // (len(lines[one]) + 1))
    return b"\n".join(lines)


def _column(rng, data, others):
    """Take a column away or give each line one more."""
    mark, place = rng.choice(_MARKS[:4]), rng.randrange(6)
    lines = []
    for line in data.split(b"\n"):
        cells = line.split(mark)
        if len(cells) > place:
            cells[place : place + 1] = rng.choice(([], [cells[place]] * 2, [b""]))
        lines.append(mark.join(cells))
    return b"\n".join(lines)


def _other_marks(rng, data, others):
    return data.replace(rng.choice(_MARKS), rng.choice(_MARKS))


def _splice(rng, data, others):
    other = rng.choice((data, *others))
    return data[: _place(rng, data)] + other[_place(rng, other) :]


_WAYS = (
    _byte, _cut_out, _cut_off, _twice, _insert, _long, _lines, _lines, _column, _other_marks,
    _splice,
    _replace(_NUMBER, ODD_NUMBERS), _replace(_NUMBER, ODD_NUMBERS), _replace(_NUMBER, ODD_NUMBERS),
    _replace(_WORD, (*ODD_NUMBERS, *ODD_WORDS)), _replace(_WORD, ODD_WORDS),
)  # fmt: skip
