"""A known curve, written as every kind of table, is the same curve again when it is read."""

import math

import numpy as np
import openpyxl
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from branchcrush.errors import GradingError
from branchcrush.files.declared import Declared
from branchcrush.files.grading_tables import read_sieve_table

# Openings [mm] with their numbers by ASTM E11 and in Tyler's meshes.
SIEVES = [
    (4.75, "4", "4"),
    (2.0, "10", "9"),
    (0.85, "20", "20"),
    (0.425, "40", "35"),
    (0.25, "60", "60"),
    (0.15, "100", "100"),
    (0.106, "140", "150"),
    (0.075, "200", "200"),
]
WORDS_OF_VALUES = {
    "percent_finer": ["percent passing", "Durchgang in %", "% finer by mass", "passant (%)"],
    "percent_coarser": ["cumulative % retained", "Rückstand kumuliert [%]", "percent coarser"],
    "percent_retained": ["individual percent retained", "% retained (fraction)"],
    "mass_retained": ["mass retained (g)", "Rückstand [g]", "weight in grams"],
}
WORDS_OF_OPENINGS = {
    "size": ["sieve opening (mm)", "Maschenweite [mm]", "mm"],
    "phi": ["phi", "φ", "Phi units"],
    "astm_e11": ["ASTM sieve no.", "US sieve number"],
    "tyler_mesh": ["Tyler mesh"],
}
# Marks between columns, and whether a decimal comma may be written beside them.
MARKS = [(",", False), (";", True), (";", False), ("\t", True), ("\t", False)]
ENCODINGS = ["utf-8", "utf-8-sig", "utf-16", "cp1252"]


@st.composite
def curves(draw):
    """Return openings from fine to coarse, and percent finer that grow from 0 to 100."""
    places = sorted(draw(st.sets(st.integers(0, len(SIEVES) - 1), min_size=4)), reverse=True)
    steps = draw(st.lists(st.integers(1, 40), min_size=len(places) - 1, max_size=len(places) - 1))
    # Halves are exact as decimals, and no step is the only one.
    finer = np.round(np.cumsum([0, *steps]) / sum(steps) * 200) / 2
    return [SIEVES[place] for place in places], finer.tolist()


def columns_of(sieves, finer, values, openings):
    """Return the cells of both columns, from the coarsest sieve down, by hand."""
    kept = [above - below for below, above in zip(finer, [*finer[1:], 100.0], strict=True)]
    numbers = {
        "percent_finer": finer,
        "percent_coarser": [100 - value for value in finer],
        "percent_retained": kept,
        "mass_retained": [value * 2.5 for value in kept],
    }[values]
    names = {
        "size": [repr(size) for size, _, _ in sieves],
        "phi": [repr(-math.log2(size)) for size, _, _ in sieves],
        "astm_e11": [number for _, number, _ in sieves],
        "tyler_mesh": [number for _, _, number in sieves],
    }[openings]
    return names[::-1], [f"{number:g}" for number in numbers][::-1]


def text_of(cells, mark, comma):
    lines = [mark.join(pair) for pair in cells]
    # Words stay as they are; numbers have the comma.
    body = "\n".join(lines[1:]).replace(".", ",") if comma else "\n".join(lines[1:])
    return f"{lines[0]}\n{body}\n"


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    return tmp_path_factory.mktemp("tables") / "sand.csv"


every_table = settings(
    max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


@every_table
@given(
    curve=curves(),
    values=st.sampled_from(list(WORDS_OF_VALUES)),
    openings=st.sampled_from(list(WORDS_OF_OPENINGS)),
    mark=st.sampled_from(MARKS),
    encoding=st.sampled_from(ENCODINGS),
    pan=st.booleans(),
    data=st.data(),
)
def test_what_is_written_as_declared_is_the_same_curve(
    path, curve, values, openings, mark, encoding, pan, data
):
    sieves, finer = curve
    names, numbers = columns_of(sieves, finer, values, openings)
    head = (
        data.draw(st.sampled_from(WORDS_OF_OPENINGS[openings])),
        data.draw(st.sampled_from(WORDS_OF_VALUES[values])),
    )
    if encoding == "cp1252":
        head = tuple(word.replace("φ", "phi") for word in head)
    cells = [head, *zip(names, numbers, strict=True)]
    if pan and values.endswith("retained"):
        cells.append(
            (data.draw(st.sampled_from(["pan", "Boden", "0" * (openings != "phi") or "pan"])), "0")
        )
    path.write_bytes(text_of(cells, *mark).encode(encoding))
    declared = Declared(values=values, openings=openings)
    table = read_sieve_table(path, declared)
    assert_allclose(table.sizes, [size for size, _, _ in sieves], rtol=1e-12)
    assert_allclose(table.values, finer, atol=1e-9)
    # Without keys it is the same, or refused with those that were meant.
    try:
        table = read_sieve_table(path)
    except GradingError as error:
        assert f"values: {values}, openings: {openings}" in str(error)
    else:
        assert (values, openings) == ("percent_finer", "size")
        assert_allclose(table.values, finer, atol=1e-9)


@every_table
@given(
    curve=curves(),
    values=st.sampled_from(list(WORDS_OF_VALUES)),
    openings=st.sampled_from(list(WORDS_OF_OPENINGS)),
    other=st.tuples(
        st.sampled_from(list(WORDS_OF_VALUES)), st.sampled_from(list(WORDS_OF_OPENINGS))
    ),
)
def test_what_the_words_speak_against_is_refused_with_every_reading(
    path, curve, values, openings, other
):
    if other == (values, openings):
        return
    names, numbers = columns_of(*curve, values, openings)
    head = (WORDS_OF_OPENINGS[openings][0], WORDS_OF_VALUES[values][0])
    path.write_text(text_of([head, *zip(names, numbers, strict=True)], ",", False))
    with pytest.raises(GradingError, match="disagree") as refused:
        read_sieve_table(path, Declared(values=other[0], openings=other[1]))
    assert f"values: {values}, openings: {openings}` D50 = " in str(refused.value)


@pytest.mark.parametrize("text", [False, True], ids=["numbers", "text with decimal commas"])
def test_workbook_is_read_as_a_text_is(path, text):
    book = openpyxl.Workbook()
    book.active.append(["Siebung 3", None])
    book.active.append(["Maschenweite [mm]", "Durchgang in %"])
    for size, finer in ((2.0, 100.0), (0.5, 62.5), (0.25, 0.0)):
        row = (size, finer)
        book.active.append([str(cell).replace(".", ",") for cell in row] if text else row)
    workbook = path.with_suffix(".xlsx")
    book.save(workbook)
    table = read_sieve_table(workbook)
    assert table.sizes.tolist() == [0.25, 0.5, 2.0]
    assert table.values.tolist() == [0.0, 62.5, 100.0]
