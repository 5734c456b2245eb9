"""Write the part of docs/results.md that comes from the dictionary of result files.

    python docs/results_page.py

What stands above the mark in the page is written by hand and kept.
"""

from pathlib import Path

from branchcrush.files.dictionary import result_files, stages

PAGE = Path(__file__).with_name("results.md")
MARK = "<!-- From here on made by docs/results_page.py; edit src/branchcrush/files/meanings. -->\n"


def cell(text):
    """Return a text as a cell of a Markdown table."""
    return text.replace("|", "\\|").replace("*", "\\*")


def names(paths):
    """Return paths in a row, as code."""
    return ", ".join(f"`{path}`" for path in paths)


def shown_by(file):
    """Return the tables that a figure shows."""
    name = file.path.removeprefix("figures/").removesuffix(".png")
    return [table.path for table in result_files() if name in table.figures]


def file_lines(file):
    """Return the section of a file: what it holds, which rule makes it, figures, and columns."""
    lines = [f"### `{file.path}`", "", file.holds]
    told = [f"Rule `{file.rule}`"]
    if file.figures:
        told.append(f"figures {names(f'{name}.png' for name in file.figures)}")
    if tables := shown_by(file):
        told.append(f"shows {names(tables)}")
    lines += ["", f"{'; '.join(told)}."]
    if file.partial:
        lines += [f"Not every run has all of it: {file.partial}."]
    if file.lines:
        lines += ["", "| name | type | unit | meaning |", "| --- | --- | --- | --- |"]
        lines += [
            f"| `{name}` | {kind} | {cell(unit)} | {cell(meaning)} |"
            for name, kind, unit, meaning in file.lines
        ]
    return [*lines, ""]


def figure_rows(stage):
    """Return the section of the figures, a row each."""
    lines = ["| figure | shows | from | rule |", "| --- | --- | --- | --- |"]
    return [
        *lines,
        *(
            f"| `{file.path}` | {file.holds} | {names(shown_by(file))} | `{file.rule}` |"
            for file in stage.files
        ),
        "",
    ]


def made():
    """Return what the dictionary tells, as Markdown."""
    lines = []
    for stage in stages():
        lines += [f"## {stage.title}", "", stage.text, ""]
        if all(file.path.endswith(".png") for file in stage.files):
            lines += figure_rows(stage)
        else:
            lines += [line for file in stage.files for line in file_lines(file)]
    return "\n".join(lines)


def page(written):
    """Return the page: what is above the mark in it, and what the dictionary tells."""
    return f"{written.partition(MARK)[0]}{MARK}\n{made()}"


if __name__ == "__main__":
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
