"""Names of samples and of measured materials: they name folders of results."""

import re
from typing import Annotated, Any

from pydantic import BeforeValidator

from branchcrush.config.fields import refusal
from branchcrush.files.dictionary import REFINED

_LONGEST_NAME = 100
_NAME = rf"[A-Za-z0-9][A-Za-z0-9._-]{{0,{_LONGEST_NAME - 1}}}"
# Files and folders of results that no sample may be called.
_TAKEN = (
    "figures",
    "findings",
    "made",
    "measured",
    "comparison.csv",
    "config.json",
    "coordination.csv",
    "datapackage.json",
    "exponents.csv",
    "findings.csv",
    "crushing.html",
    "measured.html",
    "report.html",
    "preview.txt",
)


def _usable_name(name: Any) -> str:
    """Return the name of a sample, or refuse one that no folder can have."""
    if not isinstance(name, str):
        raise refusal("a name must be text: put it in quotes")
    if not re.fullmatch(_NAME, name):
        raise refusal(
            f"a name must be 1 to {_LONGEST_NAME} letters, digits, '.', '_' and '-', and begin "
            "with a letter or digit: it names a folder"
        )
    if name.endswith(REFINED):
        raise refusal(f"a name must not end in {REFINED}, kept for the convergence of the others")
    if name in _TAKEN:
        raise refusal(f"a name must not be {name}, which results has for all samples")
    return name


def distinct_names(sections: dict[str, Any]) -> dict[str, Any]:
    """Return sections, or refuse names that differ in capitals only.

    Parameters
    ----------
    sections : dict
        By name.

    Returns
    -------
    dict

    Raises
    ------
    ValueError
        Two names would be one folder where a file system knows no capitals.

    Examples
    --------
    >>> distinct_names({"tiny": 1, "small": 2})
    {'tiny': 1, 'small': 2}
    """
    first: dict[str, str] = {}
    for name in sections:
        other = first.setdefault(name.casefold(), name)
        if other != name:
            raise refusal(
                f"{other} and {name} differ in capitals only, and would be one folder on many "
                "disks: give one of them another name"
            )
    return sections


SampleName = Annotated[str, BeforeValidator(_usable_name)]


NAMES_SCHEMA = {
    "pattern": f"^{_NAME}$",
    "not": {"anyOf": [{"pattern": f"{REFINED}$"}, {"enum": list(_TAKEN)}]},
}
