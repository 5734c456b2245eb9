"""Tables of all keys of the configuration, made from its JSON schema for the documentation."""

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from branchcrush.errors import ConfigError
from branchcrush.files.blocks import filled, table

_NOTHING = {"type": "null"}
# A sentence, and perhaps a unit before its full stop.
_DESCRIPTION = re.compile(r"(.*?)(?: \[([^\]]+)\])?\.?", re.DOTALL)


class Key(NamedTuple):
    """A key of the configuration, in the words of its schema."""

    path: str
    meaning: str
    unit: str
    default: str
    allowed: str


def with_tables(page: str, schema: Mapping[str, Any]) -> str:
    """Return a page with each of its tables made anew.

    Parameters
    ----------
    page : str
        With a pair of comments where each table stands.
    schema : dict
        From `config.json_schema.json_schema`.

    Returns
    -------
    str

    Raises
    ------
    ConfigError
        When the page has no place for a table.

    Examples
    --------
    >>> schema = {"properties": {"dpi": {"type": "integer", "minimum": 50, "default": 300,
    ...                                  "description": "Resolution [dots per inch]."}}}
    >>> page = "<!-- made from config.schema.json: keys --><!-- end -->"
    >>> print(with_tables(page, schema).splitlines()[3])
    | `dpi` | Resolution | dots per inch | 300 | 50 up |
    """
    blocks = {name: [lines] for name, lines in tables(schema).items()}
    try:
        return filled(page, blocks, "from config.schema.json")
    except ValueError as error:
        raise ConfigError(str(error)) from None


def tables(schema: Mapping[str, Any]) -> dict[str, str]:
    """Return the tables of a schema by name, in Markdown.

    Parameters
    ----------
    schema : dict

    Returns
    -------
    dict of str
        `keys` for all but those of sections that have several forms, and one for each such section
        by the key that it stands at.

    Examples
    --------
    >>> list(tables({"properties": {}}))
    ['keys']
    """
    header = ["key", "meaning", "unit", "default", "allowed"]
    made = {"keys": _table(header, _keys(schema, schema, ""))}
    for name, choices in _choices(schema, schema).items():
        if _told_at(schema, name, choices) == name:
            made[name] = _choice_table(schema, choices)
    return made


def _choice_table(root, section):
    """Return the forms of a section and their keys, as two tables."""
    chooser = section["discriminator"]["propertyName"]
    sections = [_resolved(root, choice) for choice in section["oneOf"]]
    forms = {form["properties"][chooser]["const"]: form for form in sections}
    rows = [
        (f"`{word}`", form["description"].removesuffix("."), _names(form, chooser))
        for word, form in forms.items()
    ]
    used: dict[Key, list[str]] = {}
    for word, form in forms.items():
        # One word alone stands with the form.
        others = {key: value for key, value in form["properties"].items() if "const" not in value}
        for key in _keys(root, {**form, "properties": others}, ""):
            used.setdefault(key, []).append(word)
    keys = [(key.path, _words(words, list(forms)), *key[1:]) for key, words in used.items()]
    header = ["key", f"with {chooser}", "meaning", "unit", "default", "allowed"]
    return f"{_table([chooser, 'is', 'keys'], rows)}\n\n{_table(header, keys)}"


def _words(words, of_all):
    """Return some of all words, or which of them are not among them where these are fewer."""
    others = [word for word in of_all if word not in words]
    if len(others) >= len(words):
        return ", ".join(words)
    return f"all but {', '.join(others)}" if others else "all"


def _names(form, chooser):
    """Return the keys of a form; a value where there is but one, brackets where it may be left."""
    names = []
    for key, value in form["properties"].items():
        if key == chooser:
            continue
        name = f"`{key}: {value['const']}`" if "const" in value else f"`{key}`"
        names.append(name if key in form.get("required", []) else f"({name})")
    return ", ".join(names)


