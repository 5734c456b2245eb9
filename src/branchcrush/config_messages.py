"""What is wrong with a configuration, in the user's words: key, value, what is allowed."""

import math
import types
import typing
from difflib import get_close_matches

from pydantic import BaseModel

_A_SECTION = "must be a section with keys of its own"
_MESSAGES = {
    "model_type": _A_SECTION,
    "model_attributes_type": _A_SECTION,
    "dict_type": _A_SECTION,
}


def problem(detail, root):
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
    """
    path, section = _typed_path(detail["loc"], root)
    kind, value, context = detail["type"], detail["input"], detail.get("ctx", {})
    if kind.startswith("union_tag"):
        # A form decides the other keys of its section.
        path.append(context["discriminator"].strip("'"))
        if kind == "union_tag_not_found":
            return f"{_key(path)}: missing; give it a value"
        value = context["tag"]
        message = f"must be one of {context['expected_tags']}"
    elif kind == "extra_forbidden":
        known = list(section.model_fields)
        near = get_close_matches(path[-1], known, n=1)
        hint = f"did you mean {near[0]}?" if near else f"allowed: {', '.join(known)}"
        return f"{_key(path)}: unknown key; {hint}"
    elif kind == "missing":
        return f"{_key(path)}: missing; give it a value"
    else:
        message = _MESSAGES.get(kind, detail["msg"].removeprefix("Value error, "))
    # A check over several keys names their values itself.
    shown = "" if isinstance(value, (dict, BaseModel)) else f" = {_shown(value)}"
    return f"{_key(path)}{shown}: {message[0].lower()}{message[1:]}"


def _typed_path(location, root):
    """Return the keys the user typed, and the model that the last of them belongs to."""
    path, kind, section = [], root, root
    parts = list(location)
    while parts:
        part = parts.pop(0)
        path.append(str(part))
        section, kind = kind, _kind_below(kind, part)
        forms = _forms(kind)
        if forms and parts and parts[0] in forms:
            kind = forms[parts.pop(0)]
        if typing.get_origin(section) is dict and parts[:1] == ["[key]"]:
            parts.pop(0)
    return path, section


def _kind_below(kind, part):
    if isinstance(kind, type) and issubclass(kind, BaseModel):
        field = kind.model_fields.get(part)
        return field and field.annotation
    if typing.get_origin(kind) is dict:
        return typing.get_args(kind)[1]
    return None


def _forms(kind):
    """Return the models of a union by the form that chooses one of them."""
    if typing.get_origin(kind) is typing.Annotated:
        kind = typing.get_args(kind)[0]
    if typing.get_origin(kind) not in (typing.Union, types.UnionType):
        return {}
    return {
        typing.get_args(model.model_fields["form"].annotation)[0]: model
        for model in typing.get_args(kind)
    }


def _key(path):
    return ".".join(path) or "the file"


def _shown(value):
    return f"{value:g}" if isinstance(value, float) and math.isfinite(value) else repr(value)
