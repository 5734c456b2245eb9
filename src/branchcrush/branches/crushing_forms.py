"""The forms of the crushing model for two gradings: what each says of the energy and phi_J."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from branchcrush.branches.mixing import MixingPath
from branchcrush.branches.nodes import grading_nodes
from branchcrush.branches.random_contacts import random_contact_moment
from branchcrush.crushing.curves import Curve, LinearCurve, PairCurve, PorosityCurve, TabulatedCurve
from branchcrush.crushing.forms import ModelForm
from branchcrush.gradings.distribution import Grading

# What pages and figures call each, in the order in which they are shown.
FORM_LABELS: Mapping[str, str] = MappingProxyType(
    {
        "moving_jamming": "moving jamming point",
        "paper": "paper, no branch density",
        "density": "paper with branch density",
        "measured_contacts": "branch density, measured contacts",
        "einav": "Einav, breakage",
        "tengattini": "Tengattini, limiting densities",
    }
)
# Largest over smallest size up to which the forms were compared with packings.
TESTED_RATIO = 20.0
# Where the limiting density meets that of the rod map, and how much of the porosity must be gone
# there: else nearly all of it would go at once at C = 1.
_HALF, _LEAST_FALL = 0.5, 0.01


def crushing_forms(
    path: MixingPath,
    initial: Grading,
    ultimate: Grading,
    exponent: float,
    contacts: Callable[[NDArray], NDArray] | None = None,
) -> dict[str, ModelForm]:
    r"""Return every form of the crushing model for a pair of gradings.

    .. math:: g_{\mathrm{moving}} = \frac{H(C)}{H(0)}, \quad j = \frac{\phi_J(C)}{\phi_J(0)};
        \qquad g_{\mathrm{paper}} = 1 - \theta C, \quad
        \theta = 1 - \frac{\langle l^n \rangle_u}{\langle l^n \rangle_0}

    .. math:: g_{\mathrm{density}} = \frac{[\rho \langle l^n \rangle]_C}
        {[\rho \langle l^n \rangle]_0}; \qquad
        g_{\mathrm{Einav}} = 1 - C \left(1 -
        \frac{\langle D^2 \rangle_u}{\langle D^2 \rangle_0}\right), \quad
        j_{\mathrm{Tengattini}} = \frac{1 - n_0 (1 - C)^u}{1 - n_0}

    With branch density the gradings are mixed by mass and pairs of one grain of either counted.
    Einav's means are by mass. Tengattini's u has no rule of its own: it is taken so that the
    solid fraction at C = 1/2 is that of the path. Where the porosity falls by less than a
    hundredth up to there no such power means anything, and the form is left out.

    Parameters
    ----------
    path : MixingPath
        From the initial to the ultimate grading.
    initial, ultimate : Grading
    exponent : float
        n, of the energy of a branch in its length [-].
    contacts : callable, optional
        c(R), takes radii [m] and returns contact numbers [-]: without it there is no form with
        measured contacts.

    Returns
    -------
    dict of ModelForm
        By the names of `FORM_LABELS`, in their order.

    Examples
    --------
    >>> from branchcrush.branches.mixing import mixing_path
    >>> from branchcrush.gradings.forms import fractal, uniform
    >>> from branchcrush.packings.contact_laws import LinearContact
    >>> pair = uniform(0.5e-3, 1e-3), fractal(0.1e-3, 1e-3, 2.6)
    >>> path = mixing_path(*pair, LinearContact(1e6), crushing=np.array([0.0, 0.5, 1.0]))
    >>> forms = crushing_forms(path, *pair, exponent=3.0)
    >>> {name: round(float(form.factor.value(1.0)), 2) for name, form in forms.items()}
    {'moving_jamming': 4.9, 'paper': 0.01, 'density': 0.68, 'einav': 0.39, 'tengattini': 0.39}

    References
    ----------
    Paper, Eqs. 3, 4, 7 and 15; Einav (2007), J. Mech. Phys. Solids 55, 1274; Tengattini, Das and
    Einav (2016), Geotechnique 66, 695, doi 10.1680/jgeot.14.P.164.
    """
    known = tuple(path.crushing.tolist())
    moving = ModelForm(
        TabulatedCurve(known, tuple(path.modulus.tolist())),
        TabulatedCurve(known, tuple(path.solid_fraction.tolist())),
    )
    moments = [
        random_contact_moment(initial, exponent),
        random_contact_moment(initial, exponent, ultimate),
        random_contact_moment(ultimate, exponent),
    ]
    finer = initial.moment(3) / ultimate.moment(3)
    einav = LinearCurve(1.0 - _mean_square(ultimate) / _mean_square(initial))
    forms = {
        "moving_jamming": moving,
        "paper": ModelForm(LinearCurve(1.0 - moments[2] / moments[0])),
        "density": ModelForm(PairCurve(finer, moments[1] / moments[0], moments[2] / moments[0])),
        "einav": ModelForm(einav),
    }
    limiting = _limiting_density(moving.jamming, path)
    if limiting is not None:
        forms["tengattini"] = ModelForm(einav, limiting)
    if contacts is not None:
        measured = _with_contacts(initial, ultimate, exponent, contacts, finer)
        forms["measured_contacts"] = ModelForm(measured)
    return {name: forms[name] for name in FORM_LABELS if name in forms}


def _mean_square(grading: Grading) -> float:
    """Return the mean by mass of R^2."""
    return grading.moment(5) / grading.moment(3)


def _limiting_density(jamming: Curve, path: MixingPath) -> PorosityCurve | None:
    """Return the power law of the porosity that meets the path at C = 1/2, if it falls."""
    porosity = 1.0 - float(path.solid_fraction[0])
    half = 1.0 - float(path.solid_fraction[0] * jamming.value(_HALF))
    if half > (1.0 - _LEAST_FALL) * porosity:
        return None
    power = np.log(half / porosity) / np.log(1.0 - _HALF)
    return PorosityCurve(porosity, float(power))


def _with_contacts(
    initial: Grading,
    ultimate: Grading,
    exponent: float,
    contacts: Callable[[NDArray], NDArray],
    finer: float,
) -> PairCurve:
    """Return the density form when ends of branches are drawn by the contacts of their grains."""
    parts = []
    for grading in (initial, ultimate):
        radius, share = grading_nodes(grading)
        ends = share * contacts(radius)
        parts.append((radius, ends / ends.sum(), ends.sum() / share.sum()))
    (coarse, by_coarse, kappa), (fine, by_fine, kappa_fine) = parts

    def energy(first: NDArray, of_first: NDArray, second: NDArray, of_second: NDArray) -> float:
        return float(of_first @ (first[:, None] + second) ** exponent @ of_second)

    alone = energy(coarse, by_coarse, coarse, by_coarse)
    return PairCurve(
        finer * kappa_fine / kappa,
        energy(coarse, by_coarse, fine, by_fine) / alone,
        energy(fine, by_fine, fine, by_fine) / alone,
    )
