# Certificate: all paths of a sample -> which states a fit may use, phi_J, and the sample's verdict.


rule certificate:
    input:
        packings=of_all_seeds("packing.npz"),
        paths=of_all_seeds("path.csv"),
        steps=of_all_seeds("steps.csv"),
    output:
        states=table("certificate", "every saved state with its measures and verdict"),
        jamming=table("jamming", "jamming solid fraction of every packing, with its uncertainty"),
        record="results/{sample}/made/certificate.json",
    log:
        "logs/{sample}/certificate.log",
    # All that is fitted waits for it.
    priority: 1
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("certificate"),
        sample=section("packing", "contact", "seeds"),
    script:
        "../scripts/certificate.py"


rule verdict:
    input:
        states="results/{sample}/certificate.csv",
        refined_states=of_refined_sample("certificate.csv"),
        refined_jamming=of_refined_sample("jamming.csv"),
        jamming="results/{sample}/jamming.csv",
        grading="results/{sample}/grading.json",
        # Whether its interval tells n; fits take the states that are certified, not the verdict.
        fit="results/{sample}/energy_split.json",
        paths=of_all_seeds("path.csv"),
        refined_paths=of_refined_seeds("path.csv"),
        refined_contacts=of_refined_seeds("contacts.parquet"),
        readings=of_read_seeds("reading.json"),
        data=data_files,
    output:
        convergence=table("convergence", "the first seeds again with twice the strain steps"),
        certificate="results/{sample}/certificate.json",
        record="results/{sample}/made/verdict.json",
    log:
        "logs/{sample}/verdict.log",
    # Figures wait for it, as for the model, and both for the fit.
    priority: 1
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("verdict"),
        sample=section("packing", "grading", "seeds", "refined_seeds", "quality", "strain_step"),
        bins=SETTINGS.energy_split.bins,
    script:
        "../scripts/verdict.py"
