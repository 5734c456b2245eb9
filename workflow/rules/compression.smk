# Compression: a loose packing and its loading -> states, contacts and dumps along the path.


rule compression:
    input:
        # The same packing for the run with twice the strain steps.
        packing=lambda wildcards: "results/{}/seed_{}/packing.npz".format(
            wildcards.sample.removesuffix(REFINED), wildcards.seed
        ),
        inputs=[
            f"{workflow.basedir}/lammps_inputs/{file}"
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
        code=code("compression"),
    output:
        path="results/{sample}/seed_{seed}/path.csv",
        steps="results/{sample}/seed_{seed}/steps.csv",
        contacts="results/{sample}/seed_{seed}/contacts.parquet",
        walls="results/{sample}/seed_{seed}/wall_contacts.parquet",
        particles="results/{sample}/seed_{seed}/particles.dump.gz",
        pairs="results/{sample}/seed_{seed}/pairs.dump.gz",
    log:
        "logs/{sample}/seed_{seed}/compression.log",
    benchmark:
        "logs/{sample}/seed_{seed}/compression.time"
    conda:
        "../envs/branchcrush.yaml"
    params:
        sample=section("boundary", "contact", "initial_solid_fraction", "loading", "strain_step"),
    script:
        "../scripts/compression.py"
