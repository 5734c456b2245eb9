"""Grains that find no room, at the beginning or at the end, are refused before any job."""

import numpy as np
import pytest

from branchcrush.config.checks import checked_study
from branchcrush.config.sample import sample_of
from branchcrush.config.schema import checked_config
from branchcrush.errors import ConfigError, PackingError
from branchcrush.lammps.compression import placed_packing
from tests.unit.config.studies import UNIFORM, lines_of, study_of

SINGLE = {"form": "single", "size": "radius", "unit": "mm", "value": 1.0}
DENSE = {"solid_fraction": 0.7}


def placed(raw, seed):
    """Place the grains as a job does."""
    sample = sample_of(checked_config(raw).samples["mine"].settings())
    return placed_packing(sample, np.random.default_rng(seed))


@pytest.mark.parametrize("boundary", ["walls", "periodic"])
@pytest.mark.parametrize("fraction", [0.3, 0.36, 0.39])
def test_what_a_job_could_not_place_is_refused_and_nothing_else(
    tmp_path, monkeypatch, boundary, fraction
):
    monkeypatch.chdir(tmp_path)
    raw = study_of(grading=SINGLE, grains=200, initial_solid_fraction=fraction, boundary=boundary,
                   loading=DENSE, seeds=[4, 9], allow_unrepresentative=True)  # fmt: skip
    found = []
    for seed in (4, 9):
        try:
            placed(raw, seed)
        except PackingError as error:
            found.append(f"seed {seed} finds no room, {error}")
    if not found:
        checked_study(raw)
        return
    (line,) = lines_of(raw)
    assert line == f"config: samples.mine.initial_solid_fraction = {fraction:g}: {found[0]}"


def test_both_happen_above(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    raw = study_of(grading=SINGLE, grains=200, loading=DENSE, allow_unrepresentative=True)
    checked_study(raw)
    raw["samples"]["mine"]["initial_solid_fraction"] = 0.4
    assert "finds no room, no free place for grain" in lines_of(raw)[0]


def test_two_grains_between_walls_have_no_place_beside_each_other(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    # L = (2 * 0.524/0.4)^(1/3) D = 1.38 D: two centres are at most 0.65 D apart.
    few = {"grading": SINGLE, "grains": 2, "loading": DENSE, "allow_unrepresentative": True}
    (line,) = lines_of(study_of(**few, initial_solid_fraction=0.4))
    assert "seed 1 finds no room" in line
    checked_study(study_of(**few, initial_solid_fraction=0.16))


def test_the_largest_grain_of_any_seed_has_to_fit_into_the_last_cell(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    # One grain in fifty has 20 times the radius of the others: not all seeds draw one of them.
    parts = [
        {"weight": 49, "grading": {**SINGLE, "value": 0.05}},
        {"weight": 1, "grading": SINGLE},
    ]
    grading = {"form": "mixture", "basis": "number", "components": parts}
    raw = study_of(grading=grading, grains=10, loading={"solid_fraction": 0.9}, seeds=40,
                   refined_seeds=0, allow_unrepresentative=True)  # fmt: skip
    sizes = [placed_radii(raw, seed).max() for seed in range(1, 41)]
    first = 1 + int(np.argmax(np.array(sizes) > 0.5e-3))
    assert first > 1
    (line,) = lines_of(raw)
    assert line.startswith(f"config: samples.mine.grains = 10: with seed {first} the cell would")
    assert line.endswith("use more grains or load less")


def placed_radii(raw, seed):
    from branchcrush.gradings.sampling import sampled_radii

    sample = sample_of(checked_config(raw).samples["mine"].settings())
    rng = np.random.default_rng(seed)
    return sampled_radii(sample.grading, sample.grains, sample.sampling, rng)


def test_many_grains_stand_for_more(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    dense = {"grains": 3_000_000, "initial_solid_fraction": 0.4, "loading": DENSE}
    (line,) = lines_of(study_of(grading=SINGLE, **dense))
    assert "finds no room" in line
    checked_study(study_of(grading=UNIFORM, **{**dense, "initial_solid_fraction": 0.3}))


def test_a_preview_is_made_all_the_same(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    raw = study_of(grading=SINGLE, grains=200, initial_solid_fraction=0.4, loading=DENSE,
                   allow_unrepresentative=True)  # fmt: skip
    with pytest.raises(ConfigError):
        checked_study(raw)
    assert checked_study(raw, few_grains=True).samples["mine"].grains == 200
