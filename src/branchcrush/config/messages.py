"""What is wrong with a configuration, in the user's words: key, value, what is allowed."""

import math
import types
import typing
from collections.abc import Mapping
from difflib import get_close_matches
from typing import Any

from pydantic import BaseModel

from branchcrush.config.fields import number_of, one_line

_A_SECTION = "must be a section with keys of its own"
_ALLOWED = {
    "model_type": _A_SECTION,
    "model_attributes_type": _A_SECTION,
    "dict_type": _A_SECTION,
    "list_type": "must be a list",
    "bool_type": "must be true or false",
    "string_type": "must be text",
    "string_too_short": "must not be empty",
}
# Of a value that fills the screen, the beginning tells which it is.
_LONGEST = 100


def problem(detail: Mapping[str, Any], root: type[BaseModel]) -> str:
    """Return one problem that pydantic found as one line, with the key as the user typed it.

    Parameters
    ----------
    detail : dict
        One of `ValidationError.errors()`.
    root : type
        Model of the whole configuration.

    Returns
    -------
    str
        Without pydantic's own names of types and forms.

    Examples
    --------
    >>> class Root(BaseModel):
    ...     grains: int
    >>> problem({"type": "missing", "loc": ("grains",), "input": {}}, Root)
    'grains: missing; give it a value'
    """
    path, section, kind_of_value = _typed_path(detail["loc"], root)
    kind, value, context = detail["type"], detail["input"], detail.get("ctx", {})
    if kind == "extra_forbidden":
        known = list(section.model_fields)
        near = get_close_matches(path[-1], known, n=1)
        hint = f"did you mean {near[0]}?" if near else f"allowed: {', '.join(known)}"
        return f"{_key(path)}: unknown key; {hint}"
    if kind == "missing":
        return f"{_key(path)}: missing; {_allowed(kind_of_value)}"
    if kind.startswith("union_tag"):
        # A form decides the other keys of its section.
        path.append(context["discriminator"].strip("'"))
        known = list(_forms(kind_of_value))
        if kind == "union_tag_not_found":
            return f"{_key(path)}: missing; {_one_of(known)}"
        value = value[path[-1]]
        return f"{_key(path)} = {shown(value)}: {_one_of(known, value)}"
    if kind == "literal_error":
        return f"{_key(path)} = {shown(value)}: {_one_of(_words(kind_of_value), value)}"
    if kind == "refusal":
        if context.get("of_section"):
            return f"{_key(path[:-1])}: {context['words']}"
        if "key" in context:
            path.append(context["key"])
            value = context["value"]
        if context.get("missing"):
            return f"{_key(path)}: missing; {context['words']}"
        unit = f" {context['unit']}" if context.get("unit") and number_of(value) is not None else ""
        return f"{_key(path)} = {shown(value)}{unit}: {context['words']}"
    return f"{_key(path)} = {shown(value)}: {_ALLOWED.get(kind, 'has no meaning here')}"


def shown(value: Any) -> str:
    """Return a value of the YAML file as a user would write it, on one line.

    Parameters
    ----------
    value : object

    Returns
    -------
    str
        At most 100 characters.

    Examples
    --------
    >>> shown([True, None, 0.1, "a", float("nan")])
    "[true, nothing, 0.1, 'a', nan]"
    """
    whole = _yaml(value)
    return whole if len(whole) <= _LONGEST else whole[: _LONGEST - 3] + "..."


def _yaml(value):
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return f"{value:g}" if math.isfinite(value) else str(value)
    if isinstance(value, str):
        number = number_of(value) is not None and value.isprintable()
        return value if number else repr(value[: _LONGEST + 1])
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(_yaml, value[:_LONGEST]))}]"
    if isinstance(value, dict):
        return f"{{{', '.join(f'{one_line(key)}: {_yaml(item)}' for key, item in value.items())}}}"
    try:
        return str(value)
    except ValueError:  # of more digits than Python writes
        return "a number of thousands of digits"


def _typed_path(location, root):
    """Return the keys the user typed, the model of the last of them, and the type of its value."""
    path, kind, section = [], root, root
    parts = list(location)
    while parts:
        part = parts.pop(0)
        path.append(str(part))
        section, kind = kind, _kind_below(kind, part)
        forms = _forms(kind)
        if forms and parts:
            # pydantic puts the form chosen between the keys; the user did not.
            kind = forms.get(parts.pop(0))
        if typing.get_origin(_bare(section)) is dict and parts[:1] == ["[key]"]:
            parts.pop(0)
    return path, section, kind


def _kind_below(kind, part):
    """Return the type of a key's value: a model, a container, or a union with what chooses."""
    kind = _bare(kind)
    if isinstance(kind, type) and issubclass(kind, BaseModel):
        field = kind.model_fields.get(part)
        return field and typing.Annotated[_given(field.annotation), field, *field.metadata]
    if typing.get_origin(kind) in (dict, list):
        return typing.get_args(kind)[-1]
    return None


def _given(kind):
    """Return the type of a value where nothing may be given instead."""
    if typing.get_origin(kind) in (typing.Union, types.UnionType):
        others = [each for each in typing.get_args(kind) if each is not type(None)]
        return others[0] if len(others) == 1 else kind
    return kind


def _bare(kind):
    """Return a type without what pydantic checks besides it."""
    return typing.get_args(kind)[0] if typing.get_origin(kind) is typing.Annotated else kind


def _forms(kind):
    """Return the models of a union by the word that chooses one of them."""
    if typing.get_origin(kind) is not typing.Annotated:
        return {}
    union, *extras = typing.get_args(kind)
    chooser = next(filter(None, (getattr(extra, "discriminator", None) for extra in extras)), None)
    if chooser is None or typing.get_origin(union) not in (typing.Union, types.UnionType):
        return {}
    if callable(chooser):  # the keys that are there choose, and each form has a tag
        return {typing.get_args(each)[1].tag: _bare(each) for each in typing.get_args(union)}
    return {
        typing.get_args(model.model_fields[chooser].annotation)[0]: model
        for model in typing.get_args(union)
    }


def _allowed(kind):
    """Return what a key that is not there must hold."""
    union, *extras = typing.get_args(kind)
    for extra in extras:
        allowed = getattr(getattr(extra, "func", extra), "allowed", None)
        if allowed:
            return allowed
    if typing.get_origin(union) is typing.Literal:
        return _one_of(typing.get_args(union))
    return _A_SECTION if _forms(kind) or hasattr(union, "model_fields") else "give it a value"


def _words(kind):
    """Return the words that a key may hold; of one that may be left out, too."""
    union = typing.get_args(kind)[0]
    if typing.get_origin(union) in (typing.Union, types.UnionType):
        union = next(each for each in typing.get_args(union) if typing.get_args(each))
    return typing.get_args(union)


def _one_of(words, value=None):
    # Of units, the nearest is no better a guess than any other.
    near = get_close_matches(value, words, n=1, cutoff=0.7) if isinstance(value, str) else []
    hint = f"; did you mean '{near[0]}'?" if near else ""
    quoted = [f"'{word}'" for word in words]
    return "must be " + " or ".join(filter(None, [", ".join(quoted[:-1]), quoted[-1]])) + hint


def _key(path):
    return ".".join(map(one_line, path)) or "the file"
