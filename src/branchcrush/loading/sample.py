"""A sample as a study asks for it: what its packings are made of, and how they are loaded."""

from dataclasses import dataclass
from typing import Literal

from branchcrush.gradings.distribution import Grading
from branchcrush.loading.targets import STATE_TOLERANCES, Loading
from branchcrush.packings.contact_laws import HertzContact, LinearContact


@dataclass(frozen=True, kw_only=True, eq=False)
class Sample:
    """A named entry of the configuration, as a job uses it: `config.sample.sample_of` makes it."""

    grading: Grading
    sampling: str  # how radii are drawn: one of `gradings.sampling.METHODS`
    grains: int  # N of one packing
    boundary: Literal["walls", "periodic"]
    initial_solid_fraction: float  # of the loose packing [-]
    law: LinearContact | HertzContact
    loading: Loading
    strain_step: float  # largest linear strain of a step [-]
    # Largest unbalanced force ratio of a saved state [-].
    state_tolerance: float = STATE_TOLERANCES["fine"]
    seeds: tuple[int, ...] = ()
    refined_seeds: int = 0  # of them run again with twice the strain steps
    ranks: int = 1  # MPI processes that share a packing

    @property
    def periodic(self) -> bool:
        """Whether the faces of the cell are joined."""
        return self.boundary == "periodic"

    @property
    def end(self) -> float:
        """Solid fraction at the end of the loading, or about what a stress leads to [-]."""
        return self.loading.end(self.initial_solid_fraction)
