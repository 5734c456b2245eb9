# Convergence: the same seeds with twice the strain steps -> how far the exponent depends on them.


rule convergence:
    input:
        fits=expand("results/{sample}/energy_split.json", sample=SAMPLES),
        refined=expand("results/{sample}/energy_split.json", sample=REFINED_SAMPLES),
        paths=lambda wildcards: [
            f"results/{name}/seed_{seed}/path.csv"
            for name, sample in {**SAMPLES, **REFINED_SAMPLES}.items()
            for seed in sample.seeds
        ],
        code=code("convergence"),
    output:
        "results/convergence.csv",
    log:
        "logs/convergence.log",
    benchmark:
        "logs/convergence.time"
    conda:
        "../envs/branchcrush.yaml"
    params:
        steps=[sample.loading.steps for sample in SAMPLES.values()],
        samples=list(SAMPLES),
    script:
        "../scripts/convergence.py"
