# Grading: the packings of all seeds -> the grading they realise, beside the target and the ultimate.


rule grading:
    input:
        packings=of_all_seeds("packing.npz"),
        data=data_files,
    output:
        table=table("grading", "target, realised and ultimate grading, by number and by mass"),
        summary="results/{sample}/grading.json",
        record="results/{sample}/made/grading.json",
    log:
        "logs/{sample}/grading.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("grading"),
        sample=section(
            "packing",
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
