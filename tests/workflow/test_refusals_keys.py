"""What a user reads who gives a key of config.yaml a wrong value, and that nothing is written."""

import pytest
import yaml

SHARE = "must be a number above 0 and below 1 (a share: 0.4 is 40 %)"
SEEDS = "must be a whole number from 1 to 1000, or a list of as many seeds"
SECTION = "must be a section with keys of its own"
GRAINS = "must be a whole number from 2 to 10000000"
STRESSES = "must be a stress in Pa, an increasing list of them, or a range "
STRESSES += "{from: 1e5, to: 1e7, states: 9}"
TARGETS = "edge_reduction, volume_reduction, solid_fraction, mean_stress"
HERTZ = "{law: hertz, young_modulus: 7.0e+10, poisson_ratio: %s}"


def with_key(text, path, typed):
    """Return a configuration but for one key, its value as a user would type it."""
    raw = yaml.safe_load(text)
    *sections, last = path.split("/")
    here = raw
    for section in sections:
        here = here.setdefault(section, {})
    here[last] = yaml.safe_load(typed)
    return yaml.safe_dump(raw, sort_keys=False)


@pytest.mark.parametrize(
    ("path", "typed", "expected"),
    [
        # Numbers: of the wrong sign, no number, or beside the range.
        ("grains", "-1", f" = -1: {GRAINS}"),
        ("grains", "0", f" = 0: {GRAINS}"),
        ("grains", "2.5", f" = 2.5: {GRAINS}"),
        ("grains", ".nan", f" = nan: {GRAINS}"),
        ("grains", "many", f" = 'many': {GRAINS}"),
        ("grains", "[60]", f" = [60]: {GRAINS}"),
        ("grains", "{number: 60}", f" = {{number: 60}}: {GRAINS}"),
        ("grains", "true", f" = true: {GRAINS}"),
        ("grains", "", f" = nothing: {GRAINS}"),
        ("initial_solid_fraction", "16", " = 16: must be a number above 0 and at most 0.4"),
        ("initial_solid_fraction", "-.inf", " = -inf: must be a number above 0 and at most 0.4"),
        ("refined_seeds", "-1", " = -1: must be a whole number from 0 to 1000"),
        ("ranks", "0", " = 0 processes: must be a whole number from 1 to 1024 processes"),
        # Words.
        ("boundary", "wals", " = 'wals': must be 'walls' or 'periodic'; did you mean 'walls'?"),
        (
            "sampling",
            "quantiles",
            " = 'quantiles': must be 'random', 'number_quantiles', 'mass_quantiles' or "
            "'listed'; did you mean 'mass_quantiles'?",
        ),
        ("allow_unrepresentative", "perhaps", " = 'perhaps': must be true or false"),
        # Seeds.
        ("seeds", "0", f" = 0: {SEEDS}"),
        ("seeds", "[]", f" = []: {SEEDS}"),
        ("seeds", "1000000000", f" = 1000000000: {SEEDS}"),
        ("seeds", "[3, 5, 3]", " = [3, 5, 3]: must have every seed once; more than once: 3"),
        ("seeds", "[3, -5]", ".1 = -5: must be a whole number from 0 to 4294967295"),
        # Contact.
        ("contact", "1.0e+6", f" = 1e+06: {SECTION}"),
        ("contact", "{normal_stiffness: 2}", ".law: missing; must be 'linear' or 'hertz'"),
        (
            "contact",
            "{law: linear, normal_stiffness: 0}",
            ".normal_stiffness = 0 N/m: must be a number from 1e-09 to 1e+15 N/m",
        ),
        (
            "contact",
            "{law: linear, young_modulus: 7}",
            ".young_modulus: unknown key; allowed: law, normal_stiffness",
        ),
        ("contact", "{law: lineer}", ".law = 'lineer': must be 'linear' or 'hertz'; did you mean"),
        (
            "contact",
            "{law: hertz, poisson_ratio: 0.2}",
            ".young_modulus: missing; must be a number from 0.001 to 1e+15 Pa",
        ),
        ("contact", HERTZ % 0.6, ".poisson_ratio = 0.6: must be a number from 0 to 0.5"),
        # Loading.
        ("loading", "", f" = nothing: {SECTION}"),
        ("loading", "{}", f": must have exactly one target of {TARGETS}; none is given"),
        (
            "loading",
            "{edge_reduction: 0.4, solid_fraction: 0.7}",
            f": must have exactly one target of {TARGETS}; edge_reduction and solid_fraction are",
        ),
        ("loading/edge_reduction", "40", f".edge_reduction = 40: {SHARE}"),
        ("loading/edge_reduction", ".inf", f".edge_reduction = inf: {SHARE}"),
        (
            "loading/edge_reduction",
            "0.1",
            ".edge_reduction = 0.1: leads from initial_solid_fraction 0.16 to 0.219, which must be "
            "above loading.approach_solid_fraction 0.45 and at most 1.2",
        ),
        (
            "loading",
            "{solid_fraction: 0.1}",
            ".solid_fraction = 0.1: must be above loading.approach_solid_fraction 0.55",
        ),
        (
            "loading",
            "{volume_reduction: 0.99}",
            ".volume_reduction = 0.99: leads from initial_solid_fraction 0.16 to 16, which must",
        ),
        (
            "loading/approach_solid_fraction",
            "0.1",
            ".approach_solid_fraction = 0.1: must be above initial_solid_fraction 0.16",
        ),
        ("loading/states", "0", ".states = 0: must be a whole number from 1 to 1000"),
        ("loading/stats", "5", ".stats: unknown key; did you mean states?"),
        ("loading/quality", "fin", ".quality = 'fin': must be 'draft', 'standard' or 'fine'; did"),
        ("loading/unloading", "1", ".unloading = 1: must be true or false"),
        (
            "loading",
            "{mean_stress: -5}",
            f".mean_stress = -5 Pa: {STRESSES}; each must be a number above 0 and at most 1e15",
        ),
        (
            "loading",
            "{mean_stress: [200, 100]}",
            f".mean_stress = [200, 100]: {STRESSES}; 100 does not rise above 200 before it",
        ),
        (
            "loading",
            "{mean_stress: {from: 9, to: 3, states: 4}}",
            f".mean_stress = {{from: 9, to: 3, states: 4}}: {STRESSES}; from 9 Pa must be below "
            "to 3 Pa",
        ),
        (
            "loading",
            "{mean_stress: {from: 3, to: 9}}",
            f".mean_stress = {{from: 3, to: 9}}: {STRESSES}; its keys are from, to",
        ),
        ("loading", "{mean_stress: 100, states: 4}", ".states = 4: belongs to a strain target"),
        (
            "loading",
            "{mean_stress: 1.0e+12}",
            ".mean_stress = 1e+12 Pa: would press grains of the median radius",
        ),
        # Unknown keys.
        ("grians", "60", ": unknown key; did you mean grains?"),
        ("viscosity", "1", ": unknown key; allowed: grading, sampling, grains"),
    ],
)
def test_a_wrong_key_of_a_sample(study, path, typed, expected):
    study.configure(with_key(study.tiny, f"samples/tiny/{path}", typed))
    (line,) = study.checked()
    assert line.startswith(f"config: samples.tiny.{path.split('/')[0]}{expected}")


