"""The configuration of a packing that another code made, in place of grading and loading."""

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, ValidationInfo, WithJsonSchema, field_validator

from branchcrush.config.compression import Contact
from branchcrush.config.fields import Allowed, Number, Section, number, refusal
from branchcrush.config.units import UNITS

_FORCES = {"N": 1.0, "kN": 1e3, "MN": 1e6, "mN": 1e-3, "uN": 1e-6}
_FILES = "must be the name of a file, a pattern of names with *, or a list of them, one a packing"
# As `readers.liggghts.KEYWORDS`, which this room must not import; a test holds the two together.
KEYWORDS = (
    "pos",
    "vel",
    "id",
    "force",
    "force_normal",
    "force_tangential",
    "torque",
    "torque_normal",
    "torque_tangential",
    "history",
    "contactArea",
    "delta",
    "contactPoint",
    "ms_id",
    "heatFlux",
)


def _listed(value: Any) -> Any:
    """Return names of files as a list, also where one is given."""
    names = [value] if isinstance(value, str) else value
    good = isinstance(names, list) and names and all(isinstance(n, str) and n for n in names)
    if not good:
        raise refusal(_FILES)
    return names


_NAME = {"type": "string", "minLength": 1}
_FILES_SCHEMA = {
    "anyOf": [_NAME, {"type": "array", "items": _NAME, "minItems": 1, "maxItems": 1000}]
}
Files = Annotated[
    list[str], BeforeValidator(_listed), Allowed(_FILES), WithJsonSchema(_FILES_SCHEMA)
]
Name = Annotated[str, Field(min_length=1)]


def _three(value: Any) -> Any:
    if not isinstance(value, list) or len(value) != 3:
        raise refusal("must be a list of three, of x, y and z")
    return value


_SOME = {"minItems": 0, "maxItems": 1000}
_KEYWORDS_SCHEMA = {
    "type": "array",
    "items": {"enum": list(KEYWORDS)},
    "minItems": 1,
    "maxItems": len(KEYWORDS),
}
Keywords = Annotated[list[str], WithJsonSchema(_KEYWORDS_SCHEMA)]
_OF_THREE = {"type": "array", "minItems": 3, "maxItems": 3}
Vector = Annotated[
    list[Name], BeforeValidator(_three), WithJsonSchema({**_OF_THREE, "items": _NAME})
]
_COORDINATE = Number(least=-1e6, most=1e6)
Corner = Annotated[
    list[number(least=-1e6, most=1e6)],
    BeforeValidator(_three),
    WithJsonSchema({**_OF_THREE, "items": _COORDINATE.json_schema()}),
]


class ContactColumns(Section):
    """What the columns of contacts are called, in the header of the file."""

    id1: Name | None = Field(None, description="Id of the first grain.")
    id2: Name | None = Field(None, description="Id of the second, or of a wall.")
    start: Vector | None = Field(None, description="Centre of the first grain, where ids lack.")
    end: Vector | None = Field(None, description="Centre of the second.")
    branch: Vector | None = Field(
        None, description="Branch vector, either way; tells the periodic face of the contact."
    )
    force: Vector | None = Field(None, description="Force on either grain, tangential part too.")
    normal_force: Name | None = Field(None, description="Its normal part, of either sign.")
    overlap: Name | None = Field(None, description="Overlap, positive where grains touch.")
    gap: Name | None = Field(None, description="Gap, negative where grains touch.")
    point: Vector | None = Field(None, description="Point of contact; needed of walls alone.")
    real: Name | None = Field(
        None, description="Column that is 0 of virtual contacts, which are left out."
    )


class GrainColumns(Section):
    """What the columns of grains are called, in the header of the file."""

    id: Name | None = Field(None, description="Id; without it grains count from 1.")
    position: Vector = Field(["x", "y", "z"], description="Centre.")
    radius: Name | None = Field(None, description="Radius, or give diameter.")
    diameter: Name | None = Field(None, validate_default=True, description="Diameter.")

    @field_validator("diameter")
    @classmethod
    def _one(cls, diameter: str | None, info: ValidationInfo) -> str | None:
        if (diameter is None) == (info.data.get("radius") is None):
            raise refusal("must have either radius or diameter", of_section=True)
        return diameter


class Corners(Section):
    """Two corners of a cell, in the unit of length."""

    low: Corner = Field(description="Lower corner [unit of length].", examples=[[0, 0, 0]])
    high: Corner = Field(description="Upper corner [unit of length].", examples=[[1, 1, 1]])

    @field_validator("high")
    @classmethod
    def _above(cls, high: list[float], info: ValidationInfo) -> list[float]:
        low = info.data.get("low")
        if low is not None and not all(b > a for a, b in zip(low, high, strict=True)):
            raise refusal("must be above low in x, y and z")
        return high


