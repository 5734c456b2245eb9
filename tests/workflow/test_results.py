"""What `branchcrush.open_study` makes of a real run: all of it is read, drawn and exported."""

import shutil
import warnings

import numpy as np
import pandas as pd
import pytest
from matplotlib import pyplot as plt

import branchcrush
from branchcrush.errors import ResultsError
from branchcrush.files.digests import file_digest
from branchcrush.files.made import read_record, record_bytes
from branchcrush.files.tables import read_packing
from branchcrush.plotting.results import PANELS

# What OVITO is told of the columns of pairs.dump.gz, as docs/own_analysis.md tells it.
BONDS = ["Particle Identifiers.1", "Particle Identifiers.2", "Length", "Branch.1", "Branch.2"]
BONDS += ["Branch.3", "Force", "Force vector.1", "Force vector.2", "Force vector.3"]


@pytest.fixture(scope="module")
def opened(finished):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield branchcrush.open_study(finished.folder)


@pytest.fixture(scope="module")
def tiny(opened):
    return opened["tiny"]


def places(study):
    for sample in study:
        yield from (study, sample, *sample.seeds.values())


def test_a_finished_study_lacks_nothing_and_names_its_samples(opened):
    assert opened.missing() == []
    assert list(opened.samples) == ["tiny"]
    assert list(opened["tiny"].seeds) == [3, 5]
    assert list(opened["tiny"].refined.seeds) == [3]
    assert "missing" not in repr(opened)
    assert opened["tiny"].settings["grains"] == 60


def test_every_result_is_read_with_units_and_says_what_made_it(opened):
    read = 0
    for place in places(opened):
        for result in place.results.values():
            if not result.exists:
                assert result.of_some_samples
                continue
            read += 1
            assert result.provenance["branchcrush"] == branchcrush.__version__
            assert result.title in repr(result)
            if ".json" in result.paths:
                assert result.summary
            if {".csv", ".parquet"} & set(result.paths) and not result.reason:
                assert set(result.data.attrs["units"]) == set(result.data.columns)
    assert read > 30


def test_the_numbers_are_those_of_the_files(tiny, sample):
    path = pd.read_csv(sample / "seed_3" / "path.csv", comment="#")
    end = tiny.seed(3).end
    assert end.number == path["state"].iloc[-1]
    assert end.numbers["solid_fraction"] == path["solid_fraction"].iloc[-1]
    contacts = pd.read_parquet(sample / "seed_3" / "contacts.parquet")
    pd.testing.assert_frame_equal(
        end.contacts, contacts[contacts["state"] == end.number].reset_index(drop=True)
    )
    _, radii, _ = read_packing(sample / "seed_3" / "packing.npz")
    assert end.grains["radius_m"].tolist() == radii.tolist()
    # The mean stress of the grains, weighed by volume, is that of the packing.
    volumes = 4.0 / 3.0 * np.pi * end.grains["radius_m"] ** 3
    mean = (end.grains["mean_stress_Pa"] * volumes).sum() / abs(np.linalg.det(end.cell))
    assert mean == pytest.approx(end.numbers["mean_stress_Pa"], rel=1e-9)


def test_branches_of_all_seeds_stand_in_one_table_with_their_seed(tiny):
    counts = tiny.branches["seed"].value_counts().to_dict()
    assert counts == {seed: len(one.end.contacts) for seed, one in tiny.seeds.items()}
    assert len(tiny.states) == sum(len(one.states) for one in tiny.seeds.values())


def test_every_panel_draws_its_result_and_every_other_says_where_it_is_shown(opened):
    drawn = set()
    for place in places(opened):
        for name, result in place.results.items():
            if result.missing:
                with pytest.raises(ResultsError, match=r"not there|no single panel"):
                    result.plot()
            elif name in PANELS:
                ax = result.plot()
                assert ax.has_data() or ax.texts, name
                drawn.add(name)
            else:
                with pytest.raises(ResultsError, match="no single panel shows"):
                    result.plot()
            plt.close("all")
    results = opened["tiny"].results
    of_some = {name for name in PANELS if name in results and results[name].of_some_samples}
    assert drawn == set(PANELS) - of_some
    assert opened["tiny"].seed(3).end.plot().images
    plt.close("all")


def test_ovito_opens_the_dumps(finished, tiny):
    io = pytest.importorskip("ovito.io", reason="no wheel of OVITO for this interpreter")
    from ovito.modifiers import LoadTrajectoryModifier

    kept = finished.folder / "results" / "tiny" / "seed_3"
    end = tiny.seed(3).end
    pipeline = io.import_file(str(kept / "particles.dump.gz"))
    pairs = LoadTrajectoryModifier()
    pairs.source.load(str(kept / "pairs.dump.gz"), columns=BONDS)
    pipeline.modifiers.append(pairs)
    data = pipeline.compute(end.number)
    order = np.argsort(data.particles["Particle Identifier"])
    assert np.allclose(data.particles["Radius"][order], end.grains["radius_m"], rtol=1e-5)
    centres = end.grains[["x_m", "y_m", "z_m"]]
    assert np.allclose(data.particles["Position"][order], centres, rtol=1e-5)
    assert np.allclose(data.cell[:, :3], end.cell.T, rtol=1e-6)
    # Contacts are bonds between the same grains, with the same forces.
    topology = np.sort(data.particles["Particle Identifier"][data.particles.bonds.topology], axis=1)
    found = pd.Series(
        data.particles.bonds["Force"], index=pd.MultiIndex.from_arrays(topology.T - 1)
    )
    expected = end.contacts.set_index(["i", "j"])["normal_force_N"]
    assert np.allclose(found.sort_index(), expected.sort_index(), rtol=1e-5)
    assert found.sort_index().index.equals(expected.sort_index().index)


def test_what_is_missing_or_of_another_version_is_told(finished, tmp_path):
    shutil.copytree(finished.folder / "results", tmp_path / "results")
    (tmp_path / "results" / "tiny" / "fabric.csv").unlink()
    jamming = tmp_path / "results" / "tiny" / "jamming.csv"
    jamming.write_text(jamming.read_text().replace(f'"{branchcrush.__version__}"', '"0.0.1"'))
    steps = tmp_path / "results" / "tiny" / "seed_3" / "steps.csv"
    steps.write_text(steps.read_text().replace("work_J", "labour_J"))
    # As those who made them would have left them.
    for path, record in (
        (jamming, "tiny/made/certificate.json"),
        (steps, "tiny/seed_3/made.json"),
    ):
        record = tmp_path / "results" / record
        content = read_record(record)
        del content["sha256"]
        content["outputs"][str(path.relative_to(tmp_path))] = file_digest(path)
        record.write_bytes(record_bytes(content))
    study = branchcrush.open_study(tmp_path)
    told = "tiny/fabric.csv is not there: rule sharing writes it"
    assert study.missing() == [told] == study["tiny"].missing()
    assert told in repr(study["tiny"]) and "missing: 1" in repr(study)
    with pytest.raises(ResultsError, match=r"fabric\.csv is not there: rule sharing writes it"):
        _ = study["tiny"].fabric.data
    with pytest.warns(UserWarning, match=r"is of branchcrush 0\.0\.1, and this is"):
        _ = study["tiny"].jamming.data
    with pytest.warns(UserWarning) as warned:
        _ = study["tiny"].seed(3).steps.data
    said = " ".join(str(one.message) for one in warned)
    assert "does not know: labour_J" in said and "lacks columns of this version: work_J" in said
