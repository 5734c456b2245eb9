# Packing: grading, grains, boundary and seed -> a loose packing; all packings -> the gradings.


rule packing:
    input:
        data=data_files,
        code=code("packing"),
    output:
        packing="results/{sample}/seed_{seed}/packing.npz",
        data="results/{sample}/seed_{seed}/packing.data",
    log:
        "logs/{sample}/seed_{seed}/packing.log",
    benchmark:
        "logs/{sample}/seed_{seed}/packing.time"
    conda:
        "../envs/branchcrush.yaml"
    params:
        sample=section("grading", "sampling", "grains", "boundary", "initial_solid_fraction"),
    script:
        "../scripts/packing.py"


rule grading:
    input:
        packings=of_all_seeds("packing.npz"),
        data=data_files,
        code=code("grading"),
    output:
        table="results/{sample}/grading.csv",
        summary="results/{sample}/grading.json",
    log:
        "logs/{sample}/grading.log",
    benchmark:
        "logs/{sample}/grading.time"
    conda:
        "../envs/branchcrush.yaml"
    params:
        sample=section(
            "grading",
            "sampling",
            "grains",
            "loading",
            "initial_solid_fraction",
            "allow_unrepresentative",
        ),
        ultimate_alpha=SETTINGS.thermodynamics.ultimate_alpha,
    script:
        "../scripts/grading.py"
