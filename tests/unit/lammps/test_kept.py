"""A file that was kept is read as it was written, or is known to be damaged."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from branchcrush.lammps.kept import Damaged, read_kept, write_kept

IN_ONE_FOLDER = settings(
    max_examples=30, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


@IN_ONE_FOLDER
@given(
    plain=st.dictionaries(st.text(max_size=5), st.floats(allow_nan=False) | st.text(max_size=5)),
    column=arrays(float, st.integers(0, 5)),
)
def test_it_is_read_as_it_was_written(tmp_path, plain, column):
    write_kept(tmp_path / "a.kept", plain, {"column": column})
    values, columns = read_kept(tmp_path / "a.kept")
    assert values == plain
    assert columns["column"].tobytes() == column.tobytes()
    assert [path.name for path in tmp_path.iterdir()] == ["a.kept"]


@IN_ONE_FOLDER
@given(data=st.data())
def test_whatever_happens_to_a_file_is_noticed(tmp_path, data):
    path = tmp_path / "state.kept"
    write_kept(path, {"targets": 3}, {"number": np.arange(4)})
    content = bytearray(path.read_bytes())
    place = data.draw(st.integers(0, len(content) - 1))
    if data.draw(st.booleans(), label="cut off"):
        del content[place:]
    else:
        content[place] ^= 1 << data.draw(st.integers(0, 7))
    path.write_bytes(content)
    with pytest.raises(Damaged, match=r"^state\.kept$"):
        read_kept(path)


def test_a_file_that_is_missing_is_damaged(tmp_path):
    with pytest.raises(Damaged):
        read_kept(tmp_path / "nothing")
