"""What tells the samples of a study apart where they are put beside each other."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class SampleKind:
    """The boundary, the contact law and the grading of a sample, as its configuration names them.

    Examples
    --------
    >>> settings = {"boundary": "walls", "contact": {"law": "hertz"}, "grading": {"form": "single"}}
    >>> SampleKind.of(settings).law
    'hertz'
    """

    boundary: Literal["walls", "periodic"]
    law: str  # a name in `packings.contact_laws.CONTACT_LAWS`
    grading: Mapping  # the section: samples of one grading have equal ones

    @classmethod
    def of(cls, settings: Mapping) -> "SampleKind":
        """Return the kind of a sample from its plain settings."""
        return cls(settings["boundary"], settings["contact"]["law"], settings["grading"])
