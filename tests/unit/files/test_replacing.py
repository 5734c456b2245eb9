"""A file is whole or as it was before, whatever ends the writing."""

import pytest

from branchcrush.files.replacing import replacing


def files_in(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


def test_nothing_but_the_file_itself_is_left(tmp_path):
    for content in (b"first", b"second"):
        with replacing(tmp_path / "deep" / "folder" / "page") as file:
            file.write(content)
    assert files_in(tmp_path) == ["deep/folder/page"]
    assert (tmp_path / "deep" / "folder" / "page").read_bytes() == b"second"


def test_file_is_not_there_before_all_of_it_is_written(tmp_path):
    with replacing(tmp_path / "page") as file:
        file.write(b"half")
        file.flush()
        assert not (tmp_path / "page").exists()
        file.write(b" and half")
    assert (tmp_path / "page").read_bytes() == b"half and half"


def test_who_reads_the_old_file_reads_it_to_its_end(tmp_path):
    (tmp_path / "page").write_bytes(b"the old content")
    with (tmp_path / "page").open("rb") as reader:
        with replacing(str(tmp_path / "page")) as file:
            file.write(b"new")
        # Only a new opening finds the new file.
        assert reader.read() == b"the old content"
    assert (tmp_path / "page").read_bytes() == b"new"


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt])
def test_error_leaves_the_old_file_alone(tmp_path, error):
    (tmp_path / "page").write_bytes(b"the old content")
    with pytest.raises(error), replacing(tmp_path / "page") as file:
        file.write(b"half")
        raise error
    assert files_in(tmp_path) == ["page"]
    assert (tmp_path / "page").read_bytes() == b"the old content"
