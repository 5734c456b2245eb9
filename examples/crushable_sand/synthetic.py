"""Make the synthetic material of this example from known parameters: no laboratory measured it.

    python synthetic.py

writes `synthetic_before.csv`, `synthetic_after.csv` and `synthetic_compression.csv`.
"""

from pathlib import Path

import numpy as np

from branchcrush.branches.crushing_forms import crushing_forms
from branchcrush.branches.mixing import mixing_path
from branchcrush.config.build import grading_of
from branchcrush.crushing.compression_fit import elastic_strain_family
from branchcrush.crushing.compression_line import compression_line
from branchcrush.crushing.elasticity import PowerLawElasticity
from branchcrush.gradings.forms import fractal
from branchcrush.packings.contact_laws import contact_law

HERE = Path(__file__).parent
# The truth, which the fit has to find.
ELASTIC_STRAIN, STRENGTH_EXPONENT = 0.010, 1.0
INITIAL_VOID_RATIO, LATERAL_STRESS_RATIO, SHARE_OF_AFFINE = 0.80, 0.45, 0.8
SCATTER = 0.002  # of void ratios
# [mm] and percent finer by mass
BEFORE = {0.85: 100, 0.71: 84, 0.6: 52, 0.5: 20, 0.425: 0}
SIEVES = (0.85, 0.71, 0.6, 0.5, 0.425, 0.3, 0.212, 0.15, 0.106, 0.075, 0.053, 0.038, 0.02)
STRESS = np.geomspace(0.5, 64.0, 22)  # axial [MPa]


def table(path: Path, header: str, rows: dict[float, float]) -> None:
    """Write a table of two columns."""
    lines = [f"{first:g},{second:.4g}" for first, second in rows.items()]
    path.write_text("\n".join(["# synthetic: see synthetic.py", header, *lines]) + "\n")


table(HERE / "synthetic_before.csv", "mm,percent finer", BEFORE)
sieve = {"form": "sieve", "basis": "mass", "size": "diameter", "unit": "mm"}
before = grading_of({**sieve, "file": HERE / "synthetic_before.csv"})
ultimate = fractal(0.01e-3, before.support()[1], 2.6)
quartz = contact_law("hertz", young_modulus=70.0e9, poisson_ratio=0.17)
path = mixing_path(before, ultimate, quartz)
form = crushing_forms(path, before, ultimate, exponent=3.0)["moving_jamming"]
elasticity = PowerLawElasticity(SHARE_OF_AFFINE * path.modulus[0] / 3.0**2.5, 1.5)
limits = elastic_strain_family(path.crushing, path.contact_diameter, lambda b: -2.0 * b / 3.0)
pressure = (1.0 + 2.0 * LATERAL_STRESS_RATIO) / 3.0 * STRESS * 1e6
line = compression_line(
    pressure, form, elasticity, limits.resistance(ELASTIC_STRAIN, STRENGTH_EXPONENT)
)
void_ratio = (1.0 + INITIAL_VOID_RATIO) * (1.0 - line.strain) - 1.0
void_ratio += np.random.default_rng(1).normal(0.0, SCATTER, STRESS.size)
shown = dict(zip(STRESS, np.minimum(void_ratio, INITIAL_VOID_RATIO), strict=True))
table(
    HERE / "synthetic_compression.csv",
    "axial stress [MPa],void ratio",
    {0.0: INITIAL_VOID_RATIO, **shown},
)
# Mixtures by mass: the share of the ultimate grading is Einav's B as well.
crushed = float(line.crushing[-1])
radii = np.array(SIEVES) / 2e3
finer = 100.0 * ((1.0 - crushed) * before.mass_cdf(radii) + crushed * ultimate.mass_cdf(radii))
table(HERE / "synthetic_after.csv", "mm,percent finer", dict(zip(SIEVES, finer, strict=True)))
print(f"C = B = {crushed:.4f} at the end")
