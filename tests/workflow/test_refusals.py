"""What a user sees when a study cannot be run: one clear message, and nothing half-written."""

import pytest


@pytest.mark.parametrize(
    ("old", "new", "shown"),
    [
        ("grains: 60", "grains: -1", ["samples.tiny.grains", "-1", "greater than or equal to 2"]),
        ("boundary: walls", "boundary: wals", ["samples.tiny.boundary", "wals", "periodic"]),
        ("steps: 24", "stpes: 24", ["samples.tiny.loading.stpes", "did you mean steps?"]),
        ("radius_min: 5.0e-5", "radius_min: 2.0e-3", ["radius_min", "must be below radius_max"]),
        ("seeds: [3, 5]", "seeds: [3, 3]", ["samples.tiny.seeds", "given once"]),
    ],
)
def test_a_wrong_key_is_named_before_any_job_starts(project, old, new, shown):
    assert old in project.tiny
    project.configure(project.tiny.replace(old, new))
    run = project.snakemake()
    text = run.stdout + run.stderr
    assert run.returncode != 0
    for part in shown:
        assert part in text
    assert "Traceback" not in text
    assert not (project.folder / "results").exists()


def test_all_wrong_keys_are_named_at_once(project):
    project.configure(project.tiny.replace("grains: 60", "grains: -1").replace("walls", "wals"))
    run = project.snakemake()
    text = run.stdout + run.stderr
    assert "samples.tiny.grains" in text
    assert "samples.tiny.boundary" in text


def test_a_packing_that_carries_no_load_is_no_data(project):
    # Edges reduced by 30 % give a solid fraction of 0.47: too loose to touch for good.
    loose = project.tiny.replace("approach_solid_fraction: 0.45", "approach_solid_fraction: 0.3")
    loose = loose.replace("steps: 24, states: 12", "steps: 4, states: 2, edge_reduction: 0.3")
    project.configure(loose.replace("seeds: [3, 5]", "seeds: 1"))
    run = project.snakemake()
    text = run.stdout + run.stderr
    assert run.returncode != 0
    assert "1 of 1 packings carry no load at the end of the path, solid fraction 0.4665" in text
    assert "Traceback" not in text
    assert not (project.folder / "results/tiny/energy_split.json").exists()


def test_a_packing_too_dense_to_place_says_the_fraction_reached(project):
    project.configure(
        project.tiny.replace("radius_min: 5.0e-5", "radius_min: 9.9e-4").replace(
            "boundary: walls", "boundary: walls\n    initial_solid_fraction: 0.4"
        )
    )
    run = project.snakemake()
    text = run.stdout + run.stderr
    assert run.returncode != 0
    assert "no free place for grain" in text
    assert "at a solid fraction of 0." in text
    assert "Traceback" not in text