class Packing(Section):
    """Files of another code that hold the grains and contacts of packings."""

    format: Literal["lammps", "liggghts", "yade", "mercurydpm", "columns"] = Field(
        description="Which code wrote them, or columns for tables of any."
    )
    grains: Files = Field(
        description="Files of grains: a name, or a list with one for each packing; a name with * "
        "stands for the frames of one packing.",
        examples=["grains.dump"],
    )
    contacts: Files = Field(
        description="Files of contacts, in the same way.", examples=["contacts.dump"]
    )
    length_unit: Literal["m", "cm", "mm", "um"] = Field("m", description="Of all lengths.")
    force_unit: Literal["N", "kN", "MN", "mN", "uN"] = Field("N", description="Of all forces.")
    columns: ContactColumns | None = Field(
        None, description="Names of the columns of contacts, where the format has none of its own."
    )
    grain_columns: GrainColumns | None = Field(
        None, description="Names of those of grains: id, x, y, z and radius if left out."
    )
    keywords: Keywords | None = Field(
        None, description="Those of LIGGGHTS's compute pair/gran/local, in any order."
    )
    each_pair: Literal["once", "twice"] = Field(
        "once", description="How often the file has each contact; of mercurydpm always twice."
    )
    wall_ids: list[number(int, least=-(2**31), most=2**31)] = Field(
        [], description="Ids that are walls, not grains.", json_schema_extra=_SOME
    )
    cell: Corners | None = Field(
        None, description="Corners of the cell, where the files do not tell it."
    )
    match: Literal["steps", "order"] = Field(
        "steps", description="What brings frames of grains and of contacts together."
    )
    frames: Literal["all", "last"] = Field(
        "all", description="Every frame a state, or the last one alone."
    )
    # The last key is checked when all others are known.
    largest_unbalanced_force_ratio: number(above=0, most=1) = Field(
        0.01, validate_default=True, description="Up to which a state counts as at rest [-]."
    )

    @field_validator("contacts")
    @classmethod
    def _as_many(cls, contacts: list[str], info: ValidationInfo) -> list[str]:
        grains = info.data.get("grains")
        if grains is not None and len(grains) != len(contacts):
            raise refusal(f"must name as many files as grains, one for each packing: {len(grains)}")
        return contacts

    @field_validator("keywords")
    @classmethod
    def _of_liggghts(cls, keywords: list[str] | None, info: ValidationInfo) -> list[str] | None:
        if keywords is not None and info.data.get("format", "liggghts") != "liggghts":
            raise refusal("belongs to format: liggghts")
        unknown = [keyword for keyword in keywords or [] if keyword not in KEYWORDS]
        if unknown:
            raise refusal(f"must be of {', '.join(KEYWORDS)}; not {', '.join(unknown)}")
        return keywords

    @field_validator("largest_unbalanced_force_ratio")
    @classmethod
    def _complete(cls, ratio: float, info: ValidationInfo) -> float:
        columns, kind = info.data.get("columns", "wrong"), info.data.get("format")
        if columns is None and kind == "lammps":
            raise refusal(
                "must have columns, the names of the columns of contacts, since a dump local has "
                "what its user asked for: columns: {id1: 'c_id[1]', id2: 'c_id[2]', "
                "normal_force: 'c_f[1]'}",
                of_section=True,
            )
        if not isinstance(columns, ContactColumns):
            return ratio
        # YADE's VTKExporter has its ends without a name.
        ends = (columns.id1 and columns.id2) or (columns.start and columns.end)
        if not ends and kind != "yade":
            raise refusal("columns must have id1 and id2, or start and end", of_section=True)
        if not (columns.force or columns.normal_force):
            raise refusal(
                "columns must have force or normal_force: energies come from forces, not from "
                "overlaps",
                of_section=True,
            )
        return ratio

    def plain(self) -> dict[str, Any]:
        """Return the section as plain values, units as what they are in SI."""
        values = self.model_dump(exclude_none=True)
        values["length"] = UNITS[values.pop("length_unit")]
        values["force"] = _FORCES[values.pop("force_unit")]
        return values


class ReadSample(Section):
    """Packings that another code made; their grading is that of their grains."""

    packing: Packing = Field(
        description="Files with grains and contacts that another code made, in place of grading, "
        "grains, loading and seeds; boundary and contact have to be given then."
    )
    boundary: Literal["walls", "periodic"] = Field(
        description="Whether the cell repeats in all directions, or has walls."
    )
    contact: Contact = Field(
        description="Law and stiffness of the contacts in that run; energies rest on it."
    )

    @field_validator("contact")
    @classmethod
    def _stated(cls, contact: Contact) -> Contact:
        for key in type(contact).model_fields:
            if key not in contact.model_fields_set:
                raise refusal(
                    "give that of the run: energies rest on it, so that it has no default here",
                    key=key,
                    value=None,
                    missing=True,
                )
        return contact

    @property
    def seeds(self) -> list[int]:
        """Packings, numbered from 1."""
        return list(range(1, len(self.packing.grains) + 1))

    @property
    def refined_seeds(self) -> int:
        """None can be run again."""
        return 0

    @property
    def breakage(self) -> None:
        """Their grains do not break."""
        return None

    def settings(self, refinement: int = 1) -> dict[str, Any]:
        """Return the sample as plain values, with the keys of one that is compressed here.

        Parameters
        ----------
        refinement : int
            Of no effect.

        Returns
        -------
        dict
            What only a compression has is None. The grading is a list of radii, whose file the
            workflow writes.
        """
        grading = {"form": "radii", "basis": "number", "size": "radius", "unit": "m", "file": ""}
        return {
            "packing": self.packing.plain(),
            "grading": grading,
            "sampling": "listed",
            "grains": None,
            "allow_unrepresentative": True,
            "boundary": self.boundary,
            "initial_solid_fraction": None,
            "contact": self.contact.model_dump(),
            "loading": None,
            "breakage": None,
            "refined_seeds": 0,
            "ranks": 1,
            "strain_step": None,
            "state_tolerance": None,
            "quality": None,
            "seeds": self.seeds,
        }
