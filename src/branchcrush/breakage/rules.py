"""What a sample whose grains break is asked for: `breakage` of its configuration, as numbers."""

from dataclasses import dataclass
from typing import Literal

from branchcrush.breakage.fragments import growth, packed_spheres
from branchcrush.breakage.strength import Strength


@dataclass(frozen=True, kw_only=True)
class Breakage:
    """How grains break, and how the run goes on when they do.

    Examples
    --------
    >>> sand = Strength(strength=2e7, weibull_modulus=3.0, reference_diameter=1e-3,
    ...                 size_exponent=1.0)
    >>> Breakage(strength=sand, smallest_diameter=2.5e-4).fragments
    14
    """

    strength: Strength
    smallest_diameter: float  # of a grain that may break: finer ones never do [m]
    criterion: Literal["largest_force", "octahedral_stress"] = "largest_force"
    fragments: int = 14
    growth_stages: int = 5  # from touching fragments to all the mass; 0 for all of it at once
    per_round: Literal["all", "one"] = "all"  # overloaded grains that break before the next rest
    # Whether a strain step that overloads a grain is kept, or taken back to where the first breaks.
    stepping: Literal["strain_step", "events"] = "strain_step"
    largest_grains: int = 20_000  # the run ends validly before there are more
    largest_mean_stress: float | None = None  # at which it ends validly [Pa]
    step_tolerance: float = 1.0e-2  # unbalanced force ratio at which grains are judged [-]
    event_tolerance: float = 1.0e-2  # by which the first grain may exceed its strength [-]

    @property
    def growth(self) -> list[float]:
        """By how much fragments have grown in each stage, from those that touch [-]."""
        return growth(self.fragments, self.growth_stages)

    @property
    def finest_diameter(self) -> float:
        """Of the finest grain there can be, a fragment of one at the limit [m]."""
        finest = float(packed_spheres(self.fragments)[-1, 3]) * self.growth[-1]
        return finest * self.smallest_diameter
