"""Whether a sieve table is what it is declared to be: its words and numbers against the keys."""

from collections.abc import Iterator
from itertools import pairwise

from branchcrush.errors import GradingError
from branchcrush.files.columns import Table
from branchcrush.files.declared import WORDS, Declared
from branchcrush.files.openings import UNITS_IN_MM, Label, label_of
from branchcrush.files.rows import Row
from branchcrush.files.sieve_tables import sieve_curve, sum_of, value_of
from branchcrush.gradings.sieves import ASTM_E11_NUMBERS, TYLER_MESHES, is_nominal
from branchcrush.gradings.tables import from_percent_finer

_KEYS = ("values", "openings")


def contradictions(table: Table, declared: Declared) -> list[str]:
    """Return where the words and numbers of a table speak against what it is declared to be.

    Parameters
    ----------
    table : Table
    declared : Declared

    Returns
    -------
    list of str
        One line at most, with every reading that is possible and the D50 that it gives.

    Examples
    --------
    >>> from branchcrush.files.columns import TextRow
    >>> rows = [TextRow(2, ("0", "0")), TextRow(3, ("1", "50")), TextRow(4, ("2", "100"))]
    >>> contradictions(Table(rows, ["phi", "finer"]), Declared())[0][:58]
    'the file and the keys disagree: the words "phi" say openin'
    """
    against = _words_against(table, declared)
    said = bool(against)
    curve = sieve_curve(table, declared)
    against = against or _numbers_against(table, declared, curve)
    if not against:
        return []
    others = _other_readings(table, declared, said or bool(curve.problems))
    if not others and not said:
        return []
    return [_disagreement(against, declared, curve, others, table)]


def _words_against(table, declared):
    """Return which keys the words above the columns speak against."""
    words, against = table.words, []
    for key, said, meant, heading in (
        ("openings", words.openings(), declared.scale_of_openings, words.opening or words.title),
        ("values", words.values(), declared.kind, words.value or words.title),
        ("unit", words.units(), declared.unit, words.opening or words.title),
    ):
        if key == "unit" and declared.scale_of_openings != "size":
            continue
        if said and meant not in said:
            given = "" if key == "unit" or getattr(declared, key) else ", the default"
            meanings = " or ".join(sorted(said))
            against.append(
                f'the words "{heading}" say {key}: {meanings}, not {key}: {meant}{given}'
            )
    return against


def _numbers_against(table, declared, curve):
    """Return what the numbers say against the keys, where neither words nor keys settle it."""
    against = []
    labels = [label_of(row.cells[0]) for row in table.rows]
    affirmed = declared.openings or table.words.openings() == {"size"}
    if declared.scale_of_openings == "size":
        if _named(labels, declared.unit):
            against.append("the openings are numbers or inches that sieves are called by")
        elif any(label.kind == "number" and label.value < 0 for label in labels):
            against.append("openings below 0 are none of sizes, and usual in phi")
        elif not affirmed and _like_meshes(labels, declared.unit):
            against.append("the openings are all numbers that sieves have in mesh or by ASTM E11")
        elif not affirmed and _like_phi(labels, declared.unit):
            against.append("the openings grow by equal steps, as phi does, and few are of sieves")
    pattern = _pattern(table.rows, declared)
    if not against and (curve.problems or (pattern == "sum" and not declared.values)):
        if pattern == "sum":
            against.append("the values sum to 100, as percent retained on each sieve do")
        elif pattern in ("falls", "each") and declared.kind == "percent_finer":
            against.append("the values do not grow with the openings, as percent finer do")
        elif pattern in ("rises", "each") and declared.kind == "percent_coarser":
            against.append("the values do not fall as openings grow, as percent coarser do")
        elif pattern in ("rises", "falls") and declared.kind == "percent_retained":
            against.append("the values grow to a whole, as percent finer or coarser do")
    return against


def _named(labels, unit):
    """Return whether openings are names that standards give: No. 40, 3/8."""
    return any(
        label.kind == "mesh" or (label.kind == "inch" and unit != "inch") for label in labels
    )


def _numbers(labels: list[Label]) -> list[float]:
    return [label.value for label in labels if label.kind == "number" and not label.unit]


