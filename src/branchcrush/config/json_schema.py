"""The JSON schema of the configuration, by which editors complete, explain and check a file.

    python -m branchcrush.config.json_schema

in the folder of the project writes it to `config.schema.json`, and from it the tables of
`docs/configuration.md`. It accepts all that a study does; what needs two keys at once, a grain or a
file is checked when a study begins.
"""

import json
from pathlib import Path
from typing import Any

from pydantic.json_schema import GenerateJsonSchema

from branchcrush.config.reference import with_tables
from branchcrush.config.schema import Config

_SCHEMA_FILE, _PAGE = Path("config.schema.json"), Path("docs/configuration.md")


class _Untitled(GenerateJsonSchema):
    """Leaves out titles made from the names of keys, which say nothing more."""

    def field_title_should_be_set(self, schema: Any) -> bool:
        return False


def json_schema() -> dict[str, Any]:
    """Return the JSON schema of the whole configuration, as plain values.

    Examples
    --------
    >>> json_schema()["properties"]["energy_split"]["description"]
    'How the energy split is binned, and the intervals found.'
    """
    schema = Config.model_json_schema(schema_generator=_Untitled)
    choosers = {section["propertyName"] for section in _found(schema, "discriminator")}
    for section in schema["$defs"].values():
        del section["title"]
        for key in choosers & section["properties"].keys():
            # The word that chooses a section means what the section is.
            section["properties"][key].setdefault("description", section["description"])
    return {
        "$schema": GenerateJsonSchema.schema_dialect,
        **schema,
        "title": "Configuration of a branchcrush study",
    }


def schema_text() -> str:
    """Return the content of `config.schema.json`.

    Examples
    --------
    >>> schema_text().splitlines()[-1]
    '}'
    """
    return json.dumps(json_schema(), indent=2, ensure_ascii=False) + "\n"


def _found(schema, name):
    """Yield the value of a key wherever it stands in a schema."""
    if isinstance(schema, dict):
        if isinstance(schema.get(name), dict):
            yield schema[name]
        for below in schema.values():
            yield from _found(below, name)
    elif isinstance(schema, list):
        for below in schema:
            yield from _found(below, name)


if __name__ == "__main__":
    _SCHEMA_FILE.write_text(schema_text(), encoding="utf-8")
    page = with_tables(_PAGE.read_text(encoding="utf-8"), json_schema())
    _PAGE.write_text(page, encoding="utf-8")
