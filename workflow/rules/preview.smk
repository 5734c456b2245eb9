# Preview: the configuration alone -> what each sample will be, cost and take on this machine.


rule preview:
    input:
        data=[file for name in SAMPLES if name not in READ for file in data_of(SAMPLES[name])],
    log:
        "logs/preview.log",
    localrule: True
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("preview"),
        inputs=str(LAMMPS_INPUTS),
        # No output of the workflow, nor a benchmark, which is one: a preview is made anew each
        # time it is asked for.
        text="results/preview.txt",
        figures=[f"results/figures/{sample}/preview.png" for sample in SAMPLES],
        samples=SAMPLES,
        measured={name: list(material) for name, material in MEASURED.items()},
        ultimate_alpha=SETTINGS.thermodynamics.ultimate_alpha,
        # `workflow.cores` refuses where none are given, as with --unlock.
        cores=workflow.resource_settings.cores or 1,
        dpi=SETTINGS.figures.dpi,
    script:
        "../scripts/preview.py"
