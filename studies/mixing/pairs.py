"""The mixtures of the study, as its config.yaml has them: pairs of gradings, laws and C.

A sample is called <pair>-<law>-C<1000 C>, and a mixture has its ultimate grading last.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from branchcrush.config.build import grading_of
from branchcrush.config.checks import checked_study
from branchcrush.config.file import config_file_content
from branchcrush.gradings.distribution import Grading
from branchcrush.packings.contact_laws import HertzContact, LinearContact, contact_law

STUDY = Path(__file__).parent
NAME = re.compile(r"(?P<pair>\w+)-(?P<law>linear|hertz)-C(?P<crushing>\d{4})")


@dataclass(frozen=True)
class Sample:
    """One mixture."""

    name: str
    crushing: float  # C, share of the mass that is of the ultimate grading [-]
    settings: Mapping[str, Any]  # of `config.schema.Sample.settings`

    @property
    def grading(self) -> Grading:
        """The grading of the mixture."""
        return grading_of(self.settings["grading"])


@dataclass(frozen=True)
class Pair:
    """The mixtures of two gradings, with one contact law."""

    name: str
    law: str
    samples: tuple[Sample, ...]  # C from 0 up

    @property
    def contact(self) -> LinearContact | HertzContact:
        """The contact law."""
        return contact_law(**self.samples[0].settings["contact"])

    @property
    def energy_exponent(self) -> float:
        """A of Psi ~ eps_e^a: 2 with linear contacts, 5/2 with Hertz's [-]."""
        return self.contact.exponent + 1.0

    @property
    def initial(self) -> Grading:
        """The grading at C = 0."""
        return self.samples[0].grading

    @property
    def ultimate(self) -> Grading:
        """The grading at C = 1, whether it was packed or not."""
        last = self.samples[-1].settings["grading"]
        return grading_of(last["components"][-1]["grading"] if "components" in last else last)

    @property
    def held_out(self) -> bool:
        """Whether its predictions were written down before it was packed."""
        return self.name.startswith("held")


def study_pairs(folder: Path = STUDY) -> list[Pair]:
    """Return the pairs of the study, in the order of its configuration.

    Parameters
    ----------
    folder : Path
        Of the config.yaml.

    Returns
    -------
    list of Pair
    """
    config = checked_study(config_file_content(folder / "config.yaml"), folder, few_grains=True)
    found: dict[tuple[str, str], list[Sample]] = {}
    for name, sample in config.samples.items():
        parts = NAME.fullmatch(name)
        if parts is None:
            raise SystemExit(
                f"error: a sample of this study is called like mix-linear-C0125: {name}"
            )
        crushing = int(parts["crushing"]) / 1000.0
        found.setdefault((parts["pair"], parts["law"]), []).append(
            Sample(name, crushing, sample.settings())
        )
    return [
        Pair(name, law, tuple(sorted(samples, key=lambda sample: sample.crushing)))
        for (name, law), samples in found.items()
    ]
