"""The file of the configuration: read, or refused with the line that is wrong."""

import pytest

from branchcrush.config.file import code_problem, config_file_problem

# Seven levels of ten references each.
LAUGHS = "a: &a [1]\n" + "".join(
    f"{name}: &{name} [{', '.join(10 * [f'*{below}'])}]\n"
    for below, name in zip("abcdefg", "bcdefgh", strict=True)
)
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
        "samples: {a: [0, -5, +1_000, 0.5, 1e5, -.inf, 08, __, _x_]}\n",
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
        ("samples: !!python/name:os.system 1\n", "line 1: !!python/name:os.system is a tag, and"),
        ("samples:\n  a: !!bool x\n", "line 2: !!bool is a tag, and only plain values are read"),
        ("samples: {a: !mine 1}\n", "line 1: !mine is a tag, and only plain values are read"),
        ("samples: ! 1\n", "line 1: ! is a tag, and only plain values are read: remove it"),
        ("samples: {a: !!timestamp x}\n", "line 1: !!timestamp is a tag, and only plain"),
        ("%TAG ! tag:yaml.org,2002:\n---\nsamples: !bool x\n", "line 3: !!bool is a tag, and"),
        ("samples: {a: 0170}\n", "line 1: 0170 is 120 to YAML: write it as a plain number"),
        ("samples: {a: 1:30}\n", "line 1: 1:30 is 90 to YAML: write it as a plain number"),
        ("samples: {a: 1:30.5}\n", "line 1: 1:30.5 is 90.5 to YAML: write it as a plain number"),
        ("samples: {a: -0x10}\n", "line 1: -0x10 is -16 to YAML: write it as a plain number"),
        ("__use_yte__: true\nsamples: {}\n", ": __use_yte__ is a key of a template that runs code"),
        ("samples: {a: [{__definitions__: [x]}]}\n", ": __definitions__ is a key of a template"),
        ("samples: {' __x__ ': 1}\n", ":  __x__  is a key of a template that runs code"),
        (
            "x: &x {__variables__: {}}\nsamples: {<<: *x}\n",
            ": __variables__ is a key of a template",
        ),
        (LAUGHS, " has more than a million entries by its *: write it without them"),
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


def test_a_file_beside_the_first_need_not_name_samples_and_runs_no_code_either(tmp_path):
    file = tmp_path / "more.yaml"
    file.write_text("figures: {dpi: 100}\n")
    assert config_file_problem(file, whole=False) is None
    file.write_text("- figures\n")
    problem = config_file_problem(file, whole=False)
    assert problem == f"config: {file} must hold keys and values"
    file.write_text("figures: {__definitions__: [print()]}\n")
    assert "runs code" in config_file_problem(file, whole=False)


def test_keys_that_stand_for_code_are_met_at_any_depth():
    assert code_problem({"__": 1, "a__b__": {"_x_": [1, "__value__"]}}) is None
    for content in ({"__use_yte__": 1}, [{"a": ({"__x__": 1},)}], {"a": {"b": {"__\n__": 0}}}):
        assert "runs code" in code_problem(content)
