"""How a table of sizes is declared to be read, and in which words that is told."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

VALUES = ("percent_finer", "percent_coarser", "percent_retained", "mass_retained")
OPENINGS = ("size", "phi", "astm_e11", "tyler_mesh")


@dataclass(frozen=True)
class Declared:
    """Keys of a section that say how its file is read; None where the section says nothing.

    Parameters
    ----------
    values, openings, sizes, scale, per, basis : str, optional
    unit : str
    columns : tuple of str or int, optional
    sheet : str or int, optional
    smallest, largest : float, optional
        In the unit.

    Examples
    --------
    >>> Declared.of({"unit": "um", "openings": "phi"}).keys(("values", "openings"))
    'values: percent_finer, openings: phi'
    """

    values: str | None = None
    openings: str | None = None
    unit: str = "mm"
    columns: tuple[str | int, ...] | None = None
    sheet: str | int | None = None
    smallest: float | None = None
    largest: float | None = None
    sizes: str | None = None
    scale: str | None = None
    per: str | None = None
    basis: str | None = None

    @classmethod
    def of(cls, section: Mapping[str, Any]) -> "Declared":
        """Return what a section of the configuration declares."""
        known = {key: section.get(key) for key in ("values", "openings", "sheet", "sizes", "scale")}
        known |= {key: section.get(key) for key in ("per", "basis")}
        columns = section.get("columns")
        if isinstance(columns, Mapping):
            columns = [column for column in columns.values() if column is not None]
        return cls(
            **known,
            unit=section.get("unit") or "mm",
            columns=tuple(columns) if columns else None,
            smallest=section.get("min"),
            largest=section.get("max"),
        )

    @property
    def kind(self) -> str:
        """What values are, by the key or by its default."""
        return self.values or "percent_finer"

    @property
    def scale_of_openings(self) -> str:
        """What openings are, by the key or by its default."""
        return self.openings or "size"

    def other(self, values: str, openings: str, unit: str | None = None) -> "Declared":
        """Return the same but for what the columns mean."""
        return replace(self, values=values, openings=openings, unit=unit or self.unit)

    def keys(self, names: tuple[str, ...]) -> str:
        """Return keys with their values, or the defaults', as they are pasted."""
        defaults = {"values": "percent_finer", "openings": "size", "per": "size"}
        said = {name: getattr(self, name) or defaults.get(name) for name in names}
        return ", ".join(f"{name}: {value}" for name, value in said.items())
