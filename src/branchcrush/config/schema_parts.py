"""Parts of the JSON schema of the configuration that do not follow from the types of its keys."""

from collections.abc import Callable, Mapping
from typing import Any

from branchcrush.config.fields import Number

# A whole configuration, as an editor may offer it.
EXAMPLE = {
    "samples": {
        "sand": {
            "grading": {
                "form": "lognormal",
                "basis": "mass",
                "size": "diameter",
                "unit": "mm",
                "median": 0.5,
                "geometric_standard_deviation": 1.3,
                "min": 0.25,
                "max": 1.0,
            },
            "grains": 1200,
            "boundary": "periodic",
            "loading": {"solid_fraction": 0.78, "approach_solid_fraction": 0.6},
            "seeds": 4,
        }
    }
}


def given(*keys: str) -> dict[str, Any]:
    """Return the JSON schema of a section in which keys have a value.

    Parameters
    ----------
    *keys : str

    Returns
    -------
    dict

    Examples
    --------
    >>> given("states")["required"]
    ['states']
    """
    return {"required": list(keys), "properties": {key: {"not": {"type": "null"}} for key in keys}}


def required_unless(key: str, other: Mapping[str, Any]) -> Callable[[dict[str, Any]], None]:
    """Return what changes the JSON schema of a section with a key that a check may fill in.

    Parameters
    ----------
    key : str
    other : mapping
        JSON schema of the sections in which the key may be left out.

    Returns
    -------
    callable
        For `json_schema_extra` of the section.

    Examples
    --------
    >>> schema = {"required": ["a", "b"]}
    >>> required_unless("a", {"required": ["c"]})(schema)
    >>> schema
    {'required': ['b'], 'anyOf': [{'required': ['a']}, {'required': ['c']}]}
    """

    def changed(schema):
        schema["required"] = [name for name in schema["required"] if name != key]
        schema["anyOf"] = [{"required": [key]}, dict(other)]

    return changed


def number_or_list(count: Number, item: Number, most: int) -> dict[str, Any]:
    """Return the JSON schema of a number or a list of different ones.

    Parameters
    ----------
    count, item : config.fields.Number
        The number alone, and each of a list.
    most : int
        How many a list may have.

    Returns
    -------
    dict

    Examples
    --------
    >>> number_or_list(Number(least=1), Number(least=0), 3)["anyOf"][-1]["maxItems"]
    3
    """
    items = {"items": item.json_schema(), "minItems": 1, "maxItems": most, "uniqueItems": True}
    return {"anyOf": [*count.json_schema()["anyOf"], {"type": "array", **items}]}
