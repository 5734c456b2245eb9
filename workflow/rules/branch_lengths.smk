# Branch lengths: contacts along the path and gradings -> who touches whom, B(l) and what predicts
# it, N, rho and the moments.


rule branch_lengths:
    input:
        packings=of_all_seeds("packing.npz"),
        paths=of_all_seeds("path.csv"),
        contacts=of_all_seeds("contacts.parquet"),
        walls=of_all_seeds("wall_contacts.parquet"),
        certificate="results/{sample}/certificate.csv",
        jamming="results/{sample}/jamming.csv",
        data=data_files,
    output:
        table="results/{sample}/branch_lengths.csv",
        statistics="results/{sample}/branch_lengths.json",
        predictions="results/{sample}/length_predictions.csv",
        numbers="results/{sample}/contact_numbers.csv",
        pairs="results/{sample}/contact_pairs.csv",
        coordination="results/{sample}/coordination.csv",
        contact_numbers="results/{sample}/contact_numbers.json",
        record="results/{sample}/made/branch_lengths.json",
    log:
        "logs/{sample}/branch_lengths.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("branch_lengths"),
        sample=section("grading"),
        bins=SETTINGS.energy_split.bins,
        intervals=INTERVALS,
    script:
        "../scripts/branch_lengths.py"
