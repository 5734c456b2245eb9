# Packing: grading, grains, boundary and seed -> a loose packing; all packings -> the gradings.


rule packing:
    input:
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
        sample=section("grading", "grains", "boundary", "initial_solid_fraction"),
    script:
        "../scripts/packing.py"


rule grading:
    input:
        packings=of_all_seeds("packing.npz"),
        code=code("grading"),
    output:
        "results/{sample}/grading.csv",
    log:
        "logs/{sample}/grading.log",
    benchmark:
        "logs/{sample}/grading.time"
    conda:
        "../envs/branchcrush.yaml"
    params:
        sample=section("grading"),
    script:
        "../scripts/grading.py"
