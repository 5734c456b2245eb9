# Energy split: energies of the branches of all seeds -> f(l), its exponent, and it along the path.


rule energy_split:
    input:
        paths=of_all_seeds("path.csv"),
        contacts=of_all_seeds("contacts.parquet"),
        certificate="results/{sample}/certificate.csv",
        jamming="results/{sample}/jamming.csv",
        data=data_files,
    output:
        table=table("energy_split", "bins of the energy-split function"),
        fit="results/{sample}/energy_split.json",
        path=table("energy_split_path", "the exponent in every certified state"),
        ratio=table("energy_split_ratio", "energy of branches by the ratio of their radii"),
        record="results/{sample}/made/energy_split.json",
    log:
        "logs/{sample}/energy_split.log",
    # The model and its figures, the longest chain, wait for it.
    priority: 1
    conda:
        "../envs/branchcrush.yaml"
    resources:
        mem_mb=asked_to_read(),
    params:
        code=code("energy_split"),
        sample=section("grading", "seeds"),
        energy_split=SETTINGS.energy_split.model_dump(),
    script:
        "../scripts/energy_split.py"
