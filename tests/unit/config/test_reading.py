"""How tables of the kinds that laboratories write are read: right as declared, else refused."""

from pathlib import Path

import openpyxl
import pytest
from numpy.testing import assert_allclose

from branchcrush.config.build import grading_of
from branchcrush.config.reading import grading_report
from branchcrush.files.declared import WORDS

DATA = Path(__file__).resolve().parents[2] / "data" / "gradings"
MM = {"form": "sieve", "basis": "mass", "size": "diameter", "unit": "mm"}
LASER = {**MM, "form": "histogram", "unit": "um", "file": str(DATA / "laser_channels.csv")}
BEACH = {**MM, "file": str(DATA / "phi_cumulative_coarser.csv")}
SHEET = {**MM, "file": str(DATA / "mass_retained_and_pan.csv")}
SOIL = {**MM, "file": str(DATA / "fines_below_last_sieve.csv")}


@pytest.fixture
def report_of(tmp_path):
    """Return a function that writes a table and reports how a section reads it."""

    def report(content, **keys):
        path = tmp_path / "sand.csv"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return grading_report({**MM, "file": str(path), **keys})

    return report


def only_problem(report):
    assert report.d_values == {}
    (line,) = report.problems
    return line


# --- tables of laboratories ----------------------------------------------------------------------


def test_phi_with_cumulative_coarser_is_refused_with_both_medians_and_read_when_declared():
    line = only_problem(grading_report(BEACH))
    assert 'the words "phi" say openings: phi' in line
    assert "D50 = 1.98 mm" in line
    assert "`values: percent_coarser, openings: phi` D50 = 0.253 mm" in line
    report = grading_report({**BEACH, "openings": "phi", "values": "percent_coarser"})
    # Between 51 % at phi 2 and 18 % at 1.5.
    assert report.d_values["D50"] == pytest.approx(0.2526, abs=5e-4)
    assert any("phi, -log2" in line for line in report.meaning)


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        ({"sizes": "middles", "scale": "log"}, (82, 200, 486)),
        ({"sizes": "lower"}, (87, 212, 516)),
        ({"sizes": "upper"}, (78, 189, 460)),
    ],
)
def test_channels_of_a_laser_have_the_sizes_that_are_declared(keys, expected):
    for basis in ("mass", "volume"):
        report = grading_report({**LASER, "basis": basis, **keys})
        sizes = [report.d_values[name] for name in ("D10", "D50", "D90")]
        assert_allclose(sizes, expected, atol=1.0)


def test_channels_of_a_laser_are_no_density():
    line = only_problem(grading_report({**LASER, "form": "density"}))
    assert "per: size` D50 = 324 um" in line
    for kind, median in (("middles", 200), ("lower", 212), ("upper", 189)):
        assert f"form: histogram, basis: mass, sizes: {kind}, scale: log` D50 = {median} um" in line


def test_scale_of_middles_is_asked_for_and_held_against_the_sizes():
    line = only_problem(grading_report({**LASER, "sizes": "middles"}))
    assert line.startswith("grading.scale = nothing: must be 'log' or 'linear'")
    line = only_problem(grading_report({**LASER, "sizes": "middles", "scale": "linear"}))
    assert "they do by scale: log" in line


def test_grams_with_a_pan_are_asked_for_the_smallest_grain_once():
    line = only_problem(grading_report(SHEET))
    assert "values: mass_retained" in line and "correct it" not in line.split("; read")[1]
    line = only_problem(grading_report({**SHEET, "values": "mass_retained"}))
    assert "1.22 at the smallest opening 0.075; how small is the smallest grain?" in line
    section = {**SHEET, "values": "mass_retained", "min": 0.02}
    grading = grading_of(section)
    # 6.1, 36.5, 216.7, 427.4 and 487.5 of 500 g below each sieve.
    shares = grading.mass_cdf([0.5e-3 * size for size in (0.02, 0.075, 0.15, 0.425, 1, 2)])
    assert_allclose(shares, [0, 0.0122, 0.073, 0.4334, 0.8548, 0.975], atol=1e-12)
    assert any("the total agrees" in line for line in grading_report(section).meaning)


