# Report: results of every sample -> figures, one table of all samples, and the page to open.

# As measured, and what is fitted: only the second show the crushing model. Halves of about equal
# work, so that both cores draw those of one sample, and no more jobs, since each loads the plotting
# library once more.
PACKING_FIGURES = [
    "fig3_grading",
    "fig4_packing",
    "certificate",
    "who_touches_whom",
    "sharing",
    "force_chains",
    "contact_rose",
]
FIT_FIGURES = [
    "fig5_energy_split",
    "fig6_cubic",
    "fig7_branch_lengths",
    "exponent_path",
    "predictors",
    "loading_path",
    "compression_curve",
    "crushing_model",
    "crushing_energy",
    "crushing_yield",
    "crushing_path",
]
NETWORK_TABLES = [
    "contact_numbers",
    "contact_pairs",
    "length_predictions",
    "shielding_branches",
    "shielding_grains",
    "force_distribution",
    "force_by_length",
    "fabric",
    "stress_by_radius",
    "stress_sharing",
]
FIGURES = PACKING_FIGURES + FIT_FIGURES
REPORT, TOGETHER = (
    str(ROOT / f"workflow/report/{page}.html.jinja") for page in ("report", "together")
)

FINDINGS = ["exponents", "lengths", "energies", "coordination", "shielding", "forces"]
# Samples beside each other: the figures of one sample alone show all of it.
TOGETHER_FIGURES = FINDINGS if len(SAMPLES) > 1 else []


rule packing_figures:
    input:
        **{name: f"results/{{sample}}/{name}.csv" for name in NETWORK_TABLES},
        numbers="results/{sample}/contact_numbers.json",
        shared="results/{sample}/sharing.json",
        grading="results/{sample}/grading.csv",
        states="results/{sample}/certificate.csv",
        certificate="results/{sample}/certificate.json",
        jamming="results/{sample}/jamming.csv",
        data=data_files,
        path=of_first_seed("path.csv"),
        packing=of_first_seed("packing.npz"),
        compressed=of_first_seed("compressed.parquet"),
        contacts=of_first_seed("contacts.parquet"),
        walls=of_first_seed("wall_contacts.parquet"),
        reading=of_first_read_seed("reading.json"),
    output:
        **{name: figure(name) for name in PACKING_FIGURES},
        **as_svg(PACKING_FIGURES),
        view="results/figures/{sample}/view.json",
        record="results/{sample}/made/packing_figures.json",
    log:
        "logs/{sample}/packing_figures.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("packing_figures"),
        sample=section("grading", "contact", "boundary"),
        tables=NETWORK_TABLES,
        views=len(SAMPLES),
        dpi=SETTINGS.figures.dpi,
    script:
        "../scripts/packing_figures.py"


rule fit_figures:
    input:
        split="results/{sample}/energy_split.csv",
        fit="results/{sample}/energy_split.json",
        split_path="results/{sample}/energy_split_path.csv",
        ratio="results/{sample}/energy_split_ratio.csv",
        lengths="results/{sample}/branch_lengths.csv",
        statistics="results/{sample}/branch_lengths.json",
        curves="results/{sample}/thermodynamics.csv",
        forms="results/{sample}/crushing_forms.csv",
        summary="results/{sample}/thermodynamics.json",
        paths=of_all_seeds("path.csv"),
        data=data_files,
    output:
        **{name: figure(name) for name in FIT_FIGURES},
        **as_svg(FIT_FIGURES),
        record="results/{sample}/made/fit_figures.json",
    log:
        "logs/{sample}/fit_figures.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("fit_figures"),
        sample=section("grading"),
        dpi=SETTINGS.figures.dpi,
    script:
        "../scripts/fit_figures.py"


