"""Holding the files of a study against its records, wherever they lie."""

import shutil
import tempfile
from pathlib import Path

from branchcrush.records import recorded_job
from branchcrush.results.verification import verify
from tests.unit.recorded_jobs import Named, as_script, fit, here

__all__ = ["here"]


def test_linked_folders_belong_to_the_study_and_a_link_to_above_does_not_lead_around(here):
    whole = verify("results").whole
    (here / "disk").mkdir()
    shutil.move("results/sand/seed_1", here / "disk")
    Path("results/sand/seed_1").symlink_to(here / "disk" / "seed_1")
    Path("results/sand/seed_1/up").symlink_to(here / "results")
    found = verify("results")
    assert (found.faults, found.whole) == ([], whole)
    Path("results/sand/seed_1/path.csv").write_text("abe")
    assert [line.split(" is ")[0] for line in verify("results").faults] == [
        "results/sand/seed_1/path.csv"
    ]


def absolute(here, data="sieve.csv"):
    """Return the fit with the paths that it has below an absolute prefix."""
    made = fit(inputs=[data, str(here / "results/sand/seed_1/path.csv")])
    files = {name: str(here / path) for name, path in made.output.items()}
    made.output = Named(**files)
    return made


def test_a_copy_less_deep_of_a_study_with_absolute_paths_is_sound(here):
    data = here / "sieve.csv"
    shutil.rmtree("results/sand/made")
    with recorded_job(as_script(absolute(here, str(data)))):
        pass
    with tempfile.TemporaryDirectory() as folder:
        copy = shutil.copytree("results", Path(folder, "results"))
        Path(copy, "sand/particles.dump.gz").unlink()
        assert verify(copy).faults == []
        data.write_text("abe")
        (line,) = verify(copy).faults
    assert f"fit.json tells that its files were made from another {data} than the one" in line


def test_the_users_own_file_of_a_job_without_outputs_is_no_result(here):
    made = fit(inputs=[str(here / "sieve.csv")])
    made.output = Named(record="results/sand/made/look.json")
    with recorded_job(as_script(made)):
        pass
    assert verify("results").faults == []
    (here / "sieve.csv").write_text("abe")
    assert any("look.json tells that" in line for line in verify("results").faults)
