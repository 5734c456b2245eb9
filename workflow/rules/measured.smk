# Measured: gradings before and after a test, and a compression curve -> breakage, the resistance to
# crushing, and a page of their own. No packing is needed for it, and none waits for it.


rule measured:
    input:
        data=gradings_of("before", "after"),
    output:
        **as_svg(["gradings"], "measured/{material}"),
        curves="results/measured/{material}/gradings.csv",
        breakage="results/measured/{material}/breakage.json",
        figure=measured_figure("gradings"),
        record="results/measured/{material}/made/measured.json",
    log:
        "logs/measured/{material}/measured.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("measured"),
        material=measured_keys("before", "after", "ultimate_alpha", "ultimate_smallest"),
        dpi=SETTINGS.figures.dpi,
    script:
        "../scripts/measured.py"


rule measured_resistance:
    input:
        data=gradings_of("before"),
        curve=lambda wildcards: local(material_of(wildcards)["compression"]["file"]),
    output:
        **as_svg(["compression"], "measured/{material}"),
        curve="results/measured/{material}/compression.csv",
        line="results/measured/{material}/compression_line.csv",
        summary="results/measured/{material}/compression.json",
        figure=measured_figure("compression"),
        record="results/measured/{material}/made/measured_resistance.json",
    log:
        "logs/measured/{material}/measured_resistance.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("measured_resistance"),
        material=measured_keys("before", "ultimate_alpha", "ultimate_smallest", "compression"),
        dpi=SETTINGS.figures.dpi,
    script:
        "../scripts/measured_resistance.py"


rule measured_page:
    input:
        breakages=expand("results/measured/{material}/breakage.json", material=MEASURED),
        gradings=expand("results/figures/measured/{material}/gradings.png", material=MEASURED),
        fits=expand("results/measured/{material}/compression.json", material=COMPRESSED),
        curves=expand("results/figures/measured/{material}/compression.png", material=COMPRESSED),
    output:
        page="results/measured.html",
        record="results/made/measured_page.json",
    log:
        "logs/measured_page.log",
    conda:
        "../envs/branchcrush.yaml"
    params:
        code=code("measured_page", *page_files(page="measured")),
        template=MEASURED_PAGE,
        glossary=GLOSSARY,
        materials=list(MEASURED),
        compressed=COMPRESSED,
    script:
        "../scripts/measured_page.py"
