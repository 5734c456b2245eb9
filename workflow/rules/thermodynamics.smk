# Thermodynamics: exponent, gradings, contact numbers and measured energy -> every form of the
# crushing model.


rule thermodynamics:
    input:
        paths=of_all_seeds("path.csv"),
        fit="results/{sample}/energy_split.json",
        certificate="results/{sample}/certificate.csv",
        jamming="results/{sample}/jamming.csv",
        numbers="results/{sample}/contact_numbers.csv",
        history=history_files,
        data=data_files,
    output:
        curves=table(
            "thermodynamics", "curves of the crushing model at fixed and evolving crushing"
        ),
        forms=table("crushing_forms", "what every form of the crushing model says at each C"),
        events=table("crushing_events", "where crushing begins, leaps and locks"),
        elastic=table("elastic_law", "stress of the packings beside that of the elastic law"),
        summary="results/{sample}/thermodynamics.json",
        record="results/{sample}/made/thermodynamics.json",
    log:
        "logs/{sample}/thermodynamics.log",
    # The model and its figures, the longest chain, wait for it.
    priority: 1
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("thermodynamics"),
        sample=section("grading", "contact"),
        thermodynamics=SETTINGS.thermodynamics.model_dump(),
        confidence=SETTINGS.energy_split.confidence,
    script:
        "../scripts/thermodynamics.py"
