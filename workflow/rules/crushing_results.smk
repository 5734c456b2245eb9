# What crushing showed, of the samples whose grains break: all seeds of one -> tables and figures;
# all samples -> a page of their own, only where there are any.


rule crushing_results:
    input:
        paths=of_crushed_seeds("path.csv"),
        grains=of_crushed_seeds("grains.parquet"),
        contacts=of_crushed_seeds("contacts.parquet"),
        halved_paths=of_halved_seeds("path.csv"),
        halved_grains=of_halved_seeds("grains.parquet"),
        halved_contacts=of_halved_seeds("contacts.parquet"),
        controls=of_all_seeds("path.csv"),
        fit="results/{sample}/energy_split.json",
    output:
        states=table("crushing_states", "every state of every crushing: grading, energies, strain"),
        means=table("crushing_means", "means over the seeds along the crushing"),
        gradings=table("crushing_gradings", "gradings at stages of crushing"),
        lengths=table("crushing_lengths", "branch lengths at stages of crushing"),
        line=table("crushing_line", "the compression line, and the one of the gradings alone"),
        beside=table("crushing_beside_forms", "what every form of the model says of the crushing"),
        summary="results/{sample}/crushing.json",
        record="results/{sample}/made/crushing_results.json",
    log:
        "logs/{sample}/crushing_results.log",
    conda:
        "../envs/branchcrush.yaml"
    resources:
        mem_mb=asked_to_read(crushed=True),
    params:
        code=code("crushing_results"),
        sample=section("contact", "breakage", "seeds"),
        halved=lambda wildcards: REFINED_SAMPLES.get(wildcards.sample + REFINED, {}).get(
            "seeds", []
        ),
        thermodynamics={
            key: getattr(SETTINGS.thermodynamics, key)
            for key in ("ultimate_alpha", "hardening_exponent", "rod_gap")
        },
        intervals=INTERVALS,
    script:
        "../scripts/crushing_results.py"


rule crushing_predicted:
    input:
        paths=of_crushed_seeds("path.csv"),
        grains=of_crushed_seeds("grains.parquet"),
        data=data_files,
    output:
        predicted=table("crushing_predicted", "crushing without a simulation, along the path"),
        beside=table("crushing_beside_predicted", "the same beside the simulated states"),
        summary="results/{sample}/crushing_predicted.json",
        record="results/{sample}/made/crushing_predicted.json",
    log:
        "logs/{sample}/crushing_predicted.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("crushing_predicted"),
        sample=section("grading", "contact", "breakage", "boundary", "seeds"),
        confidence=INTERVALS["confidence"],
    script:
        "../scripts/crushing_predicted.py"


rule crushing_figures:
    input:
        **{name: f"results/{{sample}}/{file}.csv" for name, file in CRUSHING_TABLES.items()},
        summary="results/{sample}/crushing.json",
        prediction="results/{sample}/crushing_predicted.json",
        controls=of_all_seeds("path.csv"),
        grains=lambda wildcards: of_crushed_seeds("grains.parquet")(wildcards)[:1],
        path=lambda wildcards: of_crushed_seeds("path.csv")(wildcards)[:1],
        contacts=lambda wildcards: of_crushed_seeds("contacts.parquet")(wildcards)[:1],
        walls=lambda wildcards: of_crushed_seeds("wall_contacts.parquet")(wildcards)[:1],
    output:
        **{name: figure(name) for name in CRUSHING_FIGURES},
        **as_svg(CRUSHING_FIGURES),
        view="results/figures/{sample}/crushed_view.json",
        record="results/{sample}/made/crushing_figures.json",
    log:
        "logs/{sample}/crushing_figures.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("crushing_figures"),
        sample=section("contact", "boundary"),
        views=len(BREAKING),
        tables=list(CRUSHING_TABLES),
        dpi=SETTINGS.figures.dpi,
    script:
        "../scripts/crushing_figures.py"


rule crushing_page:
    input:
        **{
            name: expand(f"results/figures/{{sample}}/{name}.png", sample=BREAKING)
            for name in CRUSHING_FIGURES + GRAINS_FIGURES
        },
        summaries=expand("results/{sample}/crushing.json", sample=BREAKING),
        grains=expand("results/{sample}/crushed_grains.json", sample=BREAKING),
        predicted=expand("results/{sample}/crushing_predicted.json", sample=BREAKING),
        beside=expand("results/{sample}/crushing_beside_forms.csv", sample=BREAKING),
        means=expand("results/{sample}/crushing_means.csv", sample=BREAKING),
        views=expand("results/figures/{sample}/crushed_view.json", sample=BREAKING),
    output:
        page="results/crushing.html",
        record="results/made/crushing_page.json",
    log:
        "logs/crushing_page.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("crushing_page", *page_files(*VIEWER, page="crushing")),
        template=CRUSHING_PAGE,
        glossary=GLOSSARY,
        samples=BREAKING,
        figures=CRUSHING_FIGURES + GRAINS_FIGURES,
    script:
        "../scripts/crushing_page.py"
