"""States as files for ParaView, read back by VTK itself."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from vtkmodules import vtkIOXML as vtk_xml
from vtkmodules.util import numpy_support

from branchcrush.command.main import main
from branchcrush.files.tables import provenance, write_json
from branchcrush.files.vtk_xml import write_polydata
from tests.unit.results.conftest import leave_record, touching, write_results


def read(path):
    """Return points, lines, and the data of points and of cells, as VTK reads them."""
    reader = vtk_xml.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0
    data = reader.GetOutput()
    points = numpy_support.vtk_to_numpy(data.GetPoints().GetData())
    cells = data.GetLines() if data.GetNumberOfLines() else data.GetVerts()
    ends = numpy_support.vtk_to_numpy(cells.GetConnectivityArray())
    return points, ends, *(
        {of.GetArrayName(k): numpy_support.vtk_to_numpy(of.GetArray(k))
         for k in range(of.GetNumberOfArrays())}
        for of in (data.GetPointData(), data.GetCellData())
    )  # fmt: skip


NAMES = ("grains", "contacts", "wall_contacts", "force_chains", "cell")
finite = st.floats(-1e300, 1e300)


@given(
    points=st.integers(1, 6).flatmap(lambda n: arrays(float, (n, 3), elements=finite)),
    data=st.data(),
)
@settings(max_examples=40, deadline=None)
def test_vtk_reads_what_was_written(tmp_path_factory, points, data):
    count = len(points)
    lines = data.draw(st.lists(st.tuples(*2 * [st.integers(0, count - 1)]), max_size=5) | st.none())
    of_points = {
        'a <b> & "c"': data.draw(arrays(float, count, elements=finite)),
        "whole": data.draw(arrays(int, count)),
        "yes": data.draw(arrays(bool, count)),
        "vector_N": points[::-1],
    }
    of_lines = {"chain": np.arange(len(lines))} if lines is not None else {}
    path = tmp_path_factory.mktemp("vtk") / "some.vtp"
    write_polydata(path, points, lines, of_points, of_lines)
    found, ends, point_data, cell_data = read(path)
    assert found.tolist() == points.tolist()
    if lines is None or lines:
        assert ends.tolist() == list(np.ravel(lines if lines else range(count)))
    assert {name: one.tolist() for name, one in point_data.items()} == {
        name: one.tolist() for name, one in of_points.items()
    }
    assert {name: one.tolist() for name, one in cell_data.items()} == {
        name: one.tolist() for name, one in of_lines.items()
    }


def test_data_of_another_length_are_refused(tmp_path):
    with pytest.raises(ValueError, match="force must have 1 entries"):
        write_polydata(tmp_path / "a.vtp", np.zeros((2, 3)), [(0, 1)], None, {"force": [1, 2]})
    assert not list(tmp_path.iterdir())


def test_the_state_of_a_packing_is_exported_with_its_chain(row_of_three, tmp_path, capsys):
    assert main(["export", str(tmp_path), "--to", str(tmp_path / "out")]) == 0
    folder = tmp_path / "out" / "sand" / "seed_7"
    printed = [line for line in capsys.readouterr().out.splitlines()]
    assert printed == [str(folder / f"{name}_0002.vtp") for name in NAMES]
    points, _, grains, _ = read(folder / "grains_0002.vtp")
    assert points.tolist() == [[-1, 0, 0], [0, 0, 0], [1, 0, 0]]
    assert grains["diameter_m"].tolist() == [1.0, 1.0, 1.0]
    assert grains["contacts"].tolist() == [1, 2, 1]
    points, ends, _, contacts = read(folder / "contacts_0002.vtp")
    assert points[ends].tolist() == [[-1, 0, 0], [0, 0, 0], [0, 0, 0], [1, 0, 0]]
    assert contacts["normal_force_N"].tolist() == [3.0, 3.0]
    # Four of each grain with walls at +y, to where they are.
    points, ends, _, walls = read(folder / "wall_contacts_0002.vtp")
    lines = points[ends].reshape(-1, 2, 3)
    assert lines[:, 0].tolist() == [[x, 0, 0] for x in (-1, 0, 1) for _ in range(4)]
    assert (lines[:, 1] - lines[:, 0]).tolist() == [[0, 0.45, 0]] * 12
    assert walls["normal_force_N"].tolist() == [0.1] * 12
    assert walls["i"].tolist() == [0] * 4 + [1] * 4 + [2] * 4
    # Each grain's stress is above the mean of none: the middle one alone is highly stressed.
    points, ends, _, _ = read(folder / "force_chains_0002.vtp")
    assert not len(points) and not len(ends)
    points, _, _, _ = read(folder / "cell_0002.vtp")
    assert np.ptp(points, axis=0) == pytest.approx(3 * [3.75])


def test_the_cell_of_another_code_is_exported_as_it_was_read(row_of_three, tmp_path, capsys):
    tilted = [[4.0, 0.0, 0.0], [1.0, 2.0, 0.0], [0.0, 0.5, 3.0]]
    place = tmp_path / "results" / "sand" / "seed_7"
    origin = provenance(sample="sand", seed=7, config={"boundary": "walls"})
    reading = {"cells_m": [np.eye(3).tolist()] * 2 + [tilted], "periodic": [False] * 3}
    write_json(place / "reading.json", reading, origin)
    leave_record(tmp_path / "results", "sand/seed_7", sample="sand", seed="7")
    assert main(["export", str(tmp_path), "--to", str(tmp_path / "out")]) == 0
    points, ends, _, _ = read(tmp_path / "out" / "sand" / "seed_7" / "cell_0002.vtp")
    assert np.ptp(points, axis=0).tolist() == [5.0, 2.5, 3.0]
    edges = np.abs(np.diff(points[ends].reshape(-1, 2, 3), axis=1)[:, 0])
    found, times = np.unique(edges, axis=0, return_counts=True)
    assert (found.tolist(), times.tolist()) == (sorted(tilted), [4, 4, 4])
    # Of a version that did not tell it.
    write_json(place / "reading.json", {"periodic": [False] * 3}, origin)
    leave_record(tmp_path / "results", "sand/seed_7", sample="sand", seed="7")
    assert main(["export", str(tmp_path), "--to", str(tmp_path / "again")]) == 1
    assert "lacks cells_m, as results of another version may" in capsys.readouterr().err


def test_a_periodic_cell_has_an_empty_file_of_walls(tmp_path):
    positions, radii = np.array([[-0.4, 0.0, 0.0], [0.4, 0.0, 0.0]]), [0.5, 0.5]
    study = write_results(tmp_path, positions, radii, [touching(0, 1, positions, radii, 3.0)])
    written = study["sand"].seed(7).end.export_vtp(tmp_path / "out")
    assert [path.name for path in written] == [f"{name}_0002.vtp" for name in NAMES]
    points, ends, _, _ = read(tmp_path / "out" / "wall_contacts_0002.vtp")
    assert not len(points) and not len(ends)


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--state", "1"], "centres are kept of the loose packing"),
        (["--state", "9"], "no state 9"),
        (["--seed", "4"], "no seed 4; there are: 7"),
        (["--sample", "snad"], "did you mean sand"),
        (["--crushed"], "was not crushed"),
    ],
)
def test_what_cannot_be_exported_is_told_on_one_line(row_of_three, tmp_path, capsys, options, told):
    assert main(["export", str(tmp_path), "--to", str(tmp_path / "out"), *options]) == 1
    said = capsys.readouterr().err
    assert said.startswith("error: ") and told in said and said.count("\n") == 1
    assert not (tmp_path / "out").exists()


def test_all_states_whose_grains_are_kept_are_exported(row_of_three, tmp_path):
    assert main(["export", str(tmp_path), "--to", str(tmp_path / "out"), "--state", "all"]) == 0
    numbers = {path.stem[-4:] for path in (tmp_path / "out").rglob("*.vtp")}
    assert numbers == {"0000", "0002"}
