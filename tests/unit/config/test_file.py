"""The file of the configuration: read, or refused with the line that is wrong."""

import pytest

from branchcrush.config.file import config_file_problem

VALID = "# a comment\nsamples:\n  mine: {grains: 60}\n"


def problem_of(tmp_path, content):
    file = tmp_path / "config.yaml"
    file.write_bytes(content if isinstance(content, bytes) else content.encode())
    problem = config_file_problem(file)
    return problem and problem.removeprefix(f"config: {file}").removeprefix(", ")


@pytest.mark.parametrize(
    "content",
    [
        VALID,
        VALID.replace("\n", "\r\n"),
        "\ufeff" + VALID,
        VALID + "\n\n# the end",
        "samples: &one {a: {grains: 2}}\nfigures: *one\n",
        "x: &x {a: 1}\ny: &y {b: 1}\nsamples: {<<: *x, <<: *y, c: 1}\n",
        "samples: {a: {k: 1}, b: {k: 2}}\n",
    ],
)
def test_a_file_of_keys_and_values_is_no_problem(tmp_path, content):
    assert problem_of(tmp_path, content) is None


@pytest.mark.parametrize(
    ("content", "start"),
    [
        ("samples:\n\ta: 1\n", "line 2: a tab, where YAML wants blanks"),
        ("samples: {a: [1, 2}\n", "line 1: expected ',' or ']', but got '}'"),
        ("samples: {a: 1\n", "line 2: expected ',' or '}'"),
        ("samples: 'a\n", "line 2: found unexpected end of stream"),
        ("samples: {a: 1}\nsamples: {}\n", "line 2: samples is given twice in one section, first"),
        ("samples:\n  a:\n    k: 1\n    k: 2\n", "line 4: k is given twice in one section, first"),
        ("samples: {? [1]: 2}\n", "line 1: found unhashable key"),
        ("samples: *none\n", "line 1: found undefined alias"),
        ("samples: !!python/name:os.system 1\n", "line 1: could not determine a constructor"),
        ("samples: 1\n---\nsamples: 2\n", "line 2: but found another document"),
        ("samples: \x00\n", " is no YAML: unacceptable character #x0000"),
        ("samples: 2020-13-45\n", " is no usable YAML: month must be in 1..12"),
        ("samples: " + 3000 * "[" + 3000 * "]", " is no usable YAML: maximum recursion depth"),
        ("samples: &a {b: *a}\n", " has a section that contains itself"),
        ("samples: &a [1, [*a]]\n", " has a section that contains itself"),
        ("größe: 1\n".encode("cp1252"), " is no text in UTF-8: save it as such"),
        ("", " must hold keys and values, and among them samples"),
        ("samples\n", " must hold keys and values, and among them samples"),
        ("[samples]\n", " must hold keys and values, and among them samples"),
        ("sample: {}\n", " must hold keys and values, and among them samples"),
    ],
)
def test_another_file_is_a_problem_of_one_line(tmp_path, content, start):
    problem = problem_of(tmp_path, content)
    assert problem.startswith(start)
    assert "\n" not in problem


def test_no_file_and_a_folder_are_named(tmp_path):
    assert "there is no file" in config_file_problem(tmp_path / "config.yaml")
    assert "is a folder" in config_file_problem(tmp_path)