rule comparison:
    input:
        fits=expand("results/{sample}/energy_split.json", sample=SAMPLES),
        summaries=expand("results/{sample}/thermodynamics.json", sample=SAMPLES),
        certificates=expand("results/{sample}/certificate.json", sample=SAMPLES),
    output:
        table=study_table(
            "comparison", "a row for each sample: verdict, exponent with its interval, model"
        ),
        # No job of its own, which would take a second to start and a moment to write it.
        package="results/datapackage.json",
        config="results/config.json",
        record="results/made/comparison.json",
    log:
        "logs/comparison.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("comparison"),
        config=SETTINGS.model_dump(mode="json", exclude_none=True),
        samples=SAMPLES,
        read=sorted(READ),
        run_again={name: sample["seeds"] for name, sample in REFINED_SAMPLES.items()},
        dictionary=dictionary_digest(),
        measured={name: "compression" in material for name, material in MEASURED.items()},
        breaking=[
            name for name, sample in {**SAMPLES, **REFINED_SAMPLES}.items() if sample["breakage"]
        ],
    script:
        "../scripts/comparison.py"


rule report:
    input:
        **{
            name: expand(f"results/figures/{{sample}}/{name}.png", sample=SAMPLES)
            for name in FIGURES
        },
        **{f"findings_{name}": f"results/figures/findings/{name}.png" for name in TOGETHER_FIGURES},
        rows="results/findings.csv",
        fits=expand("results/{sample}/energy_split.json", sample=SAMPLES),
        summaries=expand("results/{sample}/thermodynamics.json", sample=SAMPLES),
        forms=expand("results/{sample}/crushing_forms.csv", sample=SAMPLES),
        statistics=expand("results/{sample}/branch_lengths.json", sample=SAMPLES),
        certificates=expand("results/{sample}/certificate.json", sample=SAMPLES),
        gradings=expand("results/{sample}/grading.json", sample=SAMPLES),
        views=expand("results/figures/{sample}/view.json", sample=SAMPLES),
    output:
        "results/report.html",
        record="results/made/report.json",
    log:
        "logs/report.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("report", *page_files("sample", "together", *VIEWER, page="report")),
        templates=[REPORT, TOGETHER],
        glossary=GLOSSARY,
        samples=SAMPLES,
        figures=FIGURES,
        findings=TOGETHER_FIGURES,
        measured=bool(MEASURED),
    script:
        "../scripts/report.py"


rule findings:
    input:
        fits=expand("results/{sample}/energy_split.json", sample=SAMPLES),
        paths=expand("results/{sample}/energy_split_path.csv", sample=SAMPLES),
        states=expand("results/{sample}/coordination.csv", sample=SAMPLES),
        numbers=expand("results/{sample}/contact_numbers.json", sample=SAMPLES),
        shared=expand("results/{sample}/sharing.json", sample=SAMPLES),
        certificates=expand("results/{sample}/certificate.json", sample=SAMPLES),
    output:
        rows=study_table(
            "findings", "a row for each sample: exponents, predictors, shielding, forces"
        ),
        exponents=study_table("exponents", "the exponent in every state of every sample"),
        states=study_table("coordination", "coordination numbers of every packing of every sample"),
        record="results/made/findings.json",
    log:
        "logs/findings.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("findings"),
        samples=SAMPLES,
        intervals=INTERVALS,
    script:
        "../scripts/findings.py"


rule findings_figures:
    input:
        rows="results/findings.csv",
        states="results/coordination.csv",
        paths=expand("results/{sample}/energy_split_path.csv", sample=SAMPLES),
        grains=expand("results/{sample}/shielding_grains.csv", sample=SAMPLES),
        branches=expand("results/{sample}/shielding_branches.csv", sample=SAMPLES),
        stress=expand("results/{sample}/stress_sharing.csv", sample=SAMPLES),
        forces=expand("results/{sample}/force_distribution.csv", sample=SAMPLES),
    output:
        **{name: study_figure(name) for name in FINDINGS},
        **as_svg(FINDINGS, "findings"),
        record="results/made/findings_figures.json",
    log:
        "logs/findings_figures.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("findings_figures"),
        samples=SAMPLES,
        dpi=SETTINGS.figures.dpi,
    script:
        "../scripts/findings_figures.py"
