"""Where a packing is read from, of plain settings."""

from collections.abc import Mapping, Sequence
from typing import Any

from branchcrush.readers.layouts import Source

# Keys of the settings that are taken as they are.
_SAME = ("format", "columns", "grain_columns", "keywords", "each_pair", "match", "length", "force")


def source_of(
    settings: Mapping[str, Any], grains: Sequence[str], contacts: Sequence[str], boundary: str
) -> Source:
    """Return how the files of one packing are to be read.

    Parameters
    ----------
    settings : mapping
        Of `config.packing.Packing.plain`.
    grains, contacts : sequence of str
        Files of this packing, in the order of their frames.
    boundary : {"walls", "periodic"}

    Returns
    -------
    Source

    Examples
    --------
    >>> source = source_of({"format": "yade", "frames": "last"}, ["a.txt"], ["b.vtk"], "periodic")
    >>> source.periodic, source.last
    (True, True)
    """
    cell = settings.get("cell", {})
    return Source(
        grains=grains,
        contacts=contacts,
        periodic=boundary == "periodic",
        wall_ids=tuple(settings.get("wall_ids", ())),
        last=settings.get("frames") == "last",
        low=cell.get("low"),
        high=cell.get("high"),
        **{key: settings[key] for key in _SAME if key in settings},
    )
