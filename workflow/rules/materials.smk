# What the rules of measured.smk are given of each material of the section `measured`.

COMPRESSED = [name for name, material in MEASURED.items() if "compression" in material]
MEASURED_PAGE = str(ROOT / "workflow/report/measured.html.jinja")


def material_of(wildcards):
    return MEASURED[wildcards.material]


def gradings_of(*names):
    """Return an input function for the files of some gradings of a material."""
    return lambda wildcards: [
        local(file)
        for name in names
        for file in grading_data_files(material_of(wildcards).get(name, {}))
    ]


def measured_keys(*names):
    """Return a params function for some keys of a material, as plain values."""
    return lambda wildcards: {name: material_of(wildcards).get(name) for name in names}


def measured_figure(name):
    return report(
        f"results/figures/measured/{{material}}/{name}.png",
        caption=f"../report/captions/measured_{name}.rst",
        category="Measured {material}",
        labels={"figure": name},
    )
