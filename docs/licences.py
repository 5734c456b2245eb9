"""List the licences of what a run installs in docs/licences.md, as the packages state them.

    python docs/licences.py

in the environment of `make run`, after each `make lock`. A test holds names and versions against
the lock.
"""

import re
from importlib import metadata
from pathlib import Path

REPOSITORY = Path(__file__).parents[1]
PAGE = REPOSITORY / "docs" / "licences.md"
TABLE = re.compile(r"(?<=<!-- made by docs/licences.py -->\n).*?(?=<!-- end -->)", re.DOTALL)
PINNED = re.compile(r"([a-z0-9.-]+)==(\S+)(?: ; (.+?))? \\$", re.MULTILINE)
LONGEST = 50


def stated_licence(name):
    """Return the licence that the metadata of an installed package states, in few words."""
    fields = metadata.metadata(name)
    classifiers = [
        classifier.rpartition(" :: ")[2]
        for classifier in fields.get_all("Classifier", [])
        if classifier.startswith("License :: ")
    ]
    text = fields.get("License", "").strip()
    if fields.get("License-Expression"):
        return fields["License-Expression"]
    if text and "\n" not in text and len(text) <= LONGEST:
        return text
    return " or ".join(classifiers) or text_of_licence(name)


def text_of_licence(name):
    """Return the title of the licence that a package brings as a file."""
    for file in metadata.files(name) or []:
        if re.match("licen[cs]e|copying", file.name, re.IGNORECASE):
            title = file.read_text().strip().partition("\n")[0].strip()
            return title if len(title) <= LONGEST else f"see its {file.name}"
    return "not stated"


def table(lock):
    """Return a row for each package of a lock: name, version, licence."""
    rows = ["| package | version | licence as stated |", "| --- | --- | --- |"]
    for name, version, marker in PINNED.findall(lock):
        try:
            licence = stated_licence(name)
        except metadata.PackageNotFoundError:
            licence = f"only where `{marker}`"
        rows.append(f"| {name} | {version} | {licence} |")
    return "\n".join(rows) + "\n"


if __name__ == "__main__":
    made = table((REPOSITORY / "requirements.lock").read_text(encoding="utf-8"))
    page = PAGE.read_text(encoding="utf-8")
    PAGE.write_text(TABLE.sub(lambda _: made, page), encoding="utf-8")
