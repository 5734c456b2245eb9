"""Which source files a module of this package is made of, for the workflow to watch."""

import ast
from pathlib import Path

_PACKAGE = Path(__file__).parent


def imported_modules(module):
    """Return the modules of this package that one of its modules imports directly.

    Parameters
    ----------
    module : str
        Dotted name below the package, as "simulation" or "plotting.energy".

    Returns
    -------
    set of str

    Examples
    --------
    >>> sorted(imported_modules("packing"))
    ['errors']
    """
    found = set()
    for node in ast.walk(ast.parse(_file(module).read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("branchcrush"):
            base = node.module.removeprefix("branchcrush").lstrip(".")
            names = [f"{base}.{alias.name}".lstrip(".") for alias in node.names]
            # `from branchcrush import tables` names a module, `from branchcrush.errors import X`
            # a name inside one.
            found |= {name for name in names if _file(name)} or {base}
    return {name for name in found if name and _file(name)}


def module_files(*modules):
    """Return the source files of modules and of everything in this package they import.

    Parameters
    ----------
    *modules : str

    Returns
    -------
    list of str
        Sorted.

    Examples
    --------
    >>> [Path(file).name for file in module_files("packing")]
    ['errors.py', 'packing.py']
    """
    pending, seen = list(modules), set()
    while pending:
        module = pending.pop()
        if module not in seen:
            seen.add(module)
            pending += imported_modules(module)
    return sorted(str(_file(module)) for module in seen)


def _file(module):
    path = _PACKAGE.joinpath(*module.split("."))
    for candidate in (path.with_suffix(".py"), path / "__init__.py"):
        if candidate.is_file() and module:
            return candidate
    return None
