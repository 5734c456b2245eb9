# Branch lengths: contacts at the end of the path and gradings -> B(l), N, rho and the moments.


rule branch_lengths:
    input:
        packings=of_all_seeds("packing.npz"),
        paths=of_all_seeds("path.csv"),
        contacts=of_all_seeds("contacts.parquet"),
        certificate="results/{sample}/certificate.csv",
        data=data_files,
        code=code("branch_lengths"),
    output:
        table="results/{sample}/branch_lengths.csv",
        statistics="results/{sample}/branch_lengths.json",
    log:
        "logs/{sample}/branch_lengths.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        sample=section("grading"),
        bins=SETTINGS.energy_split.bins,
    script:
        "../scripts/branch_lengths.py"
