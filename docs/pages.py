"""Gather what the site is made from: the pages of the repository, and a page for each room.

    python docs/pages.py build/docs-source

The folder gets the tree of the repository, so a link between two pages means the same in both.
Pages of rooms come from the package: what is public there is on the site without being listed here.
"""

import ast
import re
import sys
import tomllib
from pathlib import Path

REPOSITORY = Path(__file__).parents[1]
PACKAGE = REPOSITORY / "src" / "branchcrush"

# What has pages, or what a page links to; a study that was run has results and logs as well.
GATHERED = (
    "README.md",
    "CHANGELOG.md",
    "CITATION.cff",
    "CODE_OF_CONDUCT.md",
    "CONTRIBUTING.md",
    "LICENSE",
    "SECURITY.md",
    "config.schema.json",
    "config.yaml",
    "config/README.md",
    "benchmarks/*.py",
    "benchmarks/peers/*.md",
    "benchmarks/results/*",
    "docs/**/*",
    "examples/*/*",
    "examples/*/figures/*",
    "lammps_inputs/*",
    "profiles/default/config.yaml",
    "studies/*/config.yaml",
)
FOR_SPHINX = (
    "docs/conf.py",
    "docs/licences.py",
    "docs/pages.py",
    "docs/results_page.py",
    "docs/tutorial.py",
    "docs/_static",
)
# Folders without a README that pages link to: the title of the page that lists what is in them.
LISTED = {
    "benchmarks/results": "Results of the benchmarks",
    "docs/decisions": "Decisions",
    "examples": "Examples",
}
LINK = re.compile(r"\]\(([^)#:]+)\)")


def gathered():
    """Return each file of the repository that the site is made from, as a path in it."""
    files = {file for pattern in GATHERED for file in REPOSITORY.glob(pattern) if file.is_file()}
    names = {file.relative_to(REPOSITORY).as_posix() for file in files}
    return sorted(name for name in names if not name.startswith(FOR_SPHINX))


def page(name):
    """Return a page of the repository whose links to folders lead to the page of the folder."""

    def with_page(link):
        folder = (REPOSITORY / name).parent / link[1]
        if not folder.is_dir():
            return link[0]
        return f"]({link[1]}/{'README' if (folder / 'README.md').exists() else 'index'}.md)"

    return LINK.sub(with_page, (REPOSITORY / name).read_text(encoding="utf-8"))


def listing(title, folder, names):
    """Return a page that lists the pages below a folder, or else its files."""
    inside = [name.removeprefix(f"{folder}/") for name in names if name.startswith(f"{folder}/")]
    pages = [name for name in inside if name.endswith(".md")]
    if pages:
        return "\n".join([f"# {title}", "", "```{toctree}", ":maxdepth: 1", "", *pages, "```", ""])
    return "\n".join([f"# {title}", "", *(f"- [{name}]({name})" for name in inside), ""])


def public_modules(folder):
    """Return the modules directly in a folder of the package whose names are public, by name."""
    return sorted(file.stem for file in folder.glob("*.py") if not file.stem.startswith("_"))


def rooms():
    """Return the folder of each room of the package: each of its subpackages, by name."""
    return sorted(file.parent for file in PACKAGE.glob("[!_]*/__init__.py"))


def parsed(file):
    """Return the syntax tree of a module."""
    return ast.parse(file.read_text(encoding="utf-8"))


def public_names(file):
    """Return the names of the public functions and classes of a module, in its order."""
    named = [node for node in parsed(file).body if isinstance(node, ast.FunctionDef | ast.ClassDef)]
    return [node.name for node in named if not node.name.startswith("_")]


def titled(title, underline):
    return [title, underline * len(title), ""]


def api_page(title, package, folder, prefix=""):
    """Return the page of a room: its docstring, then its modules with all that is public."""
    lines = [*titled(title, "="), f".. automodule:: {package}", ""]
    for module in public_modules(folder):
        path = f"{package}.{module}"
        names = public_names(folder / f"{module}.py")
        lines += [*titled(prefix + module, "-"), ".. rst-class:: members", ""]
        lines += [*(f"* :py:obj:`{name} <{path}.{name}>`" for name in names), ""]
        lines += [f".. automodule:: {path}", "   :members:", "   :ignore-module-all:", ""]
    return "\n".join(lines)


def first_sentence(file):
    """Return the first line of a module's docstring, as a room says in one line what it is."""
    return (ast.get_docstring(parsed(file)) or "").partition("\n")[0]


def link_to(name):
    """Return a link to the page of a room, or to where modules without a room are."""
    is_room = (PACKAGE / name / "__init__.py").exists()
    return f":doc:`{name}`" if is_room else f":doc:`{name} <branchcrush>`"


def floors():
    """Return the rooms of each floor, the highest first, as the contract of imports has them."""
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))
    contracts = project["tool"]["importlinter"]["contracts"]
    layers = next(contract["layers"] for contract in contracts if contract["type"] == "layers")
    return [re.split(r" [|:] ", layer) for layer in layers]


def api_index():
    """Return the page of all rooms: the floors they are on, and the first sentence of each."""
    lines = [*titled("Rooms of the package", "="), "A room imports only rooms on floors below it."]
    lines += ["", ".. rst-class:: floors", ""]
    lines += [f"* {' '.join(link_to(name) for name in floor)}" for floor in floors()]
    lines += ["", *titled("What each is", "-")]
    for room in rooms():
        lines += [f":doc:`{room.name}`", f"   {first_sentence(room / '__init__.py')}", ""]
    lines += [":doc:`branchcrush`", f"   {first_sentence(PACKAGE / '__init__.py')}", ""]
    lines += [".. toctree::", "   :hidden:", "", *(f"   {room.name}" for room in rooms())]
    return "\n".join([*lines, "   branchcrush", ""])


def site():
    """Return the content of every file of the site's source, by path."""
    names = gathered()
    made = {name: (REPOSITORY / name).read_bytes() for name in names if not name.endswith(".md")}
    texts = {name: page(name) for name in names if name.endswith(".md")}
    texts["index.md"] = texts.pop("docs/index.md")
    texts |= {f"{folder}/index.md": listing(LISTED[folder], folder, names) for folder in LISTED}
    texts["api/index.rst"] = api_index()
    texts["api/branchcrush.rst"] = api_page("branchcrush", PACKAGE.name, PACKAGE)
    for room in rooms():
        package = f"{PACKAGE.name}.{room.name}"
        texts[f"api/{room.name}.rst"] = api_page(room.name, package, room, f"{room.name}.")
        if f"](api/{room.name}.rst)" not in texts["index.md"]:
            sys.exit(f"error: docs/index.md shows no stage that {room.name} has a part in")
    return made | {name: text.encode() for name, text in texts.items()}


def write(folder):
    """Make a folder hold the site's source and nothing else; what stays the same is left alone."""
    wanted = {folder / name: content for name, content in site().items()}
    for file in [file for file in folder.rglob("*") if file.is_file() and file not in wanted]:
        file.unlink()
    for file, content in wanted.items():
        if not (file.exists() and file.read_bytes() == content):
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content)


if __name__ == "__main__":
    write(Path(sys.argv[1]))
