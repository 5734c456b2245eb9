"""What the forms of the crushing model say of the mixtures, from their gradings alone.

    python studies/mixing/predict.py

writes studies/mixing/predictions.csv. It reads config.yaml and no packing: the held-out pairs were
packed after the file was committed.
"""

import numpy as np
from pairs import STUDY, Pair, study_pairs

from branchcrush.branches.coordination import ISOSTATIC
from branchcrush.branches.crushing_forms import crushing_forms
from branchcrush.branches.mixing import MixingPath, mixing_path
from branchcrush.energy.split import PAPER_EXPONENT
from branchcrush.errors import FitError
from branchcrush.files.tables import provenance, write_table

PREDICTIONS = STUDY / "predictions.csv"
# The default form by its other network, and the name that it has in tables.
BY_PARKING = "moving_jamming_parking"


def main() -> None:
    """Write the table."""
    rows = [row for pair in study_pairs() for row in predicted(pair)]
    write_table(PREDICTIONS, rows, provenance(exponent=PAPER_EXPONENT))


def predicted(pair: Pair) -> list[dict]:
    """Return a row for each mixture of a pair and each form."""
    known = {sample.crushing for sample in pair.samples}
    # The limiting density of one form is set at 1/2.
    crushing = np.array(sorted(known | {0.0, 0.5, 1.0}))
    path = mixing_path(pair.initial, pair.ultimate, pair.contact, crushing=crushing)
    forms = crushing_forms(path, pair.initial, pair.ultimate, PAPER_EXPONENT)
    alone, rows = _parking(pair, 0.0), []
    for sample in pair.samples:
        for name, form in forms.items():
            factor = float(form.factor.value(sample.crushing))
            jamming = float(form.jamming.value(sample.crushing))
            rows.append(_row(pair, sample, name, factor, jamming))
            if name == "moving_jamming":
                rows[-1] |= _network(path, int(np.searchsorted(crushing, sample.crushing)))
        parking = _parking(pair, sample.crushing) if sample.crushing else alone
        if parking is None or alone is None:
            rows.append(_row(pair, sample, BY_PARKING, np.nan, np.nan))
            continue
        factor = float(parking.modulus[0] / alone.modulus[0])
        jamming = float(parking.solid_fraction[0] / alone.solid_fraction[0])
        rows.append(_row(pair, sample, BY_PARKING, factor, jamming) | _network(parking, 0))
    return rows


def _row(pair, sample, form, factor, jamming):
    """Return what a form says: g, the same energy and stress over those at C = 0, and j."""
    return {
        "sample": sample.name,
        "pair": pair.name,
        "law": pair.law,
        "crushing": sample.crushing,
        "form": form,
        "stiffness_ratio": factor,
        # At one strain from jamming the energy and the stress change by g; at one stress of a
        # power law p_0 ~ eps^(a-1) the energy by g^(-1/(a-1)).
        "energy_ratio_at_equal_stress": factor ** (-1.0 / (pair.energy_exponent - 1.0)),
        "jamming_ratio": jamming,
    }


def _parking(pair: Pair, crushing: float) -> MixingPath | None:
    """Return the network of one mixture by random parking, None where it has no solution."""
    try:
        return mixing_path(
            pair.initial,
            pair.ultimate,
            pair.contact,
            network="parking",
            crushing=np.array([crushing]),
        )
    except FitError:
        return None


def _network(path: MixingPath, place: int) -> dict:
    """Return who carries load at jamming, and with how many contacts."""
    bearing = float(path.bearing_number[place])
    return {
        "jamming_solid_fraction": float(path.solid_fraction[place]),
        "coordination_number": ISOSTATIC * bearing,
        "rattler_fraction": 1.0 - bearing,
        "bearing_mass": float(path.bearing_mass[place]),
        "finest_bearing_m": float(path.finest[place]),
    }


if __name__ == "__main__":
    main()
