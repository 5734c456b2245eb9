"""What a user reads whose grading, or the file it comes from, is not usable."""

import pytest

FORMS = "'uniform', 'loguniform', 'normal', 'lognormal', 'weibull', 'fractal', 'fuller', 'single', "
FORMS += "'sieve', 'density', 'histogram', 'radii' or 'mixture'"
PLACE = "samples.tiny.grading"


def with_grading(text, grading):
    before, after = text.split("    grading: ")
    return f"{before}    grading: {grading}\n{after.partition(chr(10))[2]}"


def numbers(rest):
    return f"{{basis: number, size: radius, unit: mm, {rest}}}"


def masses(rest):
    return f"{{basis: mass, size: diameter, unit: mm, {rest}}}"


@pytest.mark.parametrize(
    ("grading", "expected"),
    [
        ("uniform", [" = 'uniform': must be a section with keys of its own"]),
        ("", [" = nothing: must be a section with keys of its own"]),
        (numbers("min: 1, max: 2"), [f".form: missing; must be {FORMS}"]),
        (
            numbers("form: unifrom, min: 1, max: 2"),
            [f".form = 'unifrom': must be {FORMS}; did you mean 'uniform'?"],
        ),
        (
            "{form: uniform, basis: number, min: 1, max: 2}",
            [
                ".size: missing; must be 'radius' or 'diameter'",
                ".unit: missing; must be 'm', 'cm', 'mm', 'um' or 'inch'",
            ],
        ),
        (
            "{form: uniform, basis: volume, size: width, unit: km, min: 1, max: 2}",
            [
                ".size = 'width': must be 'radius' or 'diameter'",
                ".unit = 'km': must be 'm', 'cm', 'mm', 'um' or 'inch'",
                ".basis = 'volume': must be 'number' or 'mass'",
            ],
        ),
        (numbers("form: uniform, min: 3, max: 2"), [".max = 2 mm: must be above min 3 mm"]),
        (numbers("form: loguniform, min: 2, max: 2"), [".max = 2 mm: must be above min 2 mm"]),
        (numbers("form: uniform, min: 0, max: 2"), [".min = 0 mm: must be a number above 0 mm"]),
        (numbers("form: uniform, min: 1, max: .nan"), [".max = nan: must be a number above 0 mm"]),
        (
            numbers("form: uniform, min: '0,5', max: 2"),
            [".min = '0,5': must be a number above 0 mm, with a decimal point"],
        ),
        (
            numbers("form: uniform, min: 1, max: 2.0e+7"),
            [
                ".max = 2e+07 mm: must be from 1e-09 m to 1000 m, and is 2e+04 m: check it and "
                "the unit"
            ],
        ),
        (
            numbers("form: uniform, radius_min: 1, max: 2"),
            [
                ".min: missing; must be a number above 0",
                ".radius_min: unknown key; allowed: size, unit, min, max, form, basis",
            ],
        ),
        (
            numbers("form: normal, min: 1, max: 2, mean: 9, standard_deviation: 0.1"),
            [
                ".standard_deviation = 0.1 mm: with mean 9 mm only 0 of the distribution lies "
                "between min 1 mm and max 2 mm; at least 1e-06 must: move them or check the unit"
            ],
        ),
        (
            numbers("form: normal, min: 1, max: 2, mean: 1.5, standard_deviation: -1"),
            [".standard_deviation = -1 mm: must be a number above 0 mm"],
        ),
        (
            numbers("form: lognormal, min: 1, max: 2, median: 1, geometric_standard_deviation: 1"),
            [".geometric_standard_deviation = 1: must be a number above 1 and at most 1000"],
        ),
        (
            numbers("form: weibull, min: 1, max: 2, scale: 1, shape: 0"),
            [".shape = 0: must be a number above 0 and at most 1000"],
        ),
        (
            numbers("form: fractal, min: 1, max: 2, alhpa: 2.6"),
            [
                ".alpha: missing; must be a number above 0 and at most 6",
                ".alhpa: unknown key; did you mean alpha?",
            ],
        ),
        (
            masses("form: fractal, min: 1, max: 2, alpha: 2.6"),
            [".basis = 'mass': must be 'number'"],
        ),
        (
            masses("form: fuller, min: 1, max: 2, exponent: [0.5]"),
            [".exponent = [0.5]: must be a number above 0 and at most 6"],
        ),
        (
            "{form: single, size: radius, unit: mm, value: -1}",
            [".value = -1 mm: must be a number above 0 mm"],
        ),
        (
            "{form: single, size: radius, unit: mm, basis: mass, value: 1}",
            [".basis: unknown key; allowed: size, unit, form, value"],
        ),
        (
            "{form: mixture, basis: mass, components: []}",
            [".components = []: must be a list of 2 or more, each with a weight and a grading"],
        ),
        (
            "{form: mixture, basis: mass, components: [{weight: 0, grading: {form: single, size: "
            "radius, unit: mm, value: 1}}, {weight: 1, grading: {form: radii, basis: number, "
            "size: radius, unit: mm, file: no.csv}}]}",
            [
                ".components.0.weight = 0: must be a number from 1e-15 to 1e+15",
                ".components.1.grading.file = 'no.csv': there is no such file in ",
            ],
        ),
        (masses("form: sieve, file: no.csv"), [".file = 'no.csv': there is no such file in "]),
        (masses("form: sieve"), [".file: missing; must be the name of a file"]),
        (masses("form: sieve, file: ''"), [".file = '': must not be empty"]),
        (masses("form: sieve, file: 5"), [".file = 5: must be text"]),
        (
            masses("form: sieve, file: ."),
            [".file = '.': is a folder; give the name of a file in it"],
        ),
        (masses("form: sieve, file: /dev/null"), [".file = '/dev/null': is no regular file"]),
    ],
)
def test_a_grading_of_wrong_keys(study, grading, expected):
    study.configure(with_grading(study.tiny, grading))
    lines = study.checked()
    assert len(lines) == len(expected), lines
    for line, start in zip(lines, expected, strict=True):
        assert line.startswith(f"config: {PLACE}{start}")


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ("1,0\n2,60\n4,40\n8,100\n", ["line 3: percent finer = 40 at opening 4 is less than 60"]),
        ("1,0\n2,60\n8,110\n", ["line 3: percent finer = 110; must lie between 0 and 100"]),
        ("1,0\n2,0.6\n8,1\n", ["line 3: percent finer ends at 1, so these are fractions"]),
        ("1,5\n2,60\n8,100\n", ["line 1: percent finer = 5 at the smallest opening 1; how small"]),
        ("1,0\n2,60\n8,90\n", ["line 3: percent finer = 90 at the largest opening 8; how large"]),
        ("0,0\n2,60\n8,100\n", ["line 2: percent finer = 60 at the smallest opening 2; how small"]),
        ("1,0\n2,60\n2,70\n8,100\n", ["line 3: opening 2 has percent finer = 70 here and 60 on"]),
        ("1,0\n2,nan\n8,100\n", ["line 2: percent finer = 'nan' is no finite number"]),
        ("1,0\n2,60,7\n8,1o0\n", ["line 2: 3 columns, 2 | 60 | 7; must", "line 3: percent finer"]),
        ("8,100\n", ["line 1: one row of numbers; must be two or more"]),
        ("opening,percent\n", ["line 1: no row of numbers; must be two or more"]),
        ("", ["is empty; write one row of numbers on each line"]),
        (b"PK\x03\x04\x00\x00", ["is no text in UTF-8 and no workbook (.xlsx); save"]),
    ],
)
def test_a_sieve_table_that_is_wrong_is_answered_with_its_lines(study, content, expected):
    table = study.folder / "sand.csv"
    table.write_bytes(content if isinstance(content, bytes) else content.encode())
    study.configure(with_grading(study.tiny, masses("form: sieve, file: sand.csv")))
    lines = study.checked()
    assert len(lines) == len(expected), lines
    for line, words in zip(lines, expected, strict=True):
        assert line.startswith(f"config: {PLACE}.file: sand.csv")
        assert words in line


