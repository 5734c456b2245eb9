"""Figures: from result files to pictures, each alone or all by the workflow.

`packing_figures`, `fit_figures`, `network_figures`, `crushing_figures`
    One function a figure of a sample, as `draw_energy_split(path, dpi, table, fit)`: it takes what
    `files.tables.read_table` and `read_json` read, writes one PNG file and returns the Figure.
`study_figures`
    The same for the figures of all samples together.
`gradings`, `packings`, `loading`, `certificate`, `energy`, `predictors`, `branches`
    The panels of a sample: `plot_...` draws one on an Axes and returns it; none saves a file. Who
    carries what is in `shielding` and `forces`.
`crushing`, `crushing_paths`, `form_lines`, `form_words`
    The panels of the crushing model, against C and along the strain; how its forms are drawn, and
    what is said of them below a figure.
`crushed`, `crushed_forms`, `crushed_lengths`, `crushed_grains`, `crushed_figures`
    Grains that break: panels, and the figures of a sample; without a simulation
    (`crushing_predicted`).
`study`, `study_networks`
    The panels of all samples.
`results`
    What `plot()` of a result of `branchcrush.open_study` draws: `PANELS`, a line each.
`style`, `intervals`
    How every figure looks: `figure`, `STATES`, colours and sizes; how an estimate with its interval
    is drawn.

A new panel is a function `plot_...` of the module of its subject, and a line in a function
`draw_...`. A new figure is a function `draw_...`, its name in `workflow/rules/report.smk`, a line
in a script of that rule, and its place in a page of `workflow/report`. How predictors and models
look is said where they are registered, not here.
"""
