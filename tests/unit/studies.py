"""Scripts of a study, imported as they import each other: by plain names, which studies share."""

import sys
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import pytest

REPOSITORY = Path(__file__).parents[2]


def scripts_of(study: str) -> SimpleNamespace:
    """Return the modules of all scripts of a study, by name."""
    folder = REPOSITORY / "studies" / study
    names = [file.stem for file in folder.glob("*.py")]
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(folder)
        for name in names:
            patch.delitem(sys.modules, name, raising=False)
        modules = {name: import_module(name) for name in names}
        for name in names:
            del sys.modules[name]
    return SimpleNamespace(**modules)
