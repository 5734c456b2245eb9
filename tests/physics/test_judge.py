"""The judge of benchmarks tells from positions alone what the package tells from LAMMPS' forces."""

import numpy as np
import pytest

from benchmarks.judge import near_pairs, state_of
from branchcrush.packings.geometry import cube_edge


@pytest.mark.parametrize("boundary", ["walls", "periodic"])
def test_the_judge_agrees_with_the_path(
    random_grains, compressed, even_edges, frames, tmp_path, boundary
):
    packing = random_grains(150, 2, periodic=boundary == "periodic")
    radii = packing[1]
    first, last = (cube_edge(radii, fraction) for fraction in (0.5, 0.75))
    path = even_edges(first, last, steps=20, states=2)
    run = compressed(packing, tmp_path / "run", boundary=boundary, **path)
    frame = frames(run.folder / "particles.dump.gz")[-1]
    state = state_of(
        frame.vectors("x", "y", "z"),
        frame.columns["radius"],
        float(np.ptp(frame.bounds[0])),
        boundary == "periodic",
        run.variables["stiffness"],
    )
    row = run.path.iloc[-1]
    assert row["carries_load"]
    for name in (
        "solid_fraction",
        "mean_stress_Pa",
        "coordination_number",
        "mechanical_coordination_number",
        "rattler_fraction",
        "elastic_energy_J",
    ):
        np.testing.assert_allclose(state[name], row[name], rtol=1e-9)
    assert state["unbalanced_force_ratio"] <= 1e-6
    assert state["outside"] == 0


def test_pairs_are_those_of_a_search_of_all():
    rng = np.random.default_rng(1)
    radii, period = np.geomspace(0.01, 1.0, 300), 12.0
    place = rng.uniform(0.0, period, (300, 3))
    i, j = near_pairs(place, radii, period)
    gap = place[:, None] - place
    gap -= period * np.round(gap / period)
    touching = np.linalg.norm(gap, axis=2) < radii[:, None] + radii
    found = np.zeros_like(touching)
    found[np.minimum(i, j), np.maximum(i, j)] = True
    assert not (np.triu(touching, 1) & ~found).any()
    assert len(i) == found.sum()
