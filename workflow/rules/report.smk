# Report: results of every sample -> figures, one table of all samples, and the page to open.

FIGURES = [
    "fig3_grading",
    "fig4_packing",
    "fig5_energy_split",
    "fig6_cubic",
    "fig7_branch_lengths",
    "exponent_path",
    "loading_path",
    "certificate",
    "crushing_model",
]


rule figures:
    input:
        grading="results/{sample}/grading.csv",
        split="results/{sample}/energy_split.csv",
        fit="results/{sample}/energy_split.json",
        split_path="results/{sample}/energy_split_path.csv",
        lengths="results/{sample}/branch_lengths.csv",
        statistics="results/{sample}/branch_lengths.json",
        curves="results/{sample}/thermodynamics.csv",
        summary="results/{sample}/thermodynamics.json",
        states="results/{sample}/certificate.csv",
        certificate="results/{sample}/certificate.json",
        jamming="results/{sample}/jamming.csv",
        data=data_files,
        paths=of_all_seeds("path.csv"),
        packings=of_all_seeds("packing.npz"),
        particles=of_all_seeds("particles.dump.gz"),
        code=code("figures"),
    output:
        **{name: f"results/figures/{{sample}}/{name}.png" for name in FIGURES},
    log:
        "logs/{sample}/figures.log",
    benchmark:
        "logs/{sample}/figures.time"
    conda:
        "../envs/branchcrush.yaml"
    params:
        sample=section("grading", "contact"),
        dpi=SETTINGS.figures.dpi,
    script:
        "../scripts/figures.py"


rule comparison:
    input:
        fits=expand("results/{sample}/energy_split.json", sample=SAMPLES),
        summaries=expand("results/{sample}/thermodynamics.json", sample=SAMPLES),
        certificates=expand("results/{sample}/certificate.json", sample=SAMPLES),
        code=code("comparison"),
    output:
        "results/comparison.csv",
    log:
        "logs/comparison.log",
    benchmark:
        "logs/comparison.time"
    conda:
        "../envs/branchcrush.yaml"
    params:
        samples=list(SAMPLES),
    script:
        "../scripts/comparison.py"


rule report:
    input:
        template=f"{workflow.basedir}/workflow/report/report.html.jinja",
        comparison="results/comparison.csv",
        fits=expand("results/{sample}/energy_split.json", sample=SAMPLES),
        summaries=expand("results/{sample}/thermodynamics.json", sample=SAMPLES),
        statistics=expand("results/{sample}/branch_lengths.json", sample=SAMPLES),
        certificates=expand("results/{sample}/certificate.json", sample=SAMPLES),
        gradings=expand("results/{sample}/grading.json", sample=SAMPLES),
        figures=expand("results/figures/{sample}/{figure}.png", sample=SAMPLES, figure=FIGURES),
        code=code("report"),
    output:
        "results/report.html",
    log:
        "logs/report.log",
    benchmark:
        "logs/report.time"
    conda:
        "../envs/branchcrush.yaml"
    params:
        samples=SAMPLES,
    script:
        "../scripts/report.py"
