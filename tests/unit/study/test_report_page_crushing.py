"""What the page of a study says of the crushing model."""

import pandas as pd
import pytest

from branchcrush.plotting.form_words import extrapolated
from tests.unit.study.report_parts import FORM, FORMS, MODEL, rendering, whole_fit


@pytest.fixture
def page(tmp_path, sample):
    return rendering(tmp_path, whole_fit(sample))


def test_the_form_on_the_front_is_named_with_why_and_its_numbers(page):
    html = page({})
    assert "On the front stands the form <b>moving jamming point</b>: fines fill voids" in html
    assert "rods that push" in html and "random parking" not in html
    assert "Crushing begins at an elastic strain of 10.15 % and 6.1 MPa; the stress rises" in html
    assert "0.2 MJ/m&sup3; over (1 &minus; C)<sup>2</sup>" in html


def test_the_front_is_tabled_along_c_as_far_as_it_is_admissible(page):
    html = page({})
    assert (
        "<tr><td>0.10</td><td>0.6500</td><td>1.15</td> <td>0.4</td><td>4</td><td>0.520</td></tr>"
    ) in html
    assert "<td>0.50</td><td>0.7600</td><td>3.83</td> <td>0.04</td><td>none</td>" in html
    assert "0.7700" not in html


def test_yield_beyond_the_measured_strains_is_said(page):
    html = page({"model": {**MODEL, "largest_strain": 0.015}})
    assert "From C = 0.10 on it yields at elastic strains above 1.5 %" in html
    assert "it yields at" not in page({})


def test_page_and_figures_tell_one_c_from_which_on_the_law_is_extrapolated(page):
    # Between two rows of the page, which are tenths of C.
    crushing = [k / 50.0 for k in range(51)]
    strain = [0.01 if at < 0.615 else 0.2 for at in crushing]
    forms = pd.DataFrame({"crushing": crushing, "yield_elastic_strain": strain, "form": "paper"})
    forms = forms.assign(**dict.fromkeys(FORMS.columns.drop(list(forms)), 1.0))
    model = {**MODEL, "form": "paper"}
    (text,) = extrapolated(forms, model)
    assert text.startswith("From C = 0.62 on")
    assert "From C = 0.62 on it yields at" in page({"model": model, "forms": forms})


@pytest.mark.parametrize(
    ("hardens", "snaps", "said"),
    [
        (True, [], "the stress rises then."),
        (True, [0.12, 0.3], "rises then, and falls from C = 0.12 on: under a stress that is held"),
        (False, [0.0], "the stress falls then: under a stress that is held C snaps on there."),
    ],
)
def test_the_sentence_of_the_onset_is_what_the_table_says(page, hardens, snaps, said):
    form = {**FORM, "hardens_at_onset": hardens, "snaps": snaps}
    forms = {**MODEL["forms"], "paper": form}
    model = {**MODEL, "form": "paper", "forms": forms, "hardens_at_onset": hardens}
    assert said in page({"model": model})


def test_a_small_driving_force_keeps_its_digits(page):
    forms = FORMS.assign(driving_force_over_pressure=[0.0012345] * len(FORMS))
    assert "<td>0.00123</td>" in page({"forms": forms})


def test_a_sample_that_is_not_certified_says_so_again_beside_the_crushing_model(page):
    html = page({"certificate": {"verdict": "not certified", "reasons": ["few"]}})
    section = html[html.index(">Crushing<a class=") :]
    assert "The sample is not certified" in section
    assert "is not certified" not in page({})


def test_every_form_says_whether_it_is_admissible_where_not_and_why(page):
    html = page({})
    moving = html[html.index("<tr><td>moving jamming point</td>") :]
    assert "<td>none</td><td>no</td> <td>from C = 0.55</td> <td>yes</td>" in moving
    assert "<td>at C = 0.12, 0.25</td></tr>" in moving
    # One that hardens when crushing begins may snap farther on.
    assert "<th>hardens at onset</th><th>snaps under stress</th>" in html
    assert "<td>0.892</td><td>yes</td> <td>never</td> <td>yes</td><td>never</td></tr>" in html
    assert "<td>-0.25</td><td>yes</td> <td>at all C</td> <td>never yields</td>" in html
    assert '<td class="words" colspan="5">no contacts &lt;measured&gt;</td></tr>' in html
    assert "<p><b>moving jamming point</b>: It ends at C = 0.55. It snaps.</p>" in html


def test_a_degenerate_form_is_said_on_the_front_and_in_the_section(page):
    sentence = "theta is 0.99999"
    html = page({"model": {**MODEL, "paper_degenerate": sentence}})
    front, section = html.split('<h2 id="sample-paper">')
    assert f'<p class="note"><a href="#sample-paper">paper</a>: {sentence}</p>' in front
    assert f'<p class="note">{sentence}</p>' in section
    assert sentence not in page({})


def test_the_elastic_law_says_how_it_was_found_and_what_it_leaves_out(page):
    said = {"elasticity_sentences": ["One.", "Two."], "rearrangement": "Three.", "bands": None}
    assert "<p><b>Elastic law</b>: One. Two. Three.</p>" in page({"model": {**MODEL, **said}})
    assert "Elastic law</b>" not in page({})


def test_untested_size_ratios_are_said(page):
    html = page({"model": {**MODEL, "untested": "a ratio of 200 is untested."}})
    assert '<p class="note">a ratio of 200 is untested.</p>' in html


def test_a_chosen_form_that_is_not_there_says_why_and_shows_the_others(page):
    model = {**MODEL, "form": "measured_contacts", "form_reason": "No contacts were measured."}
    html = page({"model": model})
    assert '<p class="note">No contacts were measured.</p>' in html
    assert "chosen by <code>thermodynamics.form</code>" in html
    assert 'alt="compression line"' in html
    assert "Crushing begins at" not in html


def test_limits_are_those_of_the_sample(page):
    hertz = {"contact": {"law": "hertz"}, "boundary": "periodic"}
    html = page({"settings": hertz})
    for part in ("finer grains are stiffer", "between walls"):
        assert part in page({})
        assert part not in html


def test_a_grading_that_is_the_ultimate_one_never_crushes(page):
    model = {**MODEL, "yield_strain": None, "yield_stress_Pa": None, "yields_on_path": False}
    html = page({"model": model})
    assert "By this form crushing never begins." in html
    assert "Crushing begins at" not in html
    html = page({"model": {**model, "form": "density"}})
    assert "crushing never begins: it would cost elastic energy from the first." in html


def test_a_limit_of_elastic_strain_is_told_with_its_numbers(page):
    limit = {"resistance": "elastic_strain", "elastic_strain": 0.0125, "strength_exponent": 0.5}
    html = page({"model": {**MODEL, **limit}})
    assert "begins at 1.25 %" in html and "(strength exponent 0.5)" in html


def test_captions_follow_the_form_on_the_front(page):
    stiffer = "by the form on the front a grading that was crushed is stiffer, and jams at a larger"
    assert stiffer in page({})
    softer = "a grading that was crushed is softer, and its jamming point stays."
    assert softer in page({"model": MODEL | {"form": "paper"}})
    html = page({"model": MODEL | {"form": "density"}})
    assert "whether crushing raises or lowers it. <span" in html


def test_captions_follow_the_resistance(page):
    assert "crushing goes on where driving force and resistance are equal" in page({})
    limit = {"resistance": "elastic_strain", "elastic_strain": 0.01, "strength_exponent": 0.3}
    html = page({"model": MODEL | limit})
    assert "goes on at the elastic strain of yield, and the resistance is the driving force" in html
    assert "are equal" not in html
