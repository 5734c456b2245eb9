"""Studies whose checks are tested, and what a user reads of one that is refused."""

from copy import deepcopy

import pytest

from branchcrush.config.checks import checked_study
from branchcrush.errors import ConfigError

SIZES = {"basis": "number", "size": "radius", "unit": "mm"}
UNIFORM = {"form": "uniform", **SIZES, "min": 0.5, "max": 1.0}
SIEVE = {"form": "sieve", "basis": "mass", "size": "diameter", "unit": "mm", "file": "sand.csv"}
SAMPLE = {
    "grading": UNIFORM,
    "sampling": "random",
    "grains": 1000,
    "allow_unrepresentative": False,
    "boundary": "walls",
    "initial_solid_fraction": 0.16,
    "contact": {"law": "linear", "normal_stiffness": 1e6},
    "loading": {"edge_reduction": 0.4, "states": 5, "quality": "draft", "unloading": True},
    "seeds": [1, 2],
    "refined_seeds": 1,
}
NORMAL = {"form": "normal", **SIZES, "min": 0.5, "max": 1, "mean": 0.7, "standard_deviation": 0.1}
OTHER = {
    **SAMPLE,
    "grading": {
        "form": "mixture",
        "basis": "mass",
        "components": [{"weight": 1, "grading": NORMAL}, {"weight": 2, "grading": UNIFORM}],
    },
    "contact": {"law": "hertz", "young_modulus": 7e10, "poisson_ratio": 0.2},
    "loading": {"mean_stress": {"from": 1e5, "to": 1e6, "states": 3}},
}
# Of the sample above.
BREAKAGE = {
    "strength": 2e7,
    "weibull_modulus": 2.0,
    "unit": "mm",
    "reference_diameter": 1.0,
    "smallest_diameter": 0.3,
}
STUDY = {
    "samples": {"one": {**SAMPLE, "breakage": BREAKAGE}, "other": OTHER},
    "energy_split": {"bins": 20, "confidence": 0.95, "resamples": 2000},
    "thermodynamics": {"ultimate_alpha": 2.6, "critical_energy": 2e5, "hardening_exponent": 2.0},
    "figures": {"dpi": 300},
}
INTERNALS = ["pydantic", "http", "[key]", "type=", "<class", "function-", "Input should", "np."]
INTERNALS += ["None", "True", "False", "Error", "Section", "validator"]


def lines_of(raw):
    with pytest.raises(ConfigError) as refused:
        checked_study(raw)
    lines = str(refused.value).splitlines()
    for line in lines:
        assert line.startswith("config: ")
        assert not [word for word in INTERNALS if word in line], line
    return lines


def study_of(**keys):
    return {"samples": {"mine": {**deepcopy(SAMPLE), **keys}}}
