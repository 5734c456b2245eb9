"""What a user sees when a study cannot be run: one clear message, and nothing half-written."""

import os
import shutil

import pytest

from branchcrush.files.memory import machine_memory


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ("", " must hold keys and values, and among them samples"),
        ("- samples\n", " must hold keys and values, and among them samples"),
        ("figures: {dpi: 100}\n", " must hold keys and values, and among them samples"),
        ("samples:\n\ttiny: {}\n", ", line 2: a tab, where YAML wants blanks; mend the YAML"),
        ("samples: {tiny: [1, 2}\n", ", line 1: expected ',' or ']', but got '}'; mend"),
        ("samples: {}\nsamples: {}\n", ", line 2: samples is given twice in one section, first in"),
        ("samples: {}\n---\nsamples: {}\n", ", line 2: but found another document; mend"),
        ("samples: {tiny: 2020-13-45}\n", " is no usable YAML: month must be in 1..12"),
        ("samples: &all {tiny: *all}\n", " has a section that contains itself"),
        ("samples: {tiny: \0}\n", " is no YAML: unacceptable character #x0000"),
        ("samples: Körnung\n".encode("cp1252"), " is no text in UTF-8: save it as such"),
    ],
)
def test_a_file_that_is_no_configuration(study, content, expected):
    file = study.folder / "config.yaml"
    file.write_bytes(content if isinstance(content, bytes) else content.encode())
    (line,) = study.refused()
    assert line.startswith(f"config: config.yaml{expected}")


def test_no_file_or_a_folder_in_its_place(study):
    (study.folder / "config.yaml").unlink()
    (line,) = study.refused()
    assert line.startswith(f"config: there is no file config.yaml in {study.folder}: run where")
    (study.folder / "config.yaml").mkdir()
    (line,) = study.refused()
    assert line == "config: config.yaml is a folder, and must be a text file of keys and values"


def test_a_wrong_key_of_the_command_line(study):
    (line,) = study.refused("--config", "figures={dpi: 3}")
    assert line.startswith("config: figures.dpi = 3 dots per inch: must be a whole number from 50")


@pytest.mark.parametrize("place", ["results", "logs", "results/tiny", "logs/tiny/seed_5"])
def test_a_file_where_a_folder_of_results_must_be(study, place):
    (study.folder / place).parent.mkdir(parents=True, exist_ok=True)
    (study.folder / place).touch()
    (line,) = study.refused()
    assert line == f"config: {place} is a file, and results need a folder there: move it"


@pytest.mark.parametrize("place", [".", "results", "config.yaml"])
def test_a_place_without_the_permission_to_use_it(study, place):
    wrapped_in = ()
    if os.getuid() == 0:
        # To root every folder is open, but for this right.
        if not shutil.which("setpriv"):
            pytest.skip("no setpriv here to give up what root may do")
        wrapped_in = ["setpriv", "--bounding-set", "-dac_override,-dac_read_search"]
    (study.folder / "results").mkdir()
    target = study.folder / place
    target.chmod(0o000 if target.is_file() else 0o555)
    try:
        (line,) = study.refused(wrapped_in=wrapped_in)
    finally:
        target.chmod(0o755)
    if target.is_file():
        assert line == "config: config.yaml cannot be read: Permission denied"
    else:
        assert "cannot be written to" in line
        assert (str(study.folder) if place == "." else place) in line


def test_more_memory_than_the_machine_has_is_refused_before_any_job(study):
    # 350 MB + 900 B * 14 states * 1e7 grains = 126 GB.
    study.configure(study.tiny.replace("grains: 60", "grains: 10000000"))
    if machine_memory().total > 80e9:
        pytest.skip("this machine has the memory")
    (line,) = study.refused()
    assert line.startswith("config: samples.tiny.grains = 10000000: a job takes about 126.3 GB of")
    assert line.endswith("ask for fewer grains or loading.states, or take a larger machine")


def test_grains_without_room_are_refused_before_any_job(study):
    study.configure(
        study.tiny.replace("min: 5.0e-5", "min: 9.9e-4")
        .replace("edge_reduction: 0.4", "edge_reduction: 0.2")
        .replace("boundary: walls", "boundary: walls\n    initial_solid_fraction: 0.4")
    )
    (line,) = study.refused()
    assert line.startswith(
        "config: samples.tiny.initial_solid_fraction = 0.4: seed 3 finds no room"
    )


def test_all_problems_of_all_kinds_are_named_at_once(study):
    study.configure(
        """\
samples:
  first:
    grading: {form: uniform, basis: number, size: radius, unit: mm, min: 1.0, max: 0.5}
    grians: 60
    grains: -1
    loading: {edge_reduction: 40, quality: best}
    seeds: [3, 3]
  second:
    grading: {form: sieve, basis: mass, size: diameter, unit: mm, file: no.csv}
    grains: 60
    loading: {solid_fraction: 0.1}
    seeds: 0
  "../third":
figures: {dip: 100}
thermodynamics: {critical_energy: none}
"""
    )
    (study.folder / "logs").touch()
    lines = study.refused()
    assert [line.removeprefix("config: ").split(" = ")[0].split(": ")[0] for line in lines] == [
        "samples.first.grading.max",
        "samples.first.grains",
        "samples.first.loading.edge_reduction",
        "samples.first.loading.quality",
        "samples.first.seeds",
        "samples.first.grians",
        "samples.second.loading.solid_fraction",
        "samples.second.seeds",
        "samples.../third",
        "samples.../third",
        "thermodynamics.critical_energy",
        "figures.dip",
        "samples.second.grading.file",
        "logs is a file, and results need a folder there",
    ]


def test_a_number_that_yaml_takes_for_text_is_a_number(study):
    study.configure(study.tiny.replace("min: 5.0e-5", "min: 5e-5").replace("60", "6e1"))
    run = study.snakemake("--dry-run", "--quiet")
    assert run.returncode == 0, run.stdout + run.stderr
