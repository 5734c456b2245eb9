"""Where the work goes while grains break: what is stored, and what each kind of event takes."""

from dataclasses import asdict, dataclass


@dataclass
class Account:
    r"""Energies of a run, each counted from its beginning.

    .. math:: W = E + D_b + D_r

    E is stored in the contacts. D_b is what rounds of breakage take, in a cell that keeps still:
    what is stored at rest before, less what is stored at rest after. D_r is what rearrangement
    takes while the cell is strained. What a round takes needs no account of what happens within it:
    the energy that growing fragments put in is metered and never added.

    A strain step of finite size takes more work than infinitely many small ones between the same
    two packings at rest, and this excess is lost while they come to rest. It is part of D_r, and
    vanishes with the strain step.

    Examples
    --------
    >>> account = Account(stored=1.0)
    >>> account.strained(work=3.0, after=2.5, quasi_static=2.75)
    >>> account.broken(after=1.0, parents=0.5, exchanged=0.25, put_in=7.0)
    >>> account.rearrangement, account.breakage, account.avalanches
    (1.5, 1.5, 1.0)
    >>> account.work - account.stored - account.breakage - account.rearrangement
    0.0
    >>> account.step_excess
    0.25
    """

    stored: float = 0.0  # E, of the packing at rest [J]
    work: float = 0.0  # W, what was stored at the beginning included [J]
    breakage: float = 0.0  # D_b [J]
    parents: float = 0.0  # of it, what was stored in the contacts of grains that broke [J]
    rearrangement: float = 0.0  # D_r [J]
    step_excess: float = 0.0  # of it, what the finite size of the strain steps takes [J]
    exchanged: float = 0.0  # taken out by putting fragments in the place of grains [J]
    growth: float = 0.0  # put in by growing fragments [J]
    rounds: int = 0  # of breakage
    breakages: int = 0
    rounds_upwards: int = 0  # after which more was stored than before
    largest_rise: float = 0.0  # of those, over what was stored [-]

    def __post_init__(self) -> None:
        if self.work == 0.0:
            self.work = self.stored

    @property
    def avalanches(self) -> float:
        """What rounds of breakage took beside what their grains' own contacts held [J]."""
        return self.breakage - self.parents

    def strained(self, work: float, after: float, quasi_static: float) -> None:
        """Book a strain step: its work, what is stored after it, and its quasi-static work [J].

        The last one is that of the stresses at rest before and after it.
        """
        self.rearrangement += self.stored + work - after
        self.step_excess += work - quasi_static
        self.work += work
        self.stored = after

    def relaxed(self, after: float) -> None:
        """Book a relaxation in a cell that keeps still: what is stored after it [J]."""
        self.strained(0.0, after, quasi_static=0.0)

    def broken(
        self,
        after: float,
        *,
        parents: float,
        exchanged: float,
        put_in: float,
        breakages: int = 1,
    ) -> None:
        """Book a round: stored after it, held by grains that broke, taken out and put in [J]."""
        rise = after - self.stored
        if rise > 0.0:
            self.rounds_upwards += 1
            self.largest_rise = max(self.largest_rise, rise / self.stored)
        self.breakage -= rise
        self.parents += parents
        self.exchanged += exchanged
        self.growth += put_in
        self.rounds += 1
        self.breakages += breakages
        self.stored = after

    def plain(self) -> dict[str, float]:
        """Return all of it by name."""
        return asdict(self)
