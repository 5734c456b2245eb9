# Who breaks, who survives, and the energy split while grains break: all seeds of a sample, beside
# the packings whose grains do not.


rule crushed_grains:
    input:
        crushed_paths=of_crushed_seeds("path.csv"),
        grains=of_crushed_seeds("grains.parquet"),
        crushed_contacts=of_crushed_seeds("contacts.parquet"),
        crushed_walls=of_crushed_seeds("wall_contacts.parquet"),
        breakages=of_crushed_seeds("breakages.parquet"),
        packings=of_all_seeds("packing.npz"),
        paths=of_all_seeds("path.csv"),
        contacts=of_all_seeds("contacts.parquet"),
        walls=of_all_seeds("wall_contacts.parquet"),
    output:
        areas=table("crushed_predictors", "how well a state foretells which grains break"),
        curves=table("crushed_roc", "ROC curves of what foretells breaking"),
        hazards=table("crushed_hazards", "breakages per grain and state, by contacts and radius"),
        survivors=table("crushed_survivors", "first grains left, by radius and by contacts"),
        survival=table("crushed_survival", "first grains left along the path"),
        exponents=table("crushed_exponents", "energy split along the crushing, beside the control"),
        loads=table("crushed_loads", "contacts, rattlers and forces by size at the end"),
        overshoots=table("crushed_overshoots", "stress at breaking over the strength"),
        summary="results/{sample}/crushed_grains.json",
        record="results/{sample}/made/crushed_grains.json",
    log:
        "logs/{sample}/crushed_grains.log",
    conda:
        "../envs/branchcrush.yaml"
    resources:
        mem_mb=asked_to_read(crushed=True),
    params:
        code=code("crushed_grains"),
        sample=section("breakage", "seeds"),
        intervals=INTERVALS,
    script:
        "../scripts/crushed_grains.py"


rule crushed_grains_figures:
    input:
        areas="results/{sample}/crushed_predictors.csv",
        curves="results/{sample}/crushed_roc.csv",
        hazards="results/{sample}/crushed_hazards.csv",
        exponents="results/{sample}/crushed_exponents.csv",
        loads="results/{sample}/crushed_loads.csv",
    output:
        **{name: figure(name) for name in GRAINS_FIGURES},
        **as_svg(GRAINS_FIGURES),
        record="results/{sample}/made/crushed_grains_figures.json",
    log:
        "logs/{sample}/crushed_grains_figures.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("crushed_grains_figures"),
        dpi=SETTINGS.figures.dpi,
        # Of the captions.
        limit=lambda wildcards: settings_of(wildcards)["breakage"]["smallest_diameter"] * 1e3,
        seeds=lambda wildcards: len(settings_of(wildcards)["seeds"]),
    script:
        "../scripts/crushed_grains_figures.py"
