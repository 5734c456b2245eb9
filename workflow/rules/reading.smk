# Reading: grains and contacts of another code -> what a compression leaves, and the radii of all
# packings, which are the grading of the sample. All that follows is as for a packing made here.


rule read_packing:
    input:
        grains=packing_files("grains"),
        contacts=packing_files("contacts"),
    output:
        packing="results/{sample}/seed_{seed}/packing.npz",
        path="results/{sample}/seed_{seed}/path.csv",
        steps="results/{sample}/seed_{seed}/steps.csv",
        contacts="results/{sample}/seed_{seed}/contacts.parquet",
        walls="results/{sample}/seed_{seed}/wall_contacts.parquet",
        compressed="results/{sample}/seed_{seed}/compressed.parquet",
        report="results/{sample}/seed_{seed}/reading.json",
        record="results/{sample}/seed_{seed}/made.json",
    log:
        "logs/{sample}/seed_{seed}/read_packing.log",
    wildcard_constraints:
        sample=samples_where(lambda name: name in READ),
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("read_packing"),
        sample=section("packing", "boundary", "contact"),
    script:
        "../scripts/read_packing.py"


rule read_radii:
    input:
        packings=of_all_seeds("packing.npz"),
    output:
        radii="results/{sample}/radii.csv",
        record="results/{sample}/made/read_radii.json",
    log:
        "logs/{sample}/read_radii.log",
    wildcard_constraints:
        sample=samples_where(lambda name: name in READ),
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("read_radii"),
    script:
        "../scripts/read_radii.py"
