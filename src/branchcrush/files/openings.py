"""What the first cell of a row says: an opening, a sieve of a standard, the pan, the total."""

import re
from fractions import Fraction
from typing import NamedTuple

from branchcrush.errors import GradingError
from branchcrush.files.headers import plain_words
from branchcrush.gradings.sieves import opening_of, size_of_phi

# [mm]
UNITS_IN_MM = {"m": 1e3, "cm": 10.0, "mm": 1.0, "um": 1e-3, "inch": 25.4}
_UNIT_WORDS = {
    "mm": "mm", "um": "um", "micron": "um", "microns": "um", "cm": "cm", "m": "m", "in": "inch",
    "in.": "inch", "inch": "inch", "inches": "inch", '"': "inch", "''": "inch", "zoll": "inch",
}  # fmt: skip
_PAN = {
    "pan", "boden", "bottom", "receiver", "fond", "siebboden", "bodenschale", "auffangschale",
    "schale", "bottom pan", "bac", "recipient", "fines", "base", "collector",
}  # fmt: skip
_TOTAL = {
    "total", "summe", "sum", "gesamt", "totals", "somme", "total mass", "sum total", "gesamtmasse",
    "masse totale", "gesamtsumme", "insgesamt", "grand total", "total weight",
}  # fmt: skip
# So far beyond any grain that it is no size at all [mm]; what is nearer is refused by its unit.
_LEAST, _MOST = 1e-12, 1e12
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?"
_SIZE = re.compile(rf"({_NUMBER})\s*([a-z.\"']+)?")
_MESH = re.compile(
    rf"(?:sieve\s*|sieb\s*)?(?:#|no\.?|nr\.?|n°|nº|mesh)\s*({_NUMBER})(?:\s*mesh)?|({_NUMBER})\s*(?:mesh|#)"
)
_INCH = re.compile(r"(?:(\d+)[\s-]+)?(\d+)\s*/\s*(\d+)\s*(?:in\.?|inch(?:es)?|\"|'')?")
_BELOW = re.compile(rf"(?:<|unter|below|under|minus|passing)\s*({_NUMBER})\s*([a-z.\"']+)?")


class Label(NamedTuple):
    """What a cell says: its kind, a number, and the unit that stands beside it, if one does.

    The kinds are number, mesh, inch, below, pan, total and words.
    """

    kind: str
    value: float
    unit: str | None
    text: str


def label_of(cell: str) -> Label:
    """Return what a cell of openings says.

    Parameters
    ----------
    cell : str

    Returns
    -------
    Label

    Examples
    --------
    >>> [label_of(cell)[:3] for cell in ("#40", "3/8 in", "63 µm", "Boden")]
    [('mesh', 40.0, None), ('inch', 0.375, None), ('number', 63.0, 'um'), ('pan', 0.0, None)]
    """
    text = plain_words(cell)
    bare = text.strip(" .:()")
    if bare in _PAN:
        return Label("pan", 0.0, None, cell)
    if bare in _TOTAL or bare == "∑" or bare == "σ":
        return Label("total", 0.0, None, cell)
    if match := _MESH.fullmatch(text):
        return Label("mesh", float(match[1] or match[2]), None, cell)
    if (match := _INCH.fullmatch(text)) and int(match[3]):
        size = int(match[1] or 0) + Fraction(int(match[2]), int(match[3]))
        return Label("inch", float(size), None, cell)
    for kind, pattern in (("number", _SIZE), ("below", _BELOW)):
        match = pattern.fullmatch(text)
        if match and (not match[2] or match[2] in _UNIT_WORDS):
            return Label(kind, float(match[1]), _UNIT_WORDS.get(match[2]), cell)
    return Label("words", 0.0, None, cell)


def size_of(label: Label, openings: str, unit: str) -> float:
    """Return the size that a label means.

    Parameters
    ----------
    label : Label
        Of a number, a sieve's number or inches.
    openings : {"size", "phi", "astm_e11", "tyler_mesh"}
        What numbers without a unit are.
    unit : {"m", "cm", "mm", "um", "inch"}
        Of sizes without one, and of what is returned.

    Returns
    -------
    float
        In the unit.

    Raises
    ------
    GradingError
        When it means none.

    Examples
    --------
    >>> size_of(label_of("-1"), "phi", "mm"), size_of(label_of("40"), "astm_e11", "um")
    (2.0, 425.0)
    """
    inch = label.kind == "inch" and unit == "inch"
    as_it_stands = inch or (label.kind in ("number", "below") and label.unit in (None, unit))
    if openings == "size" and as_it_stands:
        size = label.value
    else:
        size = _size_in_mm(label, openings) / UNITS_IN_MM[unit]
        # 0.425 / 1e-3 has one digit too many.
        size = float(f"{size:.15g}") if openings != "phi" else size
    if size > 0 and not _LEAST <= size * UNITS_IN_MM[unit] <= _MOST:
        raise GradingError(f"{label.text[:60]!r} is no size of a grain")
    return size


def _size_in_mm(label, openings):
    if label.unit == "inch" and openings in ("astm_e11", "tyler_mesh"):
        return opening_of(label.value, openings, inches=True)
    if label.unit and label.kind in ("number", "below"):
        return label.value * UNITS_IN_MM[label.unit]
    if openings in ("astm_e11", "tyler_mesh") and label.kind in ("number", "mesh", "inch"):
        return opening_of(label.value, openings, label.kind == "inch")
    if openings == "phi" and label.kind == "number":
        return size_of_phi(label.value)
    raise GradingError(f"{label.text!r} is no number")
