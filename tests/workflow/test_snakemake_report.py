"""The report that Snakemake makes itself: one file, with every figure and table."""

import base64
import json

import pytest

from tests.pictures import is_whole


@pytest.fixture(scope="module")
def results(finished, tmp_path_factory):
    """Return what the report holds of each file, by path."""
    with pytest.MonkeyPatch.context() as patch:
        # To ask anybody for anything would fail.
        for name in ("http_proxy", "https_proxy", "HTTP_PROXY", "HTTPS_PROXY"):
            patch.setenv(name, "http://127.0.0.1:9")
        page = tmp_path_factory.mktemp("report") / "report.html"
        run = finished.snakemake("--report", str(page))
    assert run.returncode == 0, run.stdout + run.stderr
    text = page.read_text(encoding="utf-8")
    begin = "var results = "
    return json.JSONDecoder().raw_decode(text, text.rindex(begin) + len(begin))[0]


def test_every_figure_is_in_the_report_with_words_of_its_own(finished, results):
    figures = sorted(finished.folder.glob("results/figures/*/*.png"))
    assert len(figures) == 18
    captions = set()
    for figure in figures:
        entry = results[str(figure.relative_to(finished.folder))]
        assert base64.b64decode(entry["data_uri"].partition(",")[2]) == figure.read_bytes()
        assert entry["labels"]["figure"] == figure.stem.replace("_", " ")
        captions.add(entry["caption"])
        assert is_whole(figure), figure
    assert len(captions) == len(figures)
    assert not [caption for caption in captions if len(caption) < 40 or "snakemake" in caption]


def test_every_table_of_all_seeds_is_in_the_report_and_says_what_it_holds(finished, results):
    tables = [*finished.folder.glob("results/*.csv"), *finished.folder.glob("results/tiny/*.csv")]
    assert len(tables) > 20
    for table in tables:
        entry = results[str(table.relative_to(finished.folder))]
        assert base64.b64decode(entry["data_uri"].partition(",")[2]) == table.read_bytes()
        assert len(entry["labels"]["holds"]) > 10
        assert "unit" in entry["caption"]
