"""The page of what a laboratory measured: breakage, and the fitted resistance to crushing."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from jinja2 import Template

from branchcrush import __version__


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


def render_measured(template: Template, materials: Sequence[MeasuredPage]) -> str:
    """Return the page of measured materials as one HTML page with its figures inside.

    Parameters
    ----------
    template : Template
        From `study.templates.page_template`.
    materials : list of MeasuredPage

    Returns
    -------
    str

    Examples
    --------
    >>> render_measured(Template("{{ materials | length }} materials"), [])
    '0 materials'
    """
    return template.render(materials=materials, version=__version__)
