"""What the rules have found of one sample, as the rules of all samples read it."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.files.tables import Table
from branchcrush.results.sample import Sample
from branchcrush.study.kinds import SampleKind

# In `certificate.json`: what is found of such a sample is shown, and counts for nothing.
NOT_CERTIFIED = "not certified"


@dataclass(frozen=True)
class SampleResults:
    """The results of a sample that are put beside those of others.

    Parameters
    ----------
    name : str
    kind : SampleKind
    fit : EnergySplitFit
        Read from `energy_split.json`.
    numbers : mapping
        `contact_numbers.json`.
    shared : mapping
        `sharing.json`.
    certificate : mapping
        `certificate.json`, of it at least the verdict and its reasons.
    path : DataFrame
        `energy_split_path.csv`.
    states : DataFrame
        `coordination.csv` of the sample.

    Examples
    --------
    >>> kind = SampleKind("walls", "linear", {"form": "single"})
    >>> nothing = {"reason": "no load"}
    >>> verdict = {"verdict": "not certified", "reasons": ["seed 1: stopped"]}
    >>> fit = EnergySplitFit.read(nothing)
    >>> loose = SampleResults("loose", kind, fit, nothing, nothing, verdict, 0, 0)
    >>> loose.reason, loose.is_certified
    ('no load', False)
    """

    name: str
    kind: SampleKind
    fit: EnergySplitFit
    numbers: Mapping
    shared: Mapping
    certificate: Mapping
    path: Table
    states: Table

    @classmethod
    def of(cls, sample: Sample, settings: Mapping[str, Any]) -> "SampleResults":
        """Return these results of a sample, read from its files.

        Parameters
        ----------
        sample : branchcrush.results.sample.Sample
        settings : mapping
            From `config.schema.Sample.settings`.

        Returns
        -------
        SampleResults
        """
        return cls(
            sample.name,
            SampleKind.of(settings),
            sample.fit,
            sample.contact_numbers.summary,
            sample.sharing.summary,
            sample.certificate.summary,
            sample.energy_split_path.data,
            sample.coordination.data,
        )

    @property
    def is_certified(self) -> bool:
        """Whether its certificate stands, with notes or without."""
        return self.certificate["verdict"] != NOT_CERTIFIED

    @property
    def reason(self) -> str | None:
        """Why something of the sample is not known: the first reason there is."""
        reasons = (self.fit.reason, self.numbers.get("reason"), self.shared.get("reason"))
        return next((reason for reason in reasons if reason), None)
