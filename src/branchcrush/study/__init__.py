"""All samples of a study beside each other, what a study will cost, and the pages to open.

`results`
    `SampleResults`: what the rules have found of one sample, read by `results`.
`kinds`
    `SampleKind`: boundary, contact law and grading, which tell samples apart in figures.
`exponents`
    n at one distance from jamming (`at_distance`, `common_distance`), and where it crosses 3.
`findings`, `verdicts`
    `finding_rows` makes `findings.csv`, a row a sample; `verdicts` says which samples are on which
    side of each question.
`comparison`, `summary`
    The row of a sample in `comparison.csv`, and the lines that a run ends with.
`preview`, `preview_rods`, `preview_breakage`, `preview_breakage_words`, `preview_text`
    `sample_plan`: sizes, who will carry load, what breakage makes of it, time, memory and warnings
    of a sample before it runs, and all of it as text. `command.preview` makes both.
`crushing_words`
    The forms of the crushing model in words, and the one on the front along C.
`pages`
    `render_report` and `render_findings` fill the templates of `workflow/report`.
`templates`
    `page_template`: how every page is rendered, and the filters that format its numbers.
`measured_page`, `crushing_page`
    The same for what a laboratory measured, and for grains that break.
`viewer`, `viewer_states`
    Grains in 3-D: `viewer_states` takes saved states out of tables, `viewer_data` packs them for
    the macro `viewer` of `workflow/report/viewer/viewer.html.jinja`; `packing_view` does both.

A new number of all samples is a line of `findings.finding_row`; a new question is a line of
`verdicts.verdicts` and a sentence of the template. A new warning before a run is one of
`preview.sample_plan`.
"""
