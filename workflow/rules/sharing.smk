# Sharing: contact networks of all seeds -> energy, force and stress by grain and by branch.


rule sharing:
    input:
        packings=of_all_seeds("packing.npz"),
        paths=of_all_seeds("path.csv"),
        contacts=of_all_seeds("contacts.parquet"),
        walls=of_all_seeds("wall_contacts.parquet"),
        certificate="results/{sample}/certificate.csv",
        data=data_files,
    output:
        shielding_branches=table(
            "shielding_branches", "energy of branches against the ratio of their radii"
        ),
        shielding_grains=table(
            "shielding_grains",
            "energy of grains against their radius over that of their neighbours",
        ),
        force_distribution=table("force_distribution", "distribution of normal forces"),
        force_by_length=table("force_by_length", "normal force against branch length"),
        fabric=table("fabric", "fabric tensors, beside chance"),
        stress_by_radius=table("stress_by_radius", "mean stress of grains against their radius"),
        stress_sharing=table(
            "stress_sharing", "cumulative share of the stress against that of the volume"
        ),
        summary="results/{sample}/sharing.json",
        record="results/{sample}/made/sharing.json",
    log:
        "logs/{sample}/sharing.log",
    conda:
        "../envs/branchcrush.yaml"
    resources:
        mem_mb=asked_to_read(),
    params:
        code=code("sharing"),
        sample=section("grading", "contact"),
        bins=SETTINGS.energy_split.bins,
        intervals=INTERVALS,
    script:
        "../scripts/sharing.py"
