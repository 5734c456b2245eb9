"""The paper's claim of shielding, and how an interval answers it.

The paper says that energies vanish for a grain more than ten times as large as its neighbours;
energy split functions of branch length cannot say it. Branches and grains are counted for it in
`energy.shielding_branches` and `energy.shielding_grains`.
"""

from branchcrush.statistics.intervals import Interval

# The claim: an order of magnitude larger, and the energy vanishes: an order of magnitude less.
LARGER = 10.0
VANISHED = 0.1
# Radii of 0.1 and 1 have a ratio of 10 but for rounding: what is on an edge counts as beyond it.
ROUNDING = 1e-9


def claim_answer(ratio: Interval, number: int, fewest: int, kind: str) -> str:
    """Return what the energy of the largest ratios, over that of the others, says of the claim.

    Parameters
    ----------
    ratio : Interval
        Of the energies [-]; nan limits, as with one seed, decide nothing.
    number : int
        Of the grains or branches that are as unequal as the claim says.
    fewest : int
        Fewer than so many decide nothing.
    kind : str
        What they are, as `grain`.

    Returns
    -------
    str
        supported when all of the interval is below 0.1, contradicted when all of it is above,
        undecided between; no such <kind> where there is none.

    Examples
    --------
    >>> claim_answer(Interval(0.05, 0.01, 0.09), 12, 10, "grain")
    'supported'
    >>> claim_answer(Interval(0.05, 0.01, 0.09), 9, 10, "grain")
    'undecided'
    """
    if not number:
        return f"no such {kind}"
    if number < fewest:
        return "undecided"
    if ratio.high < VANISHED:
        return "supported"
    return "contradicted" if ratio.low > VANISHED else "undecided"