def test_fines_below_the_last_sieve_are_asked_for_and_go_down_to_the_smallest_grain():
    line = only_problem(grading_report(SOIL))
    assert "percent finer = 7 at the smallest opening 0.075; how small" in line
    grading = grading_of({**SOIL, "min": 0.01})
    assert grading.support()[0] == pytest.approx(0.005e-3)
    assert_allclose(grading.mass_cdf(0.0375e-3), 0.07, atol=1e-12)
    # What is finer than the cut is left out.
    assert_allclose(grading_of({**SOIL, "min": 0.15}).mass_cdf(0.125e-3), 21 / 80, atol=1e-12)


# --- words and numbers against the keys ----------------------------------------------------------

MESHES = "10,0\n20,10\n40,35\n60,60\n100,85\n200,100\n"


@pytest.mark.parametrize(
    ("content", "keys", "expected"),
    [
        # Numbers alone.
        (MESHES, {}, ["percent_coarser, openings: astm_e11` D50 = 0.307 mm", "D50 = 51.2 mm"]),
        ("-1,0\n0,20\n1,60\n2,100\n", {}, ["below 0", "percent_coarser, openings: phi`"]),
        ("0.5,0\n1,4\n1.5,18\n2,51\n2.5,83\n3,96\n4,100\n", {}, ["equal steps", "D50 = 0.253 mm"]),
        ("4,0\n2,10\n1,50\n0.5,85\n0.25,100\n", {}, ["values: percent_coarser", "D50 = 1 mm"]),
        ("4,0\n2,10\n1,40\n0.5,35\n0.25,15\n", {}, ["sum to 100", "percent_retained, openings: s"]),
        ("4,0\n2,90\n1,400\n0.5,350\n0.25,9\n", {}, ["values: mass_retained, openings: size`"]),
        # Names of sieves.
        ("#10,100\n#40,60\n#200,0\n", {}, ["'#10'", "percent_finer, openings: astm_e11` D50 = 0."]),
        ("# 10,100\n# 40,60\n# 200,0\n", {}, ["openings: astm_e11`"]),
        ("No. 10;100\nNo. 40;60\nNo. 200;0\n", {}, ["openings: astm_e11`"]),
        ("3/4,100\n3/8,50\n4,0\n", {}, ["openings: astm_e11`"]),
        # Words.
        ("µm,finer\n63,0\n500,50\n2000,100\n", {}, ["say unit: um", "unit: um` D50 = 500 um"]),
        ("Sieve 4 (in µm)\n63,0\n500,50\n2000,100\n", {}, ["say unit: um"]),
        ("# phi, cum. coarser\n1,0\n2,50\n4,100\n", {}, ["openings: phi", "percent_coarser"]),
        ("mm;Rückstand\n4;0\n2;10\n1;90\n", {}, ["say values:", "values: percent_retained"]),
        ("mm;refus cumulé\n4;0\n2;10\n1;100\n", {}, ["say values: percent_coarser"]),
        ("mm,passing\n1,0\n2,50\n4,100\n", {"values": "percent_coarser"}, ["percent_finer"]),
        ("mm,passing\n1,0\n2,50\n4,100\n", {"openings": "phi"}, ["say openings: size"]),
    ],
)
def test_table_of_another_kind_is_refused_with_the_keys_to_paste(
    report_of, content, keys, expected
):
    line = only_problem(report_of(content, **keys))
    assert "disagree" in line
    for words in expected:
        assert words in line