@pytest.mark.parametrize(
    ("form", "content", "words"),
    [
        ("density", "1,0\n2,0\n", "lines 1 to 2: every density = 0; one must be above 0"),
        ("density", "1,2\n2,-3\n", "line 2: density = -3; must not be negative"),
        ("radii", "1\n-2\n", "line 2: size = -2; must be above 0"),
    ],
)
def test_another_file_that_is_wrong(study, form, content, words):
    (study.folder / "sand.csv").write_text(content)
    study.configure(with_grading(study.tiny, numbers(f"form: {form}, file: sand.csv")))
    (line,) = study.checked()
    assert line.startswith(f"config: {PLACE}.file: sand.csv, {words}")


def test_a_grading_that_its_grains_cannot_stand_for(study):
    study.configure(study.tiny.replace("    allow_unrepresentative: true\n", ""))
    (line,) = study.checked()
    assert line.startswith("config: samples.tiny.grains = 60: 60 grains put ")
    assert "too few for this grading" in line
    assert line.endswith("or set allow_unrepresentative: true, which the report will repeat")


@pytest.mark.parametrize(
    "content",
    [
        "# weighed twice\n\nopening_mm,percent finer\n1,0\n2,60\n2,60\n8,100\n",
        "\ufeffÖffnung;Durchgang\r\n8,0;100\r\n2;60,0\r\n\r\n1;0\r\n",
    ],
)
def test_a_table_in_a_dialect_of_its_own_is_taken(study, content):
    (study.folder / "sand.csv").write_bytes(content.encode())
    study.configure(with_grading(study.tiny, masses("form: sieve, file: sand.csv")))
    # Snakemake's own screen names every file.
    run = study.snakemake("--dry-run", "--workflow-profile", "none")
    assert run.returncode == 0, run.stdout + run.stderr
    assert "sand.csv" in run.stdout + run.stderr