def _like_meshes(labels, unit):
    """Return whether openings can be numbers of sieves, and hardly sizes."""
    numbers = [value for value in _numbers(labels) if value]
    meshes = {*ASTM_E11_NUMBERS, *TYLER_MESHES}
    if len(numbers) < 4 or not all(value in meshes for value in numbers):
        return False
    odd = sum(not is_nominal(value * UNITS_IN_MM[unit]) for value in numbers)
    # Micrometres are as large as that; of centimetres and metres no sieve is made.
    return odd >= 2 if unit == "um" else odd >= 1 or max(numbers) >= 60


def _like_phi(labels, unit):
    """Return whether openings have the equal steps of phi, and are not those of sieves."""
    numbers = sorted(_numbers(labels))
    steps = [high - low for low, high in pairwise(numbers)]
    # Who has phi and has to give a unit gives that of phi.
    if unit != "mm" or len(steps) < 4 or numbers[0] < -12 or numbers[-1] > 14:
        return False
    common = max(set(steps), key=steps.count)
    odd = sum(value <= 0 or not is_nominal(value * UNITS_IN_MM[unit]) for value in numbers)
    return common in (0.25, 0.5, 1.0) and steps.count(common) >= 0.7 * len(steps) and odd >= 2


def _pattern(rows, declared):
    """Return how values go on by the order of openings: rises, falls, sum, each, or slip."""
    pairs = []
    for row in rows:
        label, value = label_of(row.cells[0]), value_of(row.cells[1])
        if value is not None and label.kind in ("number", "mesh", "inch", "pan", "below"):
            pairs.append((0.0 if label.kind in ("pan", "below") else label.value, value))
    values = [value for _, value in sorted(pairs)]
    up = sum(high > low for low, high in pairwise(values))
    down = sum(high < low for low, high in pairwise(values))
    if len(values) > 2 and abs(sum_of(values) - 100) <= 1 and max(values) < 99.5:
        return "sum"
    if declared.scale_of_openings == "phi":
        up, down = down, up
    if not down or not up:
        return "rises" if up else "falls"
    # One that turns back is a slip; of what each sieve holds, the most is between the ends.
    most = max(values)
    inside = most not in (values[0], values[-1])
    return "each" if inside and (min(up, down) > 1 or values[-1] < most / 2) else "slip"


def _other_readings(table, declared, free):
    """Return the readings that words and numbers allow, those that change least first."""
    readings = [
        reading
        for reading in _candidates(table, declared, free)
        if not _same(reading, declared) and not sieve_curve(table, reading).problems
    ]
    changes = {
        reading: sum(
            getattr(reading, key) != getattr(declared, key)
            for key in ("kind", "scale_of_openings", "unit")
        )
        for reading in readings
    }
    return sorted(readings, key=changes.get)


def _same(reading, declared):
    return (reading.kind, reading.scale_of_openings, reading.unit) == (
        declared.kind,
        declared.scale_of_openings,
        declared.unit if declared.scale_of_openings == "size" else "mm",
    )


def _candidates(table, declared, free) -> Iterator[Declared]:
    """Yield the readings that the words above the columns allow, and the numbers suggest."""
    words, pattern = table.words, _pattern(table.rows, declared)
    labels = [label_of(row.cells[0]) for row in table.rows]
    openings = words.openings() or _suggested(labels, declared, free)
    values = words.values() or set(WORDS["values"])
    if not words.values() and pattern != "each":
        # Grams can be any numbers.
        values = values - {"mass_retained"}
    if declared.values and not words.values() and not free:
        values = {declared.values}
    if "percent_retained" in values and pattern == "sum":
        values = values - {"mass_retained"}
    units = words.units() or {declared.unit}
    for opening in WORDS["openings"]:
        for value in WORDS["values"]:
            for unit in sorted(units & set(UNITS_IN_MM)) if opening == "size" else ["mm"]:
                if opening in openings and value in values:
                    yield declared.other(value, opening, unit)


def _suggested(labels, declared, free):
    """Return which openings numbers allow."""
    if _named(labels, declared.unit):
        return {"astm_e11", "tyler_mesh"}
    kinds = {declared.scale_of_openings} | ({"size"} if free else set())
    numbers = _numbers(labels)
    if _like_phi(labels, declared.unit) or any(value < 0 for value in numbers):
        kinds.add("phi")
    if _like_meshes(labels, declared.unit):
        kinds |= {"astm_e11", "tyler_mesh"}
    return kinds


