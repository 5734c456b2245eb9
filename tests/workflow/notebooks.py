"""The notebook of the examples, executed beside results as a reader executes it."""

from pathlib import Path

import pytest

NOTEBOOK = Path(__file__).parents[2] / "examples" / "notebook.ipynb"


def executed_beside(results, folder):
    """Return the cells of code of the notebook, executed in a project that has these results."""
    nbformat = pytest.importorskip("nbformat", reason="no notebooks are installed")
    client = pytest.importorskip("nbclient", reason="no notebooks are installed")
    (folder / "examples").mkdir(parents=True)
    (folder / "results").symlink_to(results)
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    where = {"metadata": {"path": str(folder / "examples")}}
    done = client.NotebookClient(notebook, timeout=120, resources=where).execute()
    cells = [cell for cell in done.cells if cell.cell_type == "code"]
    outputs = [output for cell in cells for output in cell.outputs]
    assert not [output for output in outputs if output.output_type == "error"]
    # No warning either: of this version nothing is missing.
    assert not [output for output in outputs if output.get("name") == "stderr"]
    assert "image/png" in cells[-1].outputs[-1].data
    return cells
