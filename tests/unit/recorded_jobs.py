"""A study of two jobs with their records, done without Snakemake."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from branchcrush.records import out_of_date, recorded_job

RECORD = "results/sand/made/fit.json"
PATH, MADE = "results/sand/seed_1/path.csv", "results/sand/seed_1/made.json"


class Named(list):
    """Files or values, by name and by number: what Snakemake gives to scripts and has in jobs."""

    def __init__(self, **values):
        super().__init__(values.values())
        self.__dict__.update(values)

    def keys(self):
        return self.__dict__.keys()

    def items(self):
        return self.__dict__.items()


def fit(*, code="c0de", inputs=("sieve.csv", PATH), dumps="all", **config):
    """Return a job of a rule fit, as it would be done now."""
    config = {"grains": 60, "contact": {"law": "linear", "stiffness": 1e6}} | config
    return SimpleNamespace(
        rule=SimpleNamespace(name="fit"),
        wildcards=Named(sample="sand"),
        params=Named(code=code, sample=config, bins=20, inputs="/a/clone", keep_dumps=dumps),
        input=Named(**{f"input{n}": path for n, path in enumerate(inputs)}),
        output=Named(table="results/sand/fit.csv", result="results/sand/fit.json", record=RECORD),
    )


def walk(seed=1, **config):
    """Return the job that makes what the fit reads."""
    folder = f"results/sand/seed_{seed}"
    return SimpleNamespace(
        rule=SimpleNamespace(name="walk"),
        wildcards=Named(sample="sand", seed=str(seed)),
        params=Named(code="c0de", sample={"grains": 60} | config),
        input=Named(data="sieve.csv"),
        output=Named(path=f"{folder}/path.csv", record=f"{folder}/made.json"),
    )


def as_script(made):
    return SimpleNamespace(**{**vars(made), "rule": made.rule.name, "log": ["logs/fit.log"]})


def step(made, text="abd"):
    """Do the job that makes what the fit reads."""
    with recorded_job(as_script(made)):
        Path(made.output.path).parent.mkdir(parents=True, exist_ok=True)
        Path(made.output.path).write_text(text)


def do(made):
    """Do a job, as its script does."""
    with recorded_job(as_script(made)) as beside:
        for path in made.output[:2]:
            Path(path).parent.mkdir(parents=True, exist_ok=True)
            Path(path).write_text("abc")
        Path("results/sand/particles.dump.gz").write_text("abd")
        beside.append("results/sand/particles.dump.gz")


def reasons(made):
    return [case.reason for case in out_of_date([made])]


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    """A study whose one job is done."""
    monkeypatch.chdir(tmp_path)
    Path("sieve.csv").write_text("abc")
    step(walk())
    do(fit())
    return tmp_path
