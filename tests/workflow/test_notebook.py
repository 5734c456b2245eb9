"""The notebook of the examples, executed where a reader executes it: beside a finished study."""

from pathlib import Path

import pytest

NOTEBOOK = Path(__file__).parents[2] / "examples" / "notebook.ipynb"


@pytest.fixture(scope="module")
def executed(finished, tmp_path_factory):
    nbformat = pytest.importorskip("nbformat", reason="no notebooks are installed")
    client = pytest.importorskip("nbclient", reason="no notebooks are installed")
    folder = tmp_path_factory.mktemp("project")
    (folder / "examples").mkdir()
    (folder / "results").symlink_to(finished.folder / "results")
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    where = {"metadata": {"path": str(folder / "examples")}}
    return client.NotebookClient(notebook, timeout=120, resources=where).execute()


def test_every_cell_runs_and_the_last_shows_a_figure(executed):
    cells = [cell for cell in executed.cells if cell.cell_type == "code"]
    assert len(cells) <= 10
    assert not [out for cell in cells for out in cell.outputs if out.output_type == "error"]
    # No warning either: of this version nothing is missing.
    assert not [out for cell in cells for out in cell.outputs if out.get("name") == "stderr"]
    assert "image/png" in cells[-1].outputs[-1].data


def test_objects_say_what_they_are(executed):
    shown = [
        out.data["text/plain"]
        for cell in executed.cells
        if cell.cell_type == "code"
        for out in cell.outputs
        if "data" in out
    ]
    assert "sample tiny" in shown[0]
    assert any("branch_length_m [m]: mean length in the bin" in text for text in shown)


def test_the_notebook_is_committed_without_outputs():
    nbformat = pytest.importorskip("nbformat", reason="no notebooks are installed")
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    nbformat.validate(notebook)
    assert not any(cell.get("outputs") for cell in notebook.cells)
