"""The page of all result files is what the dictionary tells."""

from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import pytest

from branchcrush.files.dictionary import result_files

DOCS = Path(__file__).parents[2] / "docs"


@pytest.fixture(scope="module")
def results_page():
    spec = spec_from_file_location("results_page", DOCS / "results_page.py")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_is_in_step_with_the_dictionary(results_page):
    written = (DOCS / "results.md").read_text(encoding="utf-8")
    assert results_page.page(written) == written, "run make schema"


def test_every_file_and_every_column_is_on_the_page():
    page = (DOCS / "results.md").read_text(encoding="utf-8")
    assert "beside each the same as SVG" in page
    for file in result_files():
        if file.path.endswith(".svg"):
            continue
        assert f"`{file.path}`" in page
        for line in file.lines:
            assert f"| `{line.name}` | {line.type} | {line.unit} |" in page


def test_a_figure_names_the_tables_that_it_shows(results_page):
    figure = next(file for file in result_files() if file.path.endswith("loading_path.png"))
    tables = ["<sample>/seed_<seed>/path.csv", "<sample>/thermodynamics.json"]
    assert results_page.shown_by(figure) == tables
