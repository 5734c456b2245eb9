"""How a table of sizes is declared to be read, and in which words that is told."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from shlex import quote
from typing import Any

# What each key may say. A test holds the configuration to it.
WORDS = {
    "size": ("diameter", "radius"),
    "basis": ("mass", "volume", "number"),
    "values": ("percent_finer", "percent_coarser", "percent_retained", "mass_retained"),
    "openings": ("size", "phi", "astm_e11", "tyler_mesh"),
    "sizes": ("edges", "lower", "upper", "middles"),
    "scale": ("log", "linear"),
    "per": ("size", "log_size", "phi"),
}
# What is taken where a section says nothing.
DEFAULTS = {"values": "percent_finer", "openings": "size", "per": "size", "scale": "log"}
_OF_CHANNELS = {"sizes", "scale", "per"}


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
    typed : mapping, optional
        The file and the options of the command line; None of a configuration.

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
    typed: Mapping[str, Any] | None = field(default=None, compare=False)

    @classmethod
    def of(cls, section: Mapping[str, Any]) -> "Declared":
        """Return what a section of the configuration declares."""
        known = {key: section.get(key) for key in ("values", "openings", "sheet", "sizes", "scale")}
        known |= {key: section.get(key) for key in ("per", "basis", "typed")}
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
        return self.taken("values")

    @property
    def scale_of_openings(self) -> str:
        """What openings are, by the key or by its default."""
        return self.taken("openings")

    def taken(self, key: str) -> str:
        """Return what a key says, or its default."""
        return getattr(self, key) or DEFAULTS[key]

    def other(self, values: str, openings: str, unit: str | None = None) -> "Declared":
        """Return the same but for what the columns mean."""
        return replace(self, values=values, openings=openings, unit=unit or self.unit)

    def keys(self, names: tuple[str, ...]) -> str:
        """Return keys with their values, or the defaults', as they are pasted."""
        return ", ".join(f"{name}: {self.taken(name)}" for name in names)

    def advice(self, keys: Mapping[str, Any]) -> str:
        """Return keys as they are pasted, or on the command line the command that has them.

        Examples
        --------
        >>> Declared().advice({"values": "percent_finer"})
        'values: percent_finer'
        >>> Declared(typed={"file": "my sand.csv", "unit": "mm"}).advice({"openings": "size"})
        "branchcrush grading 'my sand.csv' --unit mm --openings size"
        """
        if self.typed is None:
            return ", ".join(f"{key}: {value}" for key, value in keys.items())
        # Another form has other keys.
        foreign = _OF_CHANNELS - set(keys) if "form" in keys else set()
        options = {key: item for key, item in {**self.typed, **keys}.items() if key not in foreign}
        words = ["branchcrush", "grading", options.pop("file")]
        for key, item in options.items():
            # The default form need not be typed.
            if (key, item) != ("form", "sieve"):
                items = item if isinstance(item, (list, tuple)) else [item]
                words += [f"--{key}", *map(_plain, items)]
        return " ".join(map(quote, words))


def _plain(item):
    return f"{item:.12g}" if isinstance(item, float) else str(item)
