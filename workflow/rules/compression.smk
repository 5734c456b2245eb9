# Compression: grading, grains, seed and loading -> a loose packing, and states, contacts and dumps
# along its path. One job a seed: to place the grains takes less than to start one.


rule compression:
    input:
        data=data_files,
        inputs=[
            f"{ROOT}/lammps_inputs/{file}"
            for file in (
                "in.compress",
                "mod.cell",
                "mod.contact",
                "mod.edge",
                "mod.hertz",
                "mod.linear",
                "mod.mass",
                "mod.output",
                "mod.periodic",
                "mod.relax",
                "mod.state",
                "mod.step",
                "mod.strain",
                "mod.stress",
                "mod.target",
                "mod.undo",
                "mod.walls",
            )
        ],
    output:
        packing="results/{sample}/seed_{seed}/packing.npz",
        data="results/{sample}/seed_{seed}/packing.data",
        path="results/{sample}/seed_{seed}/path.csv",
        steps="results/{sample}/seed_{seed}/steps.csv",
        contacts="results/{sample}/seed_{seed}/contacts.parquet",
        walls="results/{sample}/seed_{seed}/wall_contacts.parquet",
        particles="results/{sample}/seed_{seed}/particles.dump.gz",
        pairs="results/{sample}/seed_{seed}/pairs.dump.gz",
    log:
        "logs/{sample}/seed_{seed}/compression.log",
    # Twice the strain steps take twice as long: begun first, they keep no core waiting at the end.
    priority: lambda wildcards: int(wildcards.sample in REFINED_SAMPLES)
    conda:
        "../envs/branchcrush.yaml"
    # MPI processes that share one packing; no more than there are cores. Not among the params: what
    # is certified does not depend on them.
    threads: lambda wildcards: sample_of(wildcards)["ranks"]
    params:
        code=code("compression"),
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
