"""Put the radii of all packings that were read into one list, the grading of their sample."""

import numpy as np

from branchcrush.files.tables import provenance, read_packing, write_table
from branchcrush.records import recorded_job

with recorded_job(snakemake):
    radii = np.concatenate([read_packing(path)[1] for path in snakemake.input.packings])
    origin = provenance(sample=snakemake.wildcards.sample)
    write_table(snakemake.output.radii, {"radius_m": np.sort(radii)}, origin)
