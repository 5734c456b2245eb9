"""The mean stresses of a loading, as a user may give them: a number, a list, or a range."""

from itertools import pairwise
from typing import Any

import numpy as np

from branchcrush.config.fields import Number, number_of, one_line, refusal

_MOST_STATES = 1000
_STRESS = Number(above=0, most=1e15, unit="Pa").json_schema()
_RANGE = {
    "from": {"description": "Smallest stress [Pa].", **_STRESS},
    "to": {"description": "Largest stress [Pa].", **_STRESS},
    "states": {
        "description": "Number of stresses, even in the logarithm.",
        **Number(least=2, most=_MOST_STATES, whole=True).json_schema(),
    },
}
# JSON schema of what `increasing_stresses` reads.
STRESSES = {
    "anyOf": [
        *_STRESS["anyOf"],
        {"type": "array", "items": _STRESS, "minItems": 1, "maxItems": _MOST_STATES},
        {
            "type": "object",
            "properties": _RANGE,
            "required": list(_RANGE),
            "additionalProperties": False,
        },
    ]
}
_ALLOWED = (
    "must be a stress in Pa, an increasing list of them, or a range {from: 1e5, to: 1e7, states: 9}"
)


def increasing_stresses(value: Any) -> list[float] | None:
    """Return the mean stresses of a config key as an increasing list [Pa].

    Parameters
    ----------
    value : float, list, or dict with from, to and states
        What the YAML file holds [Pa].

    Returns
    -------
    list of float
        None for none.

    Raises
    ------
    PydanticCustomError
        Saying what is allowed.

    Examples
    --------
    >>> increasing_stresses({"from": "1e5", "to": 1e7, "states": 3})
    [100000.0, 1000000.0, 10000000.0]
    """
    if value is None:
        return None
    if isinstance(value, dict):
        return _range(value)
    items = value if isinstance(value, list) else [value]
    stresses = [_stress(item) for item in items]
    if not stresses:
        raise _refused("the list is empty")
    if len(stresses) > _MOST_STATES:
        raise _refused(f"{len(stresses)} stresses are more than {_MOST_STATES}")
    for low, high in pairwise(stresses):
        if low >= high:
            raise _refused(f"{high:g} does not rise above {low:g} before it")
    return stresses


def _range(value):
    """Return the stresses of a range, even in the logarithm."""
    if set(value) != set(_RANGE):
        keys = ", ".join(map(one_line, list(value)[:5])) or "none"
        raise _refused(f"its keys are {keys}")
    states = number_of(value["states"])
    if states is None or states != int(states) or not 2 <= states <= _MOST_STATES:
        raise _refused(f"states must be a whole number from 2 to {_MOST_STATES}")
    ends = [_stress(value[end]) for end in ("from", "to")]
    if ends[0] >= ends[1]:
        raise _refused(f"from {ends[0]:g} Pa must be below to {ends[1]:g} Pa")
    return np.geomspace(*ends, int(states)).tolist()


def _stress(value):
    stress = number_of(value)
    if stress is None or not 0 < stress <= 1e15:
        raise _refused("each must be a number above 0 and at most 1e15")
    return float(stress)


def _refused(what):
    return refusal(f"{_ALLOWED}; {what}", unit="Pa")
