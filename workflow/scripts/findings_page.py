"""Draw all samples together, and write the page to judge them by."""

from pathlib import Path

from branchcrush.files.tables import read_table, write_text
from branchcrush.jobs import job
from branchcrush.plotting import study as plots
from branchcrush.plotting import study_networks as networks
from branchcrush.plotting.style import SIZE, figure, reason
from branchcrush.study.findings import GOOD_DISTANCE, verdicts
from branchcrush.study.kinds import SampleKind
from branchcrush.study.pages import render_findings

with job(snakemake.log[0]):
    files, output, samples = snakemake.input, snakemake.output, snakemake.params.samples
    styles, dpi = (
        plots.sample_styles({n: SampleKind.of(s) for n, s in samples.items()}),
        snakemake.params.dpi,
    )
    rows, states = read_table(files.rows), read_table(files.states)
    rows = rows.astype(object).where(rows.notna(), None)
    known = rows[rows["exponent_at_end"].notna()] if "exponent_at_end" in rows else rows[:0]
    states = states[states["state"].notna()] if "state" in states else states[:0]

    def tables(kind):
        found = {name: read_table(path) for name, path in zip(samples, files[kind], strict=True)}
        return {name: table for name, table in found.items() if "reason" not in table}

    def draw(path, size, *panels):
        with figure(path, dpi, size, (1, len(panels)), squeeze=False) as axes:
            for ax, (plot, data, *rest) in zip(axes.flat, panels, strict=True):
                plot(data, *rest, ax=ax) if len(data) else reason(ax, "no sample has any")

    wide, tall = (2 * SIZE[0], 1.2 * SIZE[1]), (2 * SIZE[0], SIZE[1] + 0.16 * len(rows))
    paths = tables("paths")
    laws = dict.fromkeys(style["law"] for style in styles.values())
    draw(output.exponents, wide, *((plots.plot_exponents, paths, styles, law) for law in laws))
    for kind in ("lengths", "energies"):
        draw(output[kind], tall, (plots.plot_samples, known, kind))
    for name, first, second in (
        ("coordination", (networks.plot_coordination, states), (networks.plot_jamming_law, states)),
        (
            "shielding",
            (networks.plot_branch_shielding, tables("branches")),
            (networks.plot_grain_shielding, tables("grains")),
        ),
        (
            "forces",
            (networks.plot_stress, tables("stress")),
            (networks.plot_forces, tables("forces")),
        ),
    ):
        draw(output[name], wide, (*first, styles), (*second, styles))

    figures = {name: output[name] for name in snakemake.params.figures}
    records = rows.to_dict("records")
    template = Path(files.template).read_text(encoding="utf-8")
    write_text(
        output.page, render_findings(template, records, verdicts(records), GOOD_DISTANCE, figures)
    )
