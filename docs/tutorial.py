"""Write the files that docs/tutorial.md tells its reader to save, for a run of just what it says.

python docs/tutorial.py build/tutorial
"""

import re
import sys
from pathlib import Path

PAGE = Path(__file__).with_name("tutorial.md")
STUDY = "my_sand"
# "Save as `my_sand/NAME`:" and the block below it.
SAVED = re.compile(rf"`{STUDY}/([\w.]+)`:\n\n```\w+\n(.*?)```", re.DOTALL)


def files(page):
    """Return the content of each file of the tutorial's study, by name."""
    return dict(SAVED.findall(page))


def write(folder):
    """Write these files into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in files(PAGE.read_text(encoding="utf-8")).items():
        (folder / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    write(Path(sys.argv[1]))
