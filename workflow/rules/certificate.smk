# Certificate: all paths of a sample -> which states a fit may use, phi_J, and the sample's verdict.


rule certificate:
    input:
        # The same packings for the runs with twice the strain steps.
        packings=lambda wildcards: of_seeds(
            "packing.npz",
            wildcards.sample.removesuffix(REFINED),
            sample_of(wildcards)["seeds"],
        ),
        paths=of_all_seeds("path.csv"),
        steps=of_all_seeds("steps.csv"),
        code=code("certificate"),
    output:
        states="results/{sample}/certificate.csv",
        jamming="results/{sample}/jamming.csv",
    log:
        "logs/{sample}/certificate.log",
    benchmark:
        "logs/{sample}/certificate.time"
    conda:
        "../envs/branchcrush.yaml"
    params:
        sample=section("contact", "seeds"),
    script:
        "../scripts/certificate.py"


rule convergence:
    input:
        certificates=lambda wildcards: [
            f"results/{name}/certificate.csv"
            for name in (wildcards.sample, wildcards.sample + REFINED)
            if wildcards.sample + REFINED in REFINED_SAMPLES
        ],
        paths=of_refined_seeds("path.csv", refined=False),
        contacts=of_refined_seeds("contacts.parquet", refined=False),
        refined_paths=of_refined_seeds("path.csv", refined=True),
        refined_contacts=of_refined_seeds("contacts.parquet", refined=True),
        data=data_files,
        code=code("convergence"),
    output:
        "results/{sample}/convergence.csv",
    log:
        "logs/{sample}/convergence.log",
    benchmark:
        "logs/{sample}/convergence.time"
    conda:
        "../envs/branchcrush.yaml"
    params:
        sample=section("grading", "seeds", "refined_seeds", "strain_step"),
        bins=SETTINGS.energy_split.bins,
    script:
        "../scripts/convergence.py"


rule verdict:
    input:
        states="results/{sample}/certificate.csv",
        jamming="results/{sample}/jamming.csv",
        convergence="results/{sample}/convergence.csv",
        grading="results/{sample}/grading.json",
        paths=of_all_seeds("path.csv"),
        code=code("verdict"),
    output:
        "results/{sample}/certificate.json",
    log:
        "logs/{sample}/verdict.log",
    benchmark:
        "logs/{sample}/verdict.time"
    conda:
        "../envs/branchcrush.yaml"
    params:
        sample=section("seeds", "quality", "strain_step"),
    script:
        "../scripts/verdict.py"
