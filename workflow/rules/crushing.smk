# Crushing: a placed packing and the strength of its grains -> states, grains, contacts and what
# broke along the path, beside the packing whose grains do not break.


rule crushing:
    input:
        packing="results/{sample}/seed_{seed}/packing.npz",
        data=data_files,
    output:
        path="results/{sample}/crushing/seed_{seed}/path.csv",
        steps="results/{sample}/crushing/seed_{seed}/steps.csv",
        contacts="results/{sample}/crushing/seed_{seed}/contacts.parquet",
        walls="results/{sample}/crushing/seed_{seed}/wall_contacts.parquet",
        grains="results/{sample}/crushing/seed_{seed}/grains.parquet",
        breakages="results/{sample}/crushing/seed_{seed}/breakages.parquet",
        record="results/{sample}/crushing/seed_{seed}/made.json",
    log:
        "logs/{sample}/seed_{seed}/crushing.log",
    # Takes longest: begun first, it keeps no core waiting at the end.
    priority: 2
    conda:
        "../envs/branchcrush.yaml"
    threads: lambda wildcards: settings_of(wildcards)["ranks"]
    resources:
        mem_mb=asked("mem_mb", crushed=True),
        runtime=asked("runtime", crushed=True),
    params:
        code=code(
            "crushing",
            *sorted(LAMMPS_INPUTS.glob("in.*")),
            *sorted(LAMMPS_INPUTS.glob("mod.*")),
        ),
        inputs=str(LAMMPS_INPUTS),
        keep_dumps=SETTINGS.keep_dumps,
        sample=section(
            "grading",
            "sampling",
            "grains",
            "boundary",
            "initial_solid_fraction",
            "contact",
            "loading",
            "strain_step",
            "state_tolerance",
            "breakage",
        ),
    script:
        "../scripts/crushing.py"
