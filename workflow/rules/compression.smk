# Compression: a loose packing and its loading -> states, contacts and dumps along the path.


rule compression:
    input:
        packing="results/{sample}/seed_{seed}/packing.npz",
        inputs=expand(
            "lammps_inputs/{file}",
            file=[
                "in.compress",
                "mod.contact",
                "mod.walls",
                "mod.periodic",
                "mod.output",
                "mod.strain",
                "mod.relax",
                "mod.state",
            ],
        ),
        code=code("compression"),
    output:
        path="results/{sample}/seed_{seed}/path.csv",
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
        sample=section("boundary", "contact", "loading"),
    script:
        "../scripts/compression.py"
