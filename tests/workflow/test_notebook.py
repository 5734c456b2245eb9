"""The notebook of the examples goes from a study to a figure; beside a packing of another code too.

The latter is in `test_read_packing`, which has such a study.
"""

import pytest

from tests.workflow.notebooks import NOTEBOOK, executed_beside


@pytest.fixture(scope="module")
def cells(finished, tmp_path_factory):
    return executed_beside(finished.folder / "results", tmp_path_factory.mktemp("project"))


def test_ten_cells_lead_to_a_figure(cells):
    assert len(cells) <= 10


def test_objects_say_what_they_are(cells):
    outputs = [output for cell in cells for output in cell.outputs if "data" in output]
    shown = [output.data["text/plain"] for output in outputs]
    assert "sample tiny" in shown[0]
    assert any("branch_length_m [m]: mean length in the bin" in text for text in shown)


def test_the_notebook_is_committed_without_outputs():
    nbformat = pytest.importorskip("nbformat", reason="no notebooks are installed")
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    nbformat.validate(notebook)
    assert not any(cell.get("outputs") for cell in notebook.cells)
