"""Which grains of a sample will carry load, before it runs: by rods that push."""

from typing import NamedTuple

from branchcrush.branches.load_bearing import LoadBearing, compressed_coordination, load_bearing
from branchcrush.branches.nodes import grading_nodes
from branchcrush.errors import FitError
from branchcrush.loading.sample import Sample

_WALLS = (
    "all this of a periodic cell: between walls they jam looser, so only ratios of that solid "
    "fraction are used, with the measured one"
)
_LOOSE = "the loading ends before that, perhaps without load"
_STRESSED = "how many at the end depends on how far the stresses compress them"
# This line does not read the configuration of the crushing model.
_BY = "(rods that push, whatever thermodynamics.network is)"


class Carrying(NamedTuple):
    """What rods that push say of a sample."""

    jammed: LoadBearing  # at the jamming point
    # Contacts of a grain at the end of the loading, rattlers counted; None where it cannot be told.
    at_end: float | None
    why: str  # why it cannot, else empty


def carrying(sample: Sample) -> Carrying | None:
    """Return which grains of a sample will carry load; None where no grain does.

    Parameters
    ----------
    sample : Sample

    Returns
    -------
    Carrying or None

    Examples
    --------
    >>> from branchcrush.gradings.mixtures import single
    >>> from branchcrush.loading.targets import Loading
    >>> from branchcrush.packings.contact_laws import LinearContact
    >>> sample = Sample(grading=single(1e-3), sampling="random", grains=1000, boundary="periodic",
    ...                 initial_solid_fraction=0.16, law=LinearContact(1e6), seeds=(1, 2),
    ...                 loading=Loading("solid_fraction", 0.7), strain_step=1.7e-3)
    >>> found = carrying(sample)
    >>> round(found.jammed.coordination_number, 2), round(found.at_end, 2)
    (5.71, 7.61)
    """
    radius, share = grading_nodes(sample.grading)
    try:
        jammed = load_bearing(radius, share)
        if not sample.periodic:
            return Carrying(jammed, None, _WALLS)
        if sample.loading.stresses:  # no solid fraction is known at their end
            return Carrying(jammed, None, _STRESSED)
        strain = 1.0 - jammed.solid_fraction / sample.end
        if strain < 0.0:
            return Carrying(jammed, None, _LOOSE)
        coordination, _ = compressed_coordination(radius, share, strain)
    except (FitError, ValueError):
        return None
    return Carrying(jammed, float(share @ coordination.contacts), "")


def carrying_words(found: Carrying | None, unit: str, metres: float) -> str:
    """Return which grains will carry load as a sentence for a person.

    Parameters
    ----------
    found : Carrying or None
        From `carrying`.
    unit : str
        That the user gives sizes in.
    metres : float
        What it is [m].

    Returns
    -------
    str

    Examples
    --------
    >>> carrying_words(Carrying(LoadBearing(0.721, 0.24, 0.93, 1.6e-4, 1.4), 2.9, ""), "mm", 1e-3)
    ... # doctest: +NORMALIZE_WHITESPACE
    'of your grains 24 % will carry load (by mass 93 %), the finest that do are 0.32 mm in diameter;
    they jam at a solid fraction of 0.721 with 1.4 contacts a grain, rattlers counted; 2.9 at the
    end of the loading (rods that push, whatever thermodynamics.network is)'
    """
    if found is None:
        return "not known: rods that push find no grain of this grading that does"
    jammed = found.jammed
    text = (
        f"of your grains {_percent(jammed.by_number)} % will carry load (by mass "
        f"{_percent(jammed.by_mass)} %), the finest that do are "
        f"{2.0 * jammed.finest / metres:.3g} {unit} in diameter; they jam at a solid fraction of "
        f"{jammed.solid_fraction:.3f} with {jammed.coordination_number:.2g} contacts a grain, "
        "rattlers counted; "
    )
    at_end = found.why or f"{found.at_end:.2g} at the end of the loading"
    return f"{text}{at_end} {_BY}"


def _percent(share: float) -> str:
    """Return a share to two digits, and one of almost nothing as that."""
    return f"{100.0 * share:.2g}" if share >= 1e-4 else "less than 0.01"
