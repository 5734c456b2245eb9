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
        shielding_branches="results/{sample}/shielding_branches.csv",
        shielding_grains="results/{sample}/shielding_grains.csv",
        force_distribution="results/{sample}/force_distribution.csv",
        force_by_length="results/{sample}/force_by_length.csv",
        fabric="results/{sample}/fabric.csv",
        stress_by_radius="results/{sample}/stress_by_radius.csv",
        stress_sharing="results/{sample}/stress_sharing.csv",
        summary="results/{sample}/sharing.json",
        record="results/{sample}/made/sharing.json",
    log:
        "logs/{sample}/sharing.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("sharing"),
        sample=section("grading", "contact"),
        bins=SETTINGS.energy_split.bins,
        intervals=INTERVALS,
    script:
        "../scripts/sharing.py"
