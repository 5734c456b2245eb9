"""The Data Package of a study: which files it names, and what it says of them."""

from branchcrush.files.datapackage import data_package
from branchcrush.files.dictionary import result_files

MATERIALS = {"quartz": True, "sieved": False}  # whether there is a compression curve
PACKAGE = data_package(
    {"Sand": [1, 2], "sand": [7], "others": [1]},
    {"Sand-refined": [1]},
    MATERIALS,
    ["Sand", "Sand-refined"],
    ["others"],
)
BY_PATH = {resource["path"]: resource for resource in PACKAGE["resources"]}


def test_figures_of_samples_beside_each_other_are_of_several_samples():
    def together(samples):
        resources = data_package(samples, {})["resources"]
        return [one["path"] for one in resources if one["path"].startswith("figures/findings/")]

    assert together({"sand": [1]}) == []
    assert len(together({"sand": [1], "silt": [1]})) == 12


def test_every_sample_and_seed_has_its_files_and_names_are_unique():
    packings = [path for path in BY_PATH if path.endswith("/path.csv") and "crushing" not in path]
    assert packings == [
        "Sand/seed_1/path.csv",
        "Sand/seed_2/path.csv",
        "sand/seed_7/path.csv",
        "others/seed_1/path.csv",
        "Sand-refined/seed_1/path.csv",
    ]
    names = {resource["name"] for resource in PACKAGE["resources"]}
    assert len(names) == len(PACKAGE["resources"]) == len(BY_PATH)


def test_seeds_run_again_have_a_certificate_and_no_fit():
    again = {path for path in BY_PATH if path.startswith("Sand-refined/")}
    assert {"Sand-refined/certificate.csv", "Sand-refined/jamming.csv"} <= again
    assert "Sand-refined/energy_split.json" not in again
    assert "Sand-refined/certificate.json" not in again
    assert not any("refined" in path for path in BY_PATH if path.startswith("figures/"))


def test_packings_of_another_code_have_what_was_read_and_no_packing_for_lammps():
    assert {"others/seed_1/reading.json", "others/radii.csv"} <= set(BY_PATH)
    assert "others/seed_1/packing.data" not in BY_PATH
    assert "sand/seed_7/packing.data" in BY_PATH
    assert "sand/seed_7/reading.json" not in BY_PATH


def test_a_material_has_the_files_of_what_was_measured_and_a_study_without_one_has_none():
    of_materials = {path for path in BY_PATH if "measured" in path}
    assert "measured/quartz/compression.json" in of_materials
    assert "measured/sieved/breakage.json" in of_materials
    assert "measured/sieved/compression.json" not in of_materials
    assert {"measured.html", "figures/measured/sieved/gradings.png"} <= of_materials
    paths = [resource["path"] for resource in data_package({"sand": [1]}, {})["resources"]]
    assert not [path for path in paths if "measured" in path]


def test_a_sample_whose_grains_break_has_its_crushing_and_another_has_none():
    crushed = {path for path in BY_PATH if path.endswith("breakages.parquet")}
    assert crushed == {
        f"{name}/crushing/seed_{seed}/breakages.parquet"
        for name, seed in (("Sand", 1), ("Sand", 2), ("Sand-refined", 1))
    }
    assert {"Sand/crushing_states.csv", "figures/Sand/crushed_line.png"} <= set(BY_PATH)
    assert "sand/crushing_states.csv" not in BY_PATH
    assert "Sand-refined/crushing_states.csv" not in BY_PATH
    assert "crushing.html" in BY_PATH
    paths = [resource["path"] for resource in data_package({"sand": [1]}, {})["resources"]]
    assert not {"crushing.html", "sand/crushing/seed_1/path.csv"} & set(paths)


def test_a_table_has_a_schema_with_units_and_says_where_its_comment_is():
    resource = BY_PATH["sand/seed_7/path.csv"]
    assert resource["type"] == "table"
    assert (resource["dialect"]["headerRows"], resource["dialect"]["commentChar"]) == ([2], "#")
    fields = {field["name"]: field for field in resource["schema"]["fields"]}
    assert fields["mean_stress_Pa"]["type"] == "number"
    assert fields["mean_stress_Pa"]["unit"] == "Pa"
    assert "unit" not in fields["carries_load"]
    # Every packing has all columns; a sample without a fit has not.
    assert "fieldsMatch" not in resource["schema"]
    assert BY_PATH["sand/energy_split.csv"]["schema"]["fieldsMatch"] == "superset"


def test_other_files_are_named_as_what_they_are():
    assert BY_PATH["Sand/seed_1/contacts.parquet"]["format"] == "parquet"
    keys = {key["name"]: key for key in BY_PATH["sand/grading.json"]["keys"]}
    assert keys["realised.D50_m"]["unit"] == "m"
    assert BY_PATH["report.html"]["mediatype"] == "text/html"
    assert BY_PATH["figures/sand/fig3_grading.png"]["format"] == "png"
    assert "preview.txt" not in BY_PATH and "datapackage.json" not in BY_PATH


def test_all_that_a_study_always_makes_is_there_and_no_record_nor_dump():
    # Which dumps there are is up to keep_dumps, and to who deletes them.
    left_out = ("datapackage.json", "/made.json", "made/<rule>.json", ".dump.gz")
    for file in result_files():
        is_expected = file.rule != "preview" and not file.path.endswith(left_out)
        assert any(file.matches(path) for path in BY_PATH) == is_expected, file.path
