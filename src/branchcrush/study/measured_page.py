"""The page of what a laboratory measured: breakage, and the fitted resistance to crushing."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from branchcrush import __version__
from branchcrush.study.pages import page_environment


@dataclass(frozen=True)
class MeasuredPage:
    """What the page shows of a material.

    Parameters
    ----------
    name : str
    breakage : mapping
        `breakage.json`.
    gradings : path-like
        Figure of the gradings.
    compression : mapping, optional
        `compression.json`; None without a compression curve.
    curve : path-like, optional
        Figure of the compression curve.
    """

    name: str
    breakage: Mapping[str, Any]
    gradings: Any
    compression: Mapping[str, Any] | None = None
    curve: Any = None


def render_measured(template: str, materials: Sequence[MeasuredPage]) -> str:
    """Return the page of measured materials as one HTML page with its figures inside.

    Parameters
    ----------
    template : str
        Jinja source.
    materials : list of MeasuredPage

    Returns
    -------
    str

    Examples
    --------
    >>> render_measured("{{ materials | length }} materials", [])
    '0 materials'
    """
    page = page_environment().from_string(template)
    return page.render(materials=materials, version=__version__)
