"""The console command as a user types it: what it prints, and its exit codes."""

import shlex
import subprocess
import sys

import pytest

from branchcrush.command.main import main

SIEVES = "opening [mm],percent passing\n2,100\n1,60\n0.5,20\n0.25,0\n"
HISTOGRAM = "--form histogram --basis mass --size diameter --sizes edges --scale linear"
STUDY = """\
samples:
  mine:
    grading: {form: uniform, basis: number, size: diameter, unit: mm, min: 0.5, max: 1.0}
    grains: GRAINS
    loading: {edge_reduction: 0.4, approach_solid_fraction: 0.45, states: 4, quality: draft}
    seeds: 2
figures: {dpi: 50}
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "soil.csv").write_text(SIEVES)
    return tmp_path


MEASURED = """\
measured:
  sand:
    before: {form: single, size: diameter, unit: mm, value: 1}
    after: {form: single, size: diameter, unit: mm, value: 0.5}
    ultimate_smallest: {size: diameter, unit: mm, value: 0}
"""
WILL_BE = "sand, measured: breakage from its sieve curves -> results/measured.html\n"


def study(folder, grains, more=""):
    (folder / "config.yaml").write_text(STUDY.replace("GRAINS", str(grains)) + more)


def printed(capsys, *arguments):
    """Return the exit code of a command and what it wrote, to both streams."""
    try:
        code = main(arguments)
    except SystemExit as ended:
        code = ended.code
    return code, *capsys.readouterr()


# --- grading -------------------------------------------------------------------------------------


def test_a_table_is_told_with_its_sizes_and_the_lines_to_paste(folder, capsys):
    code, out, err = printed(capsys, "grading", "soil.csv", "--unit", "mm")
    assert (code, err) == (0, "")
    assert "read as: values: percent finer by mass" in out
    # Even in the logarithm, the monotone cubic meets its points: D60 is 1 mm.
    assert "D60 1, " in out and "mm by mass" in out
    pasted = out.split("to paste below a sample:\n")[1]
    for line in ("grading:", "  form: sieve", "  unit: mm", "  size: diameter", "  file: soil.csv"):
        assert f"    {line}\n" in pasted


def test_lines_to_paste_name_the_file_as_the_study_beside_it_does(folder, capsys):
    (folder / "my sand").mkdir()
    (folder / "soil.csv").rename(folder / "my sand" / "soil.csv")
    for place in ("my sand/soil.csv", str(folder / "my sand" / "soil.csv")):
        _, out, _ = printed(capsys, "grading", place, "--unit", "mm")
        pasted = out.split("to paste below a sample:\n")[1]
        assert "      file: soil.csv\n" in pasted and "my sand" not in pasted
        assert "file: relative to the folder that the study runs in" in pasted


def test_a_curve_through_sizes_needs_no_file(folder, capsys):
    keys = "--form lognormal --basis mass --size diameter --unit um --d10 82 --d50 200 --d90 486"
    code, out, _ = printed(capsys, "grading", *keys.split(), "--min", "10", "--max", "4000")
    assert code == 0
    assert "lognormal, median 199.8 um, geometric standard deviation 2" in out
    assert "D50 199.8" in out


def test_a_picture_is_drawn_where_it_is_asked_for(folder, capsys):
    assert printed(capsys, "grading", "soil.csv", "--unit", "mm")[0] == 0
    assert not list(folder.rglob("*.png"))
    code, out, _ = printed(capsys, "grading", "soil.csv", "--unit", "mm", "--picture", "a.png")
    assert code == 0 and "picture: a.png" in out
    assert (folder / "a.png").stat().st_size > 1000


@pytest.mark.parametrize("name", ["a.pdf", "a.foo", "a"])
def test_a_picture_that_is_no_png_is_a_usage_error(folder, capsys, name):
    code, out, err = printed(capsys, "grading", "soil.csv", "--unit", "mm", "--picture", name)
    assert code == 2 and out == ""
    assert err.splitlines()[-1].endswith(f"argument --picture: {name!r} must end in .png")
    assert not (folder / name).exists()


def test_the_sketch_rises_from_the_finest_to_the_coarsest_grain(folder, capsys):
    _, out, _ = printed(capsys, "grading", "soil.csv", "--unit", "mm")
    rows = [line for line in out.splitlines() if "|" in line]
    assert [row.split("|")[0].strip() for row in rows] == [str(k) for k in range(100, -1, -10)]
    first = [len(row) - len(row.split("|")[1].lstrip()) for row in rows]
    assert first == sorted(first, reverse=True)
    assert "0.25" in out and "2 mm" in out


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ("wordless.csv", "grading.unit: missing"),
        ("two_units.csv", "grading.unit: missing"),
        ("soil.csv --unit um --form histogram", "grading.sizes: missing"),
        ("--form lognormal --basis mass --size diameter --unit um --d50 200", "two or three of"),
    ],
)
def test_what_is_wrong_or_missing_is_a_line_and_no_traceback(folder, capsys, keys, words):
    (folder / "wordless.csv").write_text("2,100\n1,60\n0.5,0\n")
    (folder / "two_units.csv").write_text("cm (mm),passing\n2,100\n1,60\n0.5,0\n")
    code, out, err = printed(capsys, "grading", *keys.split())
    assert code == 1 and out == ""
    assert words in err
    assert all(line.startswith("error: ") for line in err.splitlines())


@pytest.mark.parametrize(
    ("content", "form", "unit", "median"),
    [
        ("Siebweite [mm];Durchgang [%]\n2,0;100\n1,0;50\n0,5;0\n", "", "mm", "D50 1,"),
        ("µm,finer\n500,50\n63,0\n2000,100\n", "", "um", "D50 500,"),
        # Of 1, 8 and 27 mm3 the median of the mass is in the largest.
        ("D [mm]\n1\n2\n3\n", "--form radii --size diameter", "mm", "D50 3,"),
        ("mm;mass %\n1;50\n2;50\n4;\n", HISTOGRAM, "mm", "D50 2,"),
    ],
)
def test_the_unit_that_a_header_gives_is_taken_told_and_among_the_lines_to_paste(
    folder, capsys, content, form, unit, median
):
    (folder / "de.csv").write_text(content, encoding="utf-8")
    code, out, err = printed(capsys, "grading", "de.csv", *form.split())
    assert (code, err) == (0, "")
    assert f"read as: unit: {unit}, by the header\n" in out and median in out
    assert f"      unit: {unit}\n" in out.split("to paste below a sample:\n")[1]
    # What is typed is not the header's.
    _, out, _ = printed(capsys, "grading", "de.csv", *form.split(), "--unit", unit)
    assert "by the header" not in out


def test_words_of_phi_are_answered_before_a_unit_is_asked_for(folder, capsys):
    (folder / "beach.csv").write_text("phi,cum. coarser\n1,0\n2,50\n4,100\n")
    code, _, err = printed(capsys, "grading", "beach.csv")
    assert code == 1 and "missing" not in err
    command = "branchcrush grading beach.csv --values percent_coarser --openings phi"
    assert f"`{command}` D50 = 0.25 mm" in err
    # What is advised is all that is asked for.
    code, out, _ = printed(capsys, *command.split()[1:])
    assert code == 0 and "D50 0.25," in out


def test_a_typed_unit_is_no_default(folder, capsys):
    (folder / "beach.csv").write_text("phi,finer\n4,0\n2,50\n1,100\n")
    _, _, err = printed(capsys, "grading", "beach.csv", "--unit", "um")
    assert "Read as by default (values: percent_finer, openings: size), in um," in err


def test_nothing_is_to_be_looked_at_where_the_words_agree(folder, capsys):
    for content, asked in ((SIEVES, []), ("2,100\n1,60\n0.5,0\n", ["openings", "values"])):
        (folder / "soil.csv").write_text(content)
        _, out, _ = printed(capsys, "grading", "soil.csv", "--unit", "mm")
        looked = [line.split()[3] for line in out.splitlines() if line.startswith("worth a look")]
        assert looked == asked


def test_a_refusal_names_the_command_that_reads_the_table(folder, capsys):
    # A twentieth is in the pan: percent retained of five rows sum to 100.
    (folder / "my sand.csv").write_text("4,0\n2,10\n1,50\n0.5,35\npan,5\n")
    code, _, err = printed(capsys, "grading", "my sand.csv", "--unit", "mm")
    command = "branchcrush grading 'my sand.csv' --unit mm --values percent_retained"
    command += " --openings size --min SMALLEST"
    assert code == 1 and f"`{command}` D50 = " in err and "Paste" not in err
    assert "is meant, with the size of the smallest grain in mm for SMALLEST" in err
    code, _, err = printed(capsys, *shlex.split(command.replace("SMALLEST", "0.1"))[1:])
    assert (code, err) == (0, "")


def test_a_refusal_of_channels_names_commands_without_keys_of_the_other_form(folder, capsys):
    keys = "--form density --size diameter --basis volume --per size"
    (folder / "laser.csv").write_text("lower um;dQ3/dlog\n1;10\n2;40\n4;40\n8;10\n")
    _, _, err = printed(capsys, "grading", "laser.csv", *keys.split())
    commands = [words for words in err.split("`") if words.startswith("branchcrush ")]
    assert "Type the command that is meant, or correct" in err and len(commands) > 2
    assert all("--per" not in words for words in commands if "histogram" in words)


def test_an_unknown_word_is_a_usage_error(folder, capsys):
    code, _, err = printed(capsys, "grading", "soil.csv", "--unit", "furlong")
    assert code == 2
    assert "invalid choice: 'furlong'" in err


@pytest.mark.parametrize("place", ["nowhere.csv", "nowhere/soil.csv"])
def test_no_such_table_is_another_exit_code(folder, capsys, place):
    code, out, err = printed(capsys, "grading", place, "--unit", "mm")
    assert code == 2 and out == ""
    assert err.startswith(f"error: {place}: there is no such file in") and err.count("\n") == 1


# --- check ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("place", [[], ["."], ["config.yaml"]])
def test_a_sound_study_is_said_to_be(folder, capsys, place):
    study(folder, 500)
    code, out, err = printed(capsys, "check", *place)
    assert (code, err) == (0, "")
    assert out.startswith("mine: uniform, 500 grains, 2 packings\nsound: branchcrush preview tells")
    assert "--directory" not in out


def test_what_is_made_of_a_measured_material_is_said(folder, capsys):
    study(folder, 500, MEASURED)
    _, out, _ = printed(capsys, "check")
    assert f"500 grains, 2 packings\n{WILL_BE}sound: " in out


def test_the_commands_of_a_sound_study_name_its_folder(folder, capsys, monkeypatch):
    study(folder, 500)
    monkeypatch.chdir(folder.parent)
    _, out, _ = printed(capsys, "check", folder.name)
    assert f"sound: branchcrush preview {folder.name} tells" in out
    assert f"snakemake --cores 2 --directory {folder.name} runs it" in out


def test_all_problems_are_named_at_once(folder, capsys):
    (folder / "config.yaml").write_text(
        STUDY.replace("GRAINS", "20").replace("seeds: 2", "seeds: 0").replace("dpi", "dpj")
    )
    code, out, err = printed(capsys, "check")
    assert code == 1 and out == ""
    lines = err.splitlines()
    assert len(lines) == 3 and all(line.startswith("config: ") for line in lines)


def test_a_file_that_is_no_yaml_is_a_line(folder, capsys):
    (folder / "config.yaml").write_text("samples: [")
    code, _, err = printed(capsys, "check", str(folder))
    assert code == 1
    assert len(err.splitlines()) == 1 and err.startswith("config: config.yaml, line ")


@pytest.mark.parametrize("command", ["check", "preview"])
def test_no_such_folder_is_another_exit_code(folder, capsys, command):
    code, _, err = printed(capsys, command, "nowhere")
    assert code == 2
    assert err.startswith("error: there is no file nowhere") and len(err.splitlines()) == 1


def test_files_are_relative_to_the_folder_of_the_study(folder, capsys, monkeypatch):
    study(folder, 5000)
    text = (folder / "config.yaml").read_text()
    begin, end = text.index("{form: uniform"), text.index("\n    grains")
    sieve = "{form: sieve, basis: mass, size: diameter, unit: mm, file: soil.csv}"
    (folder / "config.yaml").write_text(text[:begin] + sieve + text[end:])
    (folder / "elsewhere").mkdir()
    monkeypatch.chdir(folder / "elsewhere")
    assert printed(capsys, "check", "..")[0] == 0


def test_a_configuration_has_to_say_its_unit_whatever_the_header_says(folder, capsys):
    sieve = "{form: sieve, basis: mass, size: diameter, file: soil.csv}"
    (folder / "config.yaml").write_text(
        f"samples: {{mine: {{grading: {sieve}, grains: 500, seeds: 2, "
        "loading: {edge_reduction: 0.4, quality: draft}}}\n"
    )
    code, _, err = printed(capsys, "check")
    assert code == 1 and "samples.mine.grading.unit: missing" in err


# --- preview -------------------------------------------------------------------------------------


def test_a_preview_is_printed_and_written_for_grains_that_a_run_refuses(folder, capsys):
    study(folder, 60, MEASURED)
    assert printed(capsys, "check")[0] == 1
    code, out, err = printed(capsys, "preview", "--cores", "1")
    assert (code, err) == (0, "")
    assert out == (folder / "results/preview.txt").read_text(encoding="utf-8")
    assert out.startswith("mine: 60 grains, 2 packings")
    assert out.endswith(WILL_BE)
    assert "the run refuses this unless allow_unrepresentative" in " ".join(out.split())
    assert (folder / "results/figures/mine/preview.png").stat().st_size > 1000


def test_a_preview_of_a_mistake_names_it_once(folder, capsys):
    study(folder, 1)
    code, out, err = printed(capsys, "preview")
    assert code == 1 and out == ""
    assert err.startswith("config: samples.mine.grains = 1: must be") and err.count("\n") == 1
    assert not (folder / "results").exists()


# --- the command line ----------------------------------------------------------------------------


@pytest.mark.parametrize("command", [[], ["grading"], ["preview"], ["check"]])
def test_help_is_there_and_names_the_exit_codes(capsys, command):
    code, out, _ = printed(capsys, *command, "--help")
    assert code == 0
    assert "exit code: 0 sound" in " ".join(out.split())


def test_help_imports_nothing_that_takes_long():
    asked = "import sys; from branchcrush.command.main import parser; parser().format_help(); "
    told = (
        "print(sorted({'numpy', 'pydantic', 'scipy', 'matplotlib', 'pandas'} & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", asked + told], capture_output=True, text=True)
    assert run.stdout.strip() == "[]", run.stderr