def _keys(root, section, above) -> Iterator[Key]:
    """Yield each key of a section and below it, but for those of a section of several forms."""
    for name, value in section["properties"].items():
        path, below = f"{above}{name}", _resolved(root, value)
        meaning, unit = _DESCRIPTION.fullmatch(below.get("description", "")).groups()
        required = name in section.get("required", [])
        default = "required" if required else _default(value.get("default"))
        inner, path_below = below, f"{path}."
        if isinstance(below.get("additionalProperties"), dict):
            inner, path_below = (
                _resolved(root, below["additionalProperties"]),
                f"{path}.<name>.",
            )
        elif below.get("type") == "array" and "$ref" in below["items"]:
            inner, path_below = _resolved(root, below["items"]), f"{path}[]."
        elif "properties" in below and not required:
            default = ""
        allowed = _allowed(_told_at(root, name, below), below)
        yield Key(f"`{path}`", meaning.replace("<", "&lt;"), unit or "", default, allowed)
        if "properties" in inner:
            yield from _keys(root, inner, path_below)


def _choices(root, section) -> dict[str, Any]:
    """Return the sections below that have several forms, by the key that each stands at."""
    found: dict[str, Any] = {}
    for name, value in section.get("properties", {}).items():
        below = _resolved(root, value)
        if "discriminator" in below:
            found.setdefault(name, below)
        for inner in (below, below.get("additionalProperties"), below.get("items")):
            if isinstance(inner, dict):
                found = _choices(root, _resolved(root, inner)) | found
    return found


def _told_at(root, name, section):
    """Return the first key whose section has the same forms, which one table tells of."""
    if "discriminator" not in section:
        return name
    # Those found first come last.
    choices = reversed(_choices(root, root).items())
    return next((key for key, at in choices if at["oneOf"] == section["oneOf"]), name)


def _resolved(root, value):
    """Return a part of a schema with what it refers to; of one that may be left out, too."""
    kinds = [kind for kind in value.get("anyOf", ()) if kind != _NOTHING]
    if len(kinds) == 1 and {"$ref", "oneOf"} & kinds[0].keys():
        others = {key: other for key, other in value.items() if key != "anyOf"}
        return {**_resolved(root, kinds[0]), **others}
    if "oneOf" in value and "discriminator" not in value:
        # Forms that their keys tell apart: those of the first, and what others have besides.
        first, *others = (_resolved(root, kind) for kind in value["oneOf"])
        more = {key: each for other in others for key, each in other["properties"].items()}
        return {**first, "properties": first["properties"] | {**more, **first["properties"]}}
    if "$ref" not in value:
        return value
    return {**root["$defs"][value["$ref"].rpartition("/")[2]], **value}


def _allowed(name, value):
    """Return in words what a key may hold."""
    if "discriminator" in value:
        return f"see {name}"
    if "anyOf" in value:
        # Text that spells a number says no more than the number, and nothing is what is left out.
        kinds = [
            kind for kind in value["anyOf"] if not ({"pattern"} & kind.keys() or kind == _NOTHING)
        ]
        return ", or ".join(filter(None, (_allowed(name, kind) for kind in kinds)))
    if "const" in value:
        return f"`{value['const']}`"
    if "enum" in value:
        return ", ".join(f"`{word}`" for word in value["enum"])
    kind = value.get("type")
    if kind == "boolean":
        return "true or false"
    if kind == "string":
        return "text"
    if kind == "array" and "$ref" not in value["items"]:
        least, most = value["minItems"], value["maxItems"]
        return f"a list of {least}" if least == most else f"a list of {least} to {most}"
    if kind == "object" and "required" in value and value.get("description") is None:
        return f"`{{{', '.join(value['required'])}}}`"
    return _bounds(value) if kind in ("number", "integer") else ""


def _bounds(value):
    above, least, below, most = (
        value.get(bound) for bound in ("exclusiveMinimum", "minimum", "exclusiveMaximum", "maximum")
    )
    if least is not None:
        return f"{_plain(least)} up" if most is None else f"{_plain(least)} to {_plain(most)}"
    if below is not None:
        return f"between {_plain(above)} and {_plain(below)}"
    return f"above {_plain(above)}" + ("" if most is None else f", up to {_plain(most)}")


def _default(value):
    if value is None:
        return ""
    if isinstance(value, dict):
        return f"`{{{', '.join(f'{key}: {_default(item)}' for key, item in value.items())}}}`"
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return value if isinstance(value, str) else json.dumps(value)
    return _plain(value)


def _plain(number):
    """Return a number as one writes it: 1e6."""
    text = f"{number:g}" if isinstance(number, float) else str(number)
    return re.sub(r"e\+?(-?)0*", r"e\1", text)


def _table(header, rows):
    return "\n".join(table(header, list(rows)))
