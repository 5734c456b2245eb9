"""What a file of another code holds at one moment: columns by their names."""

from dataclasses import dataclass, field

from numpy.typing import NDArray

from branchcrush.readers.cells import Cell


@dataclass(frozen=True, eq=False)
class ColumnFrame:
    """The columns of one moment, as a file names them."""

    where: str  # the file, and its frame, for errors
    columns: dict[str, NDArray]  # each of shape (n,), or (n, 3)
    step: float | None = None  # that the file tells, by which grains and contacts belong together
    cell: Cell | None = None  # where the file tells it
    boundary_told: bool = False  # whether the file tells in which directions the cell repeats
    digits: int = 17  # significant ones of its numbers
    notes: tuple[str, ...] = field(default=())

    @property
    def rows(self) -> int:
        """How many grains or contacts it has."""
        return len(next(iter(self.columns.values()))) if self.columns else 0
