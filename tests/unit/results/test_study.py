"""Opening a study: what is there, what is not, and what is asked for by a wrong name."""

import shutil

import pytest

import branchcrush
from branchcrush.errors import ResultsError
from branchcrush.files.tables import write_table
from tests.unit.results.conftest import leave_record


@pytest.fixture
def study(row_of_three):
    return row_of_three


def test_a_study_is_opened_by_its_folder_or_that_of_its_results(study, tmp_path):
    assert list(branchcrush.open_study(tmp_path / "results").samples) == ["sand"]
    assert list(branchcrush.open_study(str(tmp_path)).samples) == ["sand"]


@pytest.mark.parametrize("made", [False, True])
def test_a_folder_without_results_is_refused_with_what_to_do(tmp_path, made):
    folder = tmp_path / "elsewhere"
    if made:
        folder.mkdir()
    with pytest.raises(ResultsError, match="ame the folder results"):
        branchcrush.open_study(folder)


def test_an_unfinished_study_says_so_and_what_every_study_has(study):
    gone = study.missing()
    assert gone[0] == "the study has not been run to its end yet"
    assert "sand/energy_split.csv and sand/energy_split.json are not there: rule energy_split " in (
        " ".join(gone)
    )
    assert not [line for line in gone if "crushed_" in line]  # of samples that break alone
    assert "missing" in repr(study) and "missing" in repr(study["sand"])


def test_what_is_not_there_is_told_with_what_is(study):
    sand = study["sand"]
    for ask, told in (
        (lambda: study["snad"], "did you mean sand"),
        (lambda: sand.seed(8), "no seed 8; there are: 7"),
        (lambda: sand.seed(7).state(9), "0 to 2 were saved"),
        (lambda: sand.seed(7).state(1).grains, "keep_dumps: all"),
        (lambda: sand.seed(7).as_crushed(), "section breakage"),
        (lambda: sand.energy_split.data, "Run the study to its end"),
        (lambda: sand.seed(7).path.summary, "in .data"),
        (lambda: sand.sharing.data, "in .summary"),
        (lambda: sand.seed(7).path.read(["stress"]), "cannot be read as asked"),
    ):
        with pytest.raises(ResultsError, match=told):
            ask()
    with pytest.raises(AttributeError, match=r"Did you mean energy_split"):
        _ = sand.energy_splt
    with pytest.raises(KeyError, match="no column 'stress'; it has state"):
        _ = sand.seed(7).path["stress"]
    assert sand.refined is None and sand.seed(7).crushed is None


def test_results_are_found_by_their_names_and_offered_to_whoever_types(study):
    assert {"energy_split", "jamming", "fabric"} <= set(dir(study["sand"]))
    assert {"comparison", "findings"} <= set(dir(study))
    assert set(study["sand"].seed(7).results) >= {
        "path", "contacts", "wall_contacts", "steps", "compressed"
    }  # fmt: skip


def test_negative_states_count_from_the_last(study):
    packing = study["sand"].seed(7)
    assert packing.state(-1).number == 2
    assert packing.end.number == 2
    assert "state 2" in repr(packing.end)


def test_units_are_those_of_the_dictionary(study):
    contacts = study["sand"].seed(7).contacts
    assert contacts.units["normal_force_N"] == "N"
    assert contacts.data.attrs["units"]["overlap_m"] == "m"
    assert "overlap_m [m]: R_i + R_j less the distance" in repr(contacts)
    columns = contacts.columns.set_index("name")
    assert columns.loc["energy_J", "unit"] == "J"


@pytest.mark.filterwarnings("ignore:.*lacks columns")
def test_a_crushed_packing_has_its_own_grains_in_every_state(study, tmp_path):
    ours = study["sand"].seed(7)
    place = tmp_path / "results" / "sand" / "crushing" / "seed_7"
    shutil.copytree(ours.folder, place)
    # The grain in the middle breaks into two; the table has no centres of the loose packing.
    rows = [{"state": 0, "grain": k, "radius_m": 0.5, "x_m": None} for k in range(3)]
    rows += [
        {"state": 2, "grain": grain, "radius_m": radius, "x_m": x, "y_m": 0.0, "z_m": 0.0}
        for grain, radius, x in ((0, 0.5, -1.0), (2, 0.5, 1.0), (3, 0.4, 0.0), (4, 0.2, 0.0))
    ]
    write_table(place / "grains.parquet", rows, {})
    leave_record(tmp_path / "results", "sand/crushing/seed_7", sample="sand", seed="7")
    crushed = ours.crushed
    with pytest.warns(UserWarning, match="unknown"):
        assert crushed.end.grains["radius_m"].tolist() == [0.5, 0.5, 0.4, 0.2]
    assert crushed.state(0).grains["x_m"].tolist() == [-1.0, 0.0, 1.0]
    assert crushed.end.network.radius.tolist() == [0.5, 0.5, 0.4, 0.2]
    assert ours.end.grains["radius_m"].tolist() == [0.5, 0.5, 0.5]


def test_measured_materials_are_results_too(study, tmp_path):
    assert study.materials == {}
    (tmp_path / "results" / "measured" / "quartz").mkdir(parents=True)
    quartz = branchcrush.open_study(tmp_path).materials["quartz"]
    assert "gradings" in quartz.results and "none" in repr(quartz)
    assert quartz.gradings.missing.startswith("measured/quartz/gradings.csv is not there: rule ")
