"""A sample of a study: its packings, its results, its energy split."""

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import pandas as pd

from branchcrush.energy.fit import EnergySplitFit
from branchcrush.errors import ResultsError
from branchcrush.files.dictionary import REFINED
from branchcrush.files.tables import stacked_tables
from branchcrush.results.packing import Packing
from branchcrush.results.place import Place


class Sample(Place):
    """A sample: its packings in `seeds`, its energy split in `fit`, and each result by its name.

    Taken from a study, as `study["sand"]`.
    """

    pattern = "<sample>/"

    @property
    def name(self) -> str:
        """Its name in config.yaml."""
        return str(self._words["sample"])

    @property
    def title(self) -> str:
        """How it is called in messages."""
        return f"sample {self.name}"

    @cached_property
    def settings(self) -> Mapping[str, Any]:
        """What its configuration says, as plain values: grading, boundary, contact, loading."""
        finished = self.package.provenance.get("samples", {})
        if self.name in finished or not self.seeds:
            return finished.get(self.name, {})
        return next(iter(self.seeds.values())).path.provenance.get("config", {})

    @cached_property
    def seeds(self) -> dict[int, Packing]:
        """Its packings by seed, those that are there."""
        numbers = (folder.name.removeprefix("seed_") for folder in self.folder.glob("seed_*"))
        return {
            number: Packing(self.package, sample=self.name, seed=number)
            for number in sorted(int(number) for number in numbers if number.isdecimal())
        }

    def seed(self, number: int) -> Packing:
        """Return the packing of a seed.

        Parameters
        ----------
        number : int

        Returns
        -------
        Packing

        Raises
        ------
        ResultsError
            When there is none.
        """
        if number not in self.seeds:
            known = ", ".join(map(str, self.seeds)) or "none"
            raise ResultsError(f"{self.title} has no seed {number}; there are: {known}")
        return self.seeds[number]

    @property
    def refined(self) -> "Sample | None":
        """Its first seeds run again with twice the strain steps; None where none are."""
        again = Sample(self.package, sample=self.name + REFINED)
        return again if again.folder.is_dir() else None

    @cached_property
    def fit(self) -> EnergySplitFit:
        """The energy split with n, its interval and predictors, of `energy_split.json`."""
        return EnergySplitFit.read(self.energy_split.summary)

    @cached_property
    def states(self) -> pd.DataFrame:
        """The saved states of all its packings: the rows of `path.csv`, with the seed of each."""
        return self._of_seeds({number: one.path.data for number, one in self.seeds.items()})

    @cached_property
    def branches(self) -> pd.DataFrame:
        """The branches at the end of the loading of all its packings, with the seed of each.

        To the columns of `contacts.parquet` comes `sum_of_radii_m`, R_i + R_j, which fits and bins
        take for the branch length.
        """
        table = self._of_seeds({number: one.end.contacts for number, one in self.seeds.items()})
        return table.assign(sum_of_radii_m=table["radius_i_m"] + table["radius_j_m"])

    def __repr__(self) -> str:
        lines = [f"{self.title}: {len(self.seeds)} packings in .seeds{_listed(self.seeds)}"]
        if self.certificate.exists:
            lines.append(f"  {self.certificate.summary['verdict']}")
        if self.energy_split.exists:
            fit = self.fit
            n = fit.exponent
            value = f"n = {n.estimate:.2f} ({n.low:.2f} to {n.high:.2f}) in .fit"
            lines.append(f"  {value if fit.reason is None else f'no energy split: {fit.reason}'}")
        there = ", ".join(name for name, one in self.results.items() if one.exists)
        lines.append(f"  results: {there or 'none'}")
        return "\n".join([*lines, *(f"  missing: {one}" for one in self.missing())])

    def _of_seeds(self, tables: Mapping[int, pd.DataFrame]) -> pd.DataFrame:
        if not tables:
            raise ResultsError(f"{self.title} has no packings yet: rule compression writes them")
        return stacked_tables(tables).rename(columns={"sample": "seed"})


def _listed(numbers):
    return f" ({', '.join(map(str, numbers))})" if len(numbers) <= 8 else ""