@pytest.mark.parametrize(
    ("path", "typed", "expected"),
    [
        ("thermodynamics/ultimate_alpha", "3", " = 3: must be a number above 0 and below 3"),
        (
            "thermodynamics/critical_energy",
            "200 kJ",
            " = '200 kJ': must be a number above 0 and at most 1e+15 J/m3",
        ),
        ("thermodynamics/hardening", "2", ": unknown key; did you mean hardening_exponent?"),
        ("energy_split/confidence", "95", f" = 95: {SHARE}"),
        ("energy_split/bins", "2", " = 2: must be a whole number from 3 to 200"),
        (
            "figures/dpi",
            "5",
            " = 5 dots per inch: must be a whole number from 50 to 1200 dots per inch",
        ),
        ("plots", "{}", ": unknown key; allowed: samples, energy_split, thermodynamics, measured"),
        ("samples", "{}", " = {}: must hold at least one sample"),
        ("samples", "[tiny]", f" = ['tiny']: {SECTION}"),
        ("samples/empty", "", f" = nothing: {SECTION}"),
    ],
)
def test_a_wrong_key_of_another_section(study, path, typed, expected):
    study.configure(with_key(study.tiny, path, typed))
    (line,) = study.checked()
    assert line.startswith(f"config: {path.replace('/', '.')}{expected}")


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("two words", "= 'two words': a name must be 1 to 100 letters, digits, '.', '_' and '-'"),
        ("../up", "= '../up': a name must be 1 to 100 letters"),
        ("1", "= 1: a name must be text: put it in quotes"),
        ("dry-refined", "= 'dry-refined': a name must not end in -refined"),
        ("figures", "= 'figures': a name must not be figures"),
        ("l" * 101, "...: a name must be 1 to 100 letters"),
    ],
)
def test_a_name_that_can_be_no_folder(study, name, expected):
    study.configure(study.tiny.replace("  tiny:", f"  {name}:"))
    (line,) = study.checked()
    assert line.startswith(f"config: samples.{name} = ")
    assert expected in line


def test_a_missing_key_says_what_it_may_hold(study):
    study.configure(study.tiny.replace("    grains: 60\n", ""))
    assert study.checked() == [f"config: samples.tiny.grains: missing; {GRAINS}"]


@pytest.mark.parametrize(
    ("key", "wrong"),
    [("grains", "grains: many"), ("seeds", "seeds: 0"), ("boundary", "boundary: wall")],
)
def test_a_run_names_what_a_check_names(study, key, wrong):
    lines = [wrong if line.strip().startswith(key) else line for line in study.tiny.splitlines()]
    text = "\n".join(f"    {line}" if line == wrong else line for line in lines)
    study.configure(text.replace("form: uniform", "form: unifrom"))
    problems = study.checked()
    assert len(problems) == 2
    assert study.refused() == problems
