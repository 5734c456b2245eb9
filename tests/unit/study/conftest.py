"""Results of a sample by hand, in which every state and every quantity has numbers of its own."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from branchcrush.energy.estimators import ESTIMATORS
from branchcrush.energy.fit import EndState, EnergySplitFit
from branchcrush.energy.local_exponents import LocalExponent
from branchcrush.energy.state_fit import Curvature, FittedPredictor, StateFit
from branchcrush.statistics.intervals import Interval
from branchcrush.study.kinds import SampleKind
from branchcrush.study.results import SampleResults

NAN = float("nan")
DISTANCES = (0.0, 0.05, 0.1, 0.15)


def named(name, value, half=0.1):
    """Return an estimate with its limits by name."""
    return {name: value, f"{name}_low": value - half, f"{name}_high": value + 2 * half}


def interval(value, half=0.1):
    return Interval(value, value - half, value + 2 * half)


def predictor(name, explained, exponent=3.0, difference=0.0):
    return FittedPredictor(
        name,
        "formula",
        {"exponent": interval(exponent)},
        interval(explained, 0.01),
        interval(difference, 0.01),
        exponent=exponent if name == "branch_length" else None,
    )


def state_fit(shift=0.0, bend=0.5):
    """Fits in which every number of the state near jamming is less by `shift`."""
    return StateFit(
        (
            predictor("branch_length", 0.16 - shift, 3.1 - shift),
            predictor("reduced_radius", 0.19 - shift, 2.8 - shift, 0.03 - shift),
            predictor("both_radii", 0.185 - shift, 1.8, 0.025 - shift),
            predictor("grain_size", 0.12 - shift, 2.5, -0.04 - shift),
            replace(
                predictor("length_and_ratio", 0.188 - shift, difference=0.028 - shift),
                parameters={
                    "length_exponent": interval(2.6 - shift),
                    "ratio_exponent": interval(3.2 - shift),
                },
            ),
            predictor("surface", 0.20 - shift, 1.2, 0.04 - shift),
        ),
        Curvature(*(interval(bend - shift + k) for k in (0.0, 2.5, 3.0, 3.5))),
        local_exponents=tuple(
            LocalExponent(low, low + 0.3, 99, interval(n - shift), interval(q - shift))
            for low, n, q in ((0.8, 2.4, 3.0), (1.1, 3.8, 2.9), (1.4, 2.2, 2.9))
        ),
    )


def fit(n=(3.0, 2.9, 3.1), seeds=3):
    return EnergySplitFit(
        exponent=Interval(*n),
        confidence=0.95,
        amplitude=1.0,
        reference_length=1e-3,
        exponent_of_each_seed=(n[0],) * seeds,
        mean_of_seed_exponents=n[0],
        packings=EndState(
            seeds=seeds,
            branches=4321,
            solid_fraction=0.7407,
            jamming_solid_fraction=0.64,
            mean_stress=5.6e7,
            elastic_energy_density=1e6,
            median_overlap_over_length=0.02,
            coordination_number=6.5,
            mechanical_coordination_number=7.5,
            rattler_fraction=0.12,
        ),
        cubic_slope=1.0,
        cubic_r_squared=0.99,
        end=state_fit(),
        near_jamming=state_fit(shift=0.05),
        estimators={
            name: interval(value)
            for name, value in zip(ESTIMATORS, (3.12, 2.95, 2.74), strict=True)
        },
    )


def touching(distance, shift=0.0):
    """Contact numbers of a state: distances of the predictions, and all else shifted."""
    ks = {"parking": distance, "random_contact": 0.4 - shift, "configuration": 0.01 + shift}
    ks |= {"surface": 0.2 + shift, "rods": 0.07 + shift}
    return {
        "solid_fraction_above_jamming": 0.15 - shift,
        "mean_length_m": 1.5e-3 + shift,
        "coordination_number": 6.5 - shift,
        "rattler_fraction": 0.1 + shift,
        "rods_coordination_number": 6.2 - shift,
        "rods_rattler_fraction": 0.12 + shift,
        "predictions": [{"name": name, "kolmogorov_smirnov": value} for name, value in ks.items()],
        **named("assortativity_of_radii", -0.1 + shift),
    }


def models(solutions):
    """What models say at the jamming point, random parking in so many solutions."""
    parking = {"name": "parking", "coordination_number": 5.4, "rattler_fraction": 0.2}
    parking["solution"] = "only" if solutions == 1 else "coarse"
    if solutions == 2:
        parking |= {"other_coordination_number": 5.8, "other_rattler_fraction": 0.04}
    rods = {"name": "rods", "coordination_number": 5.6, "rattler_fraction": 0.15}
    return [parking, rods]


def shared(claim="no such grain", branch_claim="no such branch", shift=0.0):
    grains = {"largest_neighbour_ratio": 2.0, "neighbour_ratio_from": 1.6, "grains": 20}
    for k, reading in enumerate(("contact", "grain", "volume")):
        grains |= named(f"energy_per_{reading}", 0.7 + k + shift)
        grains[f"claim_per_{reading}"] = claim
    branches = {"claim": branch_claim, "radius_ratio_to": 0.2, "unequal_branches": 137}
    branches |= named("shielding_exponent", 0.9 + shift)
    branches |= named("unequal_over_equal", 0.14 + shift)
    tails = [
        {"threshold": above, **named("decay_rate", above), **named("squared_variation", above / 4)}
        for above in (1.0, 2.0)
    ]
    fabric = {
        kind: {"deviator_over_expected": one, "by_chance_low": one + 1, "by_chance_high": one + 2}
        for kind, one in (("branches", 0.4), ("forces", 0.6))
    }
    return {
        "shielding": {
            "grains": grains,
            "branches": branches,
            "grain_energy": {
                **named("exponent_all_grains", 4.6),
                **named("exponent_load_bearing", 2.6 + shift),
            },
        },
        "forces": {"tails": tails, "by_length": named("exponent", 1.7 + shift)},
        "fabric": fabric,
        "stress": {
            **named("coarse_half_stress_share", 0.48 + shift),
            **named("sharing_index", -0.02 + shift),
        },
    }


def path_of(exponents=(2.5, 2.8, 3.0, 3.2), half=0.1):
    exponents = np.asarray(exponents, dtype=float)
    return pd.DataFrame(
        {
            "solid_fraction_above_jamming": DISTANCES[-len(exponents) :],
            "exponent": exponents,
            "exponent_low": exponents - half,
            "exponent_high": exponents + half,
        }
    )


def states_of(prefactor=8.0):
    """kappa* of two seeds at two distances, above an isostatic number of 5.5 between walls."""
    above = np.array([0.02, 0.04])
    part = pd.DataFrame(
        {
            "state": [3, 4],
            "solid_fraction_above_jamming": above,
            "isostatic_number": 5.5,
            "mechanical_coordination_number": 5.5 + prefactor * np.sqrt(above),
        }
    )
    return pd.concat([part.assign(seed_number=number) for number in range(2)])


@pytest.fixture
def sample():
    """Return a function that makes the results of a sample."""

    def make(
        name="one",
        *,
        n=(3.0, 2.9, 3.1),
        parking=0.03,
        solutions=1,
        exponents=None,
        verdict="certified",
        **claims,
    ):
        reasons = ["seed 2: stopped"] if verdict == "not certified" else []
        return SampleResults(
            name=name,
            kind=SampleKind("walls", "hertz", {"form": "single"}),
            fit=fit(n),
            # The two states give different answers: 0.3 is bad.
            numbers={
                "near_jamming": touching(parking, 0.05),
                "end": touching(parking + 0.3),
                "models": models(solutions),
            },
            shared={"near_jamming": shared(shift=0.3), "end": shared(**claims)},
            certificate={"verdict": verdict, "reasons": reasons},
            path=path_of() if exponents is None else path_of(exponents),
            states=states_of(),
        )

    return make


@pytest.fixture
def one_state(sample):
    """Return a function that makes the results of a sample of which there is the end alone."""

    def make(name="alone", **options):
        whole = sample(name, exponents=(3.2,), **options)
        return replace(
            whole,
            fit=replace(whole.fit, near_jamming=None),
            numbers={name: whole.numbers[name] for name in ("end", "models")},
            shared={"end": whole.shared["end"]},
        )

    return make