@pytest.mark.parametrize(
    ("content", "keys"),
    [
        # Cobbles, and equal steps: said to be sizes, or by a word.
        (MESHES, {"openings": "size"}),
        ("mm,passing\n" + MESHES, {}),
        ("mm,%\n0.5,0\n1,4\n1.5,18\n2,51\n2.5,83\n3,96\n4,100\n", {}),
        # Usual sizes of sieves that are numbers of others too.
        ("4,0\n8,50\n16,100\n", {}),
        ("1,0\n2,20\n3,60\n4,90\n5,100\n", {}),
        ("50,0\n100,30\n200,60\n400,100\n", {"unit": "um"}),
        ("0.063,0\n0.125,10\n0.25,30\n0.5,60\n1,90\n2,100\n", {}),
    ],
)
def test_sizes_with_percent_finer_need_no_keys(report_of, content, keys):
    report = report_of(content, **keys)
    assert report.problems == []
    assert "values: percent finer by mass" in report.meaning


@pytest.mark.parametrize(
    ("content", "keys", "words"),
    [
        ("4,0\n2,50\n1,43\n", {"values": "percent_retained"}, "add a row for the pan, pan and 7"),
        ("4,0\n2,.5\n1,.5\n", {"values": "percent_retained"}, "fractions; multiply by 100"),
        ("4,0\n2,5\n1,5\nTotal,12\n", {"values": "mass_retained"}, "line 4: the total is 12, and"),
        ("4,0\n2,0\n1,0\n", {"values": "mass_retained"}, "nothing is retained"),
        (
            "4,0\n2,50\n1,43\npan,-7\n",
            {"values": "mass_retained"},
            "line 4: mass retained = -7; must not be negative: correct it",
        ),
        (
            "4,0\n2,50\n1,43\npan,107\n",
            {"values": "percent_retained"},
            "line 4: percent retained = 107; must lie between 0 and 100: correct it",
        ),
        (
            "4,0\n2,5\n2,5\n1,5\n",
            {"values": "mass_retained"},
            "line 3: opening 2 has mass retained",
        ),
        ("4,0\n2,5\npan,5\nBoden,5\n", {"values": "mass_retained"}, "a second row of the pan"),
        ("41,0\n60,5\n", {"openings": "astm_e11"}, "no sieve of number 41; the nearest are 40 and"),
        ("99,0\n1,100\n", {"openings": "phi"}, "phi = 99 is no grain's"),
        ("a,b,c\n1,2,0\n2,3,100\n", {}, "The columns are 1: 'a', 2: 'b', 3: 'c': choose by name"),
        ("a,b\n1,0\n2,100\n", {"columns": ["a", "c"]}, "columns: 'c': there is none"),
        ("a,b\n1,0\n2,100\n", {"columns": [1, 3]}, "columns: 3: there are 2, counted from 1"),
        ("a,a\n1,0\n2,100\n", {"columns": ["a", 2]}, "stands above more than one"),
        ("1,0\n2,100\n", {"columns": [1, 1]}, "the same one is chosen twice"),
        ("1,0\n2,100\n", {"sheet": 1}, "is for a workbook"),
    ],
)
def test_what_is_wrong_is_told_with_what_to_do(report_of, content, keys, words):
    assert words in "\n".join(report_of(content, **keys).problems)


def test_total_without_a_number_agrees_with_nothing(report_of):
    report = report_of("4,0\n2,5\n1,5\nTotal,\n", values="mass_retained", min=0.5)
    assert report.problems == []
    said = [line for line in report.meaning if "total" in line]
    assert said == ["line 4: the row of the total has no number and is passed over"]


def test_retained_shares_are_never_to_be_corrected(report_of):
    line = only_problem(report_of("4,0\n2,10\n1,40\n0.5,35\n0.25,15\n"))
    assert line.index("percent_retained") < len(line)
    assert line.endswith("Paste the keys that are meant into the grading")


# --- columns, sheets, units ----------------------------------------------------------------------


def test_columns_are_chosen_by_name_or_number(report_of):
    content = "no.;Sieve (mm);g;Passing\n1;4;0;100\n2;2;50;60\n3;1;60;0\n"
    for columns in (["sieve (MM)", "Passing"], [2, 4], {"value": 4, "opening": "Sieve (mm)"}):
        report = report_of(content, columns=columns)
        assert report.problems == []
        assert 1.5 < report.d_values["D50"] < 2
    # The words say which two they are likely to be.
    assert "as in `columns: [2, 4]`" in only_problem(report_of(content))


