"""A configuration is data: whatever stands in it, nothing of it is run."""

import json

import pytest

SURE = ["--dry-run", "--lint", "preview", "results/tiny/jamming.csv"]
USE = "__use_yte__: true\n"


def definitions(made, indent=0):
    """Return a key that, as a template, makes a file."""
    code = json.dumps(f"import pathlib; pathlib.Path({str(made)!r}).touch()")
    return f"{' ' * indent}__definitions__: [{code}]\n"


def at_the_top(study, made):
    return USE + definitions(made) + study.tiny


def in_a_sample(study, made):
    return USE + study.tiny.replace("    grains:", definitions(made, 4) + "    grains:")


def in_a_merge(study, made):
    return f"figures: &code {{__use_yte__: true, {definitions(made).strip()}}}\n<<: *code\n" + (
        study.tiny.replace("figures: {dpi: 100}\n", "")
    )


def in_a_mixture(study, made):
    part = f"{{share: 0.5, grading: {{{definitions(made).strip()}}}}}"
    grading = f"{{form: mixture, basis: mass, parts: [{part}, {part}]}}"
    return USE + f"samples:\n  tiny:\n    grading: {grading}\n    grains: 60\n"


def in_an_expression(study, made):
    code = json.dumps(f"?__import__('pathlib').Path({str(made)!r}).touch()")
    return USE + study.tiny.replace("grains: 60", f"grains: {code}")


def in_a_tag(study, made):
    return study.tiny.replace("60", f"!!python/object/apply:os.system ['touch {made}']", 1)


@pytest.mark.parametrize("target", SURE)
def test_a_template_is_refused_before_it_is_run(study, target):
    made = study.folder / "made"
    study.configure(in_a_sample(study, made))
    (line,) = study.refused(target)
    assert line.startswith("config: config.yaml: __") and "runs code" in line
    assert not made.exists()


@pytest.mark.parametrize("written", [at_the_top, in_a_merge, in_a_mixture, in_an_expression])
def test_wherever_it_stands(study, written):
    made = study.folder / "made"
    study.configure(written(study, made))
    (line,) = study.refused("--dry-run")
    assert line.startswith("config: config.yaml: __") and "runs code" in line
    assert not made.exists()


def test_a_tag_makes_nothing(study):
    made = study.folder / "made"
    study.configure(in_a_tag(study, made))
    (line,) = study.refused("--dry-run")
    assert line.startswith("config: config.yaml, line 4: !!python/object/apply:os.system is a tag")
    assert not made.exists()


def test_what_the_command_line_gives_is_held_to_the_same(study):
    more = study.folder / "more.yaml"
    more.write_text("figures: {dpi: 0170}\n")
    (line,) = study.refused("--dry-run", "--configfile", str(more))
    assert line.startswith(f"config: {more}, line 1: 0170 is 120 to YAML: write it as a plain")
    # Without `__use_yte__` at the top, Snakemake has run nothing of it.
    more.write_text("figures: {__definitions__: []}\n")
    (line,) = study.refused("--dry-run", "--configfile", str(more))
    assert line.startswith(f"config: {more}: __definitions__ is a key of a template")
    (line,) = study.refused("--dry-run", "--config", "figures={__definitions__: []}")
    assert line.startswith("config: __definitions__ is a key of a template that runs code")
