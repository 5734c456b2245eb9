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
        table=table(
            "branch_lengths", "counts and densities of branch lengths, measured and predicted"
        ),
        statistics="results/{sample}/branch_lengths.json",
        predictions=table(
            "length_predictions",
            "how far each prediction of branch lengths is off, in every state",
        ),
        numbers=table(
            "contact_numbers", "contacts of a grain against its radius, measured and predicted"
        ),
        pairs=table("contact_pairs", "how often radii meet"),
        coordination=table(
            "coordination", "coordination numbers and rattlers of every packing in every state"
        ),
        contact_numbers="results/{sample}/contact_numbers.json",
        record="results/{sample}/made/branch_lengths.json",
    log:
        "logs/{sample}/branch_lengths.log",
    conda:
        "../envs/branchcrush.yaml"
    resources:
        mem_mb=asked_to_read(),
    params:
        code=code("branch_lengths"),
        sample=section("grading"),
        bins=SETTINGS.energy_split.bins,
        intervals=INTERVALS,
    script:
        "../scripts/branch_lengths.py"
