"""Names of samples and of measured materials: they name folders of results."""

import re
from typing import Annotated, Any

from pydantic import BeforeValidator

from branchcrush.config.fields import refusal

# Ends the name of a sample run with twice the strain steps, to judge its convergence.
REFINED = "-refined"
_LONGEST_NAME = 100
_NAME = rf"[A-Za-z0-9][A-Za-z0-9._-]{{0,{_LONGEST_NAME - 1}}}"
# Files and folders of results that no sample may be called.
_TAKEN = (
    "figures",
    "findings",
    "made",
    "measured",
    "comparison.csv",
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


SampleName = Annotated[str, BeforeValidator(_usable_name)]


NAMES_SCHEMA = {
    "pattern": f"^{_NAME}$",
    "not": {"anyOf": [{"pattern": f"{REFINED}$"}, {"enum": list(_TAKEN)}]},
}
