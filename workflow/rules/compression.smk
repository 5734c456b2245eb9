# Compression: grading, grains, seed and loading -> a loose packing, and states, contacts and dumps
# along its path. Dumps are no outputs: who deletes one, or keeps none, misses no result. One job a
# seed: to place the grains takes less than to start one.


LAMMPS_INPUTS = ROOT / "lammps_inputs"


rule compression:
    input:
        data=data_files,
    output:
        packing="results/{sample}/seed_{seed}/packing.npz",
        data="results/{sample}/seed_{seed}/packing.data",
        path="results/{sample}/seed_{seed}/path.csv",
        steps="results/{sample}/seed_{seed}/steps.csv",
        contacts="results/{sample}/seed_{seed}/contacts.parquet",
        walls="results/{sample}/seed_{seed}/wall_contacts.parquet",
        compressed="results/{sample}/seed_{seed}/compressed.parquet",
        record="results/{sample}/seed_{seed}/made.json",
    log:
        "logs/{sample}/seed_{seed}/compression.log",
    wildcard_constraints:
        sample=samples_where(lambda name: name not in READ),
    # Twice the strain steps take twice as long: begun first, they keep no core waiting at the end.
    priority: lambda wildcards: int(wildcards.sample in REFINED_SAMPLES)
    conda:
        "../envs/branchcrush.yaml"
    # MPI processes that share one packing; no more than there are cores. Not among the params: what
    # is certified does not depend on them.
    threads: lambda wildcards: settings_of(wildcards)["ranks"]
    resources:
        mem_mb=asked("mem_mb"),
        runtime=asked("runtime"),
    params:
        # A script includes others by names that it makes up: all that there are.
        code=code(
            "compression",
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
        ),
    script:
        "../scripts/compression.py"