def _disagreement(against, declared, curve, others, table):
    """Return all readings with their D50, in one line."""
    own = _own(declared)
    if curve.problems:
        own += f" it cannot be read ({curve.problems[0]})"
    else:
        own += f" D50 = {_shown(curve.rows, declared.unit)}"
    what = "; ".join(against)
    if not others:
        return (
            f"the file and the keys disagree: {what}; {own}, and as the words say it cannot be: "
            "correct the words or the keys"
        )
    read, asked = [], set()
    for other in others:
        keys = {key: other.taken(key) for key in _KEYS}
        keys |= {"unit": other.unit} if other.unit != declared.unit else {}
        rows = sieve_curve(table, other).rows
        ends = _ends(rows, declared)
        asked |= set(ends.values())
        read.append(f"as `{declared.advice({**keys, **ends})}` D50 = {_shown(rows, other.unit)}")
    keep, ends = _correct(table, declared, curve)
    return (
        f"the file and the keys disagree: {what}. Read {own}; read {'; '.join(read)}. "
        f"{_to_do(declared, asked | set(ends.values()), others)}{keep}"
    )


def _own(declared):
    """Return how the table would be read, and which of it was declared."""
    given = tuple(key for key in _KEYS if getattr(declared, key))
    taken = tuple(key for key in _KEYS if key not in given)
    own = " and ".join(
        f"{how} ({declared.keys(keys)})"
        for how, keys in (("as declared", given), ("as by default", taken))
        if keys
    )
    return f"{own}, in {declared.unit}," if declared.scale_of_openings == "size" else own


def _ends(rows, declared):
    """Return which ends of a curve a command has to give, with words in place of the sizes."""
    if declared.typed is None:
        return {}
    low = rows[0].values[1] > 0 and declared.smallest is None
    high = rows[-1].values[1] < 100 and declared.largest is None
    return ({"min": "SMALLEST"} if low else {}) | ({"max": "LARGEST"} if high else {})


def _to_do(declared, asked, others):
    """Return what to do with the reading that is meant."""
    if declared.typed is None:
        return "Paste the keys that are meant into the grading"
    units = {other.unit for other in others}
    unit = units.pop() if len(units) == 1 else "its unit"
    sizes = " and ".join(
        f"the size of the {word.lower()} grain in {unit} for {word}" for word in sorted(asked)
    )
    return "Type the command that is meant" + (f", with {sizes}" if asked else "")


def _correct(table, declared, curve):
    """Return how to keep what is declared, if it can be kept, and which ends that asks for."""
    if curve.problems:
        return "", {}
    if table.words.openings() or table.words.values() or table.words.units():
        return ", or, if these are the wrong words, correct them in the file", {}
    ends = _ends(curve.rows, declared)
    keys = {key: declared.taken(key) for key in _KEYS}
    return f", or `{declared.advice({**keys, **ends})}` to read it so", ends


def _shown(rows: list[Row], unit: str) -> str:
    """Return the D50 of a curve in words."""
    sizes = [row.values[0] for row in rows]
    finer = [row.values[1] for row in rows]
    if not finer[0] < 50 < finer[-1]:
        if 50 in finer:
            return f"{sizes[finer.index(50)]:.3g} {unit}"
        side = f"below {sizes[0]:g}" if finer[0] >= 50 else f"above {sizes[-1]:g}"
        return f"{side} {unit}"
    try:
        # Cut ends do not move it by much, and it is to be the one that a run would have.
        ends = ([sizes[0] / 2] if finer[0] else []), ([sizes[-1] * 2] if finer[-1] < 100 else [])
        size = [*ends[0], *sizes, *ends[1]]
        whole = [*([0.0] if ends[0] else []), *finer, *([100.0] if ends[1] else [])]
        return f"{float(from_percent_finer(size, whole).mass_ppf(0.5)):.3g} {unit}"
    except GradingError:
        return f"between {sizes[0]:g} and {sizes[-1]:g} {unit}"
