"""Compression curves from files: units, what is left out, and what is refused in which words."""

import numpy as np
import pytest

from branchcrush.errors import GradingError
from branchcrush.files.compression_tables import read_compression

HEADER = "axial stress [MPa],void ratio"
ROWS = "0,0.8\n1,0.79\n2,0.78\n4,0.71\n8,0.62\n16,0.44"


@pytest.fixture
def read(tmp_path):
    def reader(text, values="void_ratio", unit="MPa", initial=0.8, **keys):
        path = tmp_path / "curve.csv"
        path.write_text(text)
        return read_compression(path, values, unit, initial_void_ratio=initial, **keys)

    return reader


def refused(read, *args, **keys):
    with pytest.raises(GradingError) as error:
        read(*args, **keys)
    return str(error.value)


def test_void_ratios_are_strains_from_the_beginning_and_a_row_without_stress_is_told(read):
    table = read(f"{HEADER}\n{ROWS}")
    assert table.stress.tolist() == [1e6, 2e6, 4e6, 8e6, 16e6]
    # 1 - 1.44/1.8
    assert table.strain[-1] == pytest.approx(0.2)
    assert "line 2 is without stress: the beginning of the test" in table.remarks


@pytest.mark.parametrize(("unit", "pascal"), [("Pa", 1.0), ("kPa", 1e3), ("MPa", 1e6)])
@pytest.mark.parametrize(("values", "share"), [("strain", 1.0), ("percent_strain", 0.01)])
def test_stresses_are_in_the_unit_and_strains_shares_or_percent(read, unit, pascal, values, share):
    table = read("1,.1\n2,.2\n3,.3\n4,.4\n5,.5", values, unit, None)
    np.testing.assert_allclose(table.stress, pascal * np.arange(1, 6))
    np.testing.assert_allclose(table.strain, share * np.arange(1, 6) / 10)


def test_german_decimals_and_words_mean_the_same(read):
    german = "Spannung [MPa];Porenzahl\n" + ROWS.replace(",", ";").replace(".", ",")
    np.testing.assert_allclose(read(german).strain, read(f"{HEADER}\n{ROWS}").strain)


def test_columns_are_chosen_by_words_and_by_number(read):
    text = "no.;void ratio;stress [MPa]\n1;0.79;1\n2;0.78;2\n3;0.71;4\n4;0.62;8\n5;0.44;16"
    for columns in (["stress [MPa]", "void ratio"], [3, 2]):
        assert read(text, columns=columns).stress[-1] == 16e6
    assert "columns: [1, 2]" in refused(read, text)


def test_unloading_and_reloading_are_left_out_and_told(read):
    table = read(f"{HEADER}\n1,0.79\n2,0.78\n4,0.71\n1,0.72\n3,0.715\n8,0.62\n16,0.44")
    assert table.stress.tolist() == [1e6, 2e6, 4e6, 8e6, 16e6]
    assert table.remarks[-1].startswith("2 rows of unloading or reloading left out")
    assert table.remarks[-1].endswith("(lines 5, 6)")


@pytest.mark.parametrize(
    ("header", "keys", "said"),
    [
        ("stress [kPa],void ratio", {}, "say stress_unit: kPa, not stress_unit: MPa"),
        ("stress [psi],void ratio", {}, "say stress_unit: none that is read: convert them"),
        ("stress [kN/m²],void ratio", {}, "say stress_unit: kPa"),
        ("stress [N/mm²],strain", {}, "say values: strain, not values: void_ratio"),
        ("stress,strain [%]", {"values": "strain"}, "say values: percent_strain, not values: str"),
        ("stress,e", {"values": "strain"}, "say values: void_ratio"),
        ("void ratio,stress [MPa]", {}, "the stresses' column comes first: set columns: "),
    ],
)
def test_words_that_speak_against_the_keys_are_refused(read, header, keys, said):
    assert said in refused(read, f"{header}\n{ROWS}", **keys)


def test_a_strain_may_be_in_percent_where_its_words_do_not_say(read):
    text = "stress [MPa],axial strain\n1,1\n2,2\n4,5\n8,9\n16,20"
    assert read(text, "percent_strain", initial=None).strain[-1] == 0.2


@pytest.mark.parametrize(
    ("row", "keys", "said"),
    [
        ("-32,0.4", {}, "line 8: stress = -32 is below 0; compression is positive here"),
        ("32,-0.4", {}, "line 8: void ratio = -0.4; must be above 0 and at most 20"),
        ("32,44", {}, "line 8: void ratio = 44; must be above 0 and at most 20"),
        ("32,0.81", {}, "line 8: void ratio = 0.81 is above initial_void_ratio 0.8"),
        ("16,0.43", {}, "line 8: stress = 16 is there twice, also in line 7"),
        ("much,0.4", {}, "line 8: stress = 'much' is no finite number"),
        ("32,inf", {}, "line 8: void ratio = 'inf' is no finite number"),
        ("32", {}, "line 8: 1 column, 32; must have 2: stress, void ratio"),
    ],
)
def test_a_row_that_no_test_has_is_refused_with_its_line(read, row, keys, said):
    assert said in refused(read, f"{HEADER}\n{ROWS}\n{row}", **keys)


def test_strains_of_no_compression_are_refused(read):
    percent = refused(read, "1,1\n2,2\n4,5\n8,9\n16,20", "strain")
    assert "strain = 1 would leave no volume" in percent
    assert "of percent say values: percent_strain" in percent
    assert "strain = -0.1 is below 0" in refused(read, "1,-.1\n2,.1\n4,.2\n8,.3\n9,.4", "strain")


def test_an_initial_void_ratio_below_those_of_the_file_is_one_problem(read):
    (line,) = refused(read, f"{HEADER}\n{ROWS}", initial=0.7).splitlines()
    assert "line 2: void ratio = 0.8 is above initial_void_ratio 0.7, as in 3 more rows" in line


def test_stresses_that_fall_are_told_where_they_begin_to(read):
    said = refused(read, f"{HEADER}\n1,.7\n2,.68\n1.5,.66\n1,.65\n.5,.64")
    assert "line 4: the stress falls here: 2 rows of first loading" in said


def test_all_problems_of_a_file_are_told_at_once(read):
    assert len(refused(read, f"{HEADER}\n{ROWS}\n-1,0.4\n32,90\nx,1").splitlines()) == 3


def test_too_few_rows_of_first_loading_and_rows_turned_round_are_refused(read):
    turned = "\n".join(reversed(ROWS.splitlines()[1:]))
    assert "line 3: the stress falls here: 1 row of first" in refused(read, f"{HEADER}\n{turned}")
    assert "a fit needs 5" in refused(read, f"{HEADER}\n1,.7\n2,.6")
    assert "no numbers in the file" in refused(read, f"{HEADER}\n")