def test_sheet_of_a_workbook_is_the_first_or_the_one_that_is_named(tmp_path):
    book, path = openpyxl.Workbook(), tmp_path / "sand.xlsx"
    book.active.title = "One"
    for name, median in (("One", 2.0), ("Two", 8.0)):
        sheet = book[name] if name in book.sheetnames else book.create_sheet(name)
        for row in (["mm", "passing"], [1.0, 0.0], [median, 0.5], [16.0, 1.0]):
            sheet.append(row)
        for cell in sheet["B"][1:]:
            cell.number_format = "0%"
    book.save(path)
    section = {**MM, "file": str(path)}
    first = grading_report(section)
    assert first.d_values["D50"] == pytest.approx(2.0)
    assert any("sheet 'One' is read; there are others: 'Two'" in line for line in first.meaning)
    for name in ("Two", 2):
        assert grading_report({**section, "sheet": name}).d_values["D50"] == pytest.approx(8.0)
    assert "the sheets are 'One', 'Two'" in only_problem(grading_report({**section, "sheet": "x"}))


def test_formula_that_was_never_calculated_is_no_blank(tmp_path):
    book, path = openpyxl.Workbook(), tmp_path / "sand.xlsx"
    for row in ([1, 0], [2, "=25*2"], [4, 100]):
        book.active.append(row)
    book.save(path)
    assert "never calculated" in only_problem(grading_report({**MM, "file": str(path)}))


@pytest.mark.parametrize(("unit", "millimetres"), [("cm", 10.0), ("inch", 25.4), ("um", 1e-3)])
def test_units_are_those_of_the_key(report_of, unit, millimetres):
    report = report_of("1,0\n2,50\n4,100\n", unit=unit)
    assert (report.unit, report.d_values["D50"]) == (unit, pytest.approx(2.0))
    section = {**MM, "form": "single", "unit": unit, "value": 1.0}
    assert grading_of(section).support()[0] == pytest.approx(0.5e-3 * millimetres, rel=1e-14)


def test_report_has_lines_to_paste_with_the_defaults_filled():
    report = grading_report({**SOIL, "min": 0.01})
    assert "  openings: size" in report.config_lines
    assert "  values: percent_finer" in report.config_lines
    # "mm" and "percent passing" say the same as the defaults.
    assert report.warnings == []


def test_lines_to_paste_have_the_scale_where_channels_stay_the_same_by_it(report_of):
    form = {"form": "histogram", "sizes": "edges"}
    report = report_of("1,30\n2,70\n4,\n", **form)
    assert "  scale: log" in report.config_lines
    assert any(line.startswith("scale is not given, and log") for line in report.warnings)
    # The last channel ends at 4, as the others are even; by a log scale it would at 4.5.
    linear = report_of("1,10\n2,20\n3,70\n", **{**form, "sizes": "lower"})
    assert any("channels go from 1 to 4 mm" in line for line in linear.meaning)
    assert not any("scale" in line for line in linear.config_lines)


@pytest.mark.parametrize("key", ["values", "openings", "sizes", "per"])
def test_every_word_has_a_meaning_of_its_own(key):
    form = {"sizes": "histogram", "per": "density"}.get(key, "sieve")
    section = {**MM, "form": form, "file": "nowhere.csv"}
    if form == "histogram":
        section["scale"] = "log"
    meanings = {str(grading_report({**section, key: word}).meaning) for word in WORDS[key]}
    assert len(meanings) == len(WORDS[key])


def test_report_of_a_section_with_mistakes_names_its_keys():
    problems = grading_report({"form": "sieve", "file": "no.csv"}).problems
    assert [line.split(":")[0] for line in problems] == [
        "grading.size",
        "grading.unit",
        "grading.basis",
    ]
