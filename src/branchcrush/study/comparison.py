"""A row for each sample: `comparison.csv`."""

from collections.abc import Mapping
from typing import Any

from branchcrush.energy.fit import EnergySplitFit


def comparison_row(
    name: str, fit: EnergySplitFit, model: Mapping, certificate: Mapping
) -> dict[str, Any]:
    """Return the row of `comparison.csv` of a sample.

    Parameters
    ----------
    name : str
    fit : EnergySplitFit
        Read from `energy_split.json`.
    model, certificate : mapping
        `thermodynamics.json` and `certificate.json`.

    Returns
    -------
    dict
        The same keys for every sample; None or nan where it has no data; `reason` then says why.
    """
    packings = {} if fit.packings is None else fit.packings.result()
    return {
        "sample": name,
        "verdict": certificate["verdict"],
        "verdict_reasons": "; ".join(certificate["reasons"]) or None,
        **fit.exponent.named("exponent"),
        "confidence": fit.confidence,
        "seeds": certificate["seeds"],
        "seeds_certified": certificate["seeds_certified"],
        "branches": packings.get("branches"),
        "solid_fraction": packings.get("solid_fraction"),
        "jamming_solid_fraction": certificate["jamming_solid_fraction"],
        "jamming_scatter_of_seeds": certificate["jamming_solid_fraction_scatter"],
        "jamming_uncertainty_of_one": certificate["jamming_uncertainty"],
        "mean_stress_Pa": packings.get("mean_stress_Pa"),
        "elastic_energy_J_per_m3": packings.get("elastic_energy_J_per_m3"),
        "median_overlap_over_length": packings.get("median_overlap_over_length"),
        "coordination_number": packings.get("coordination_number"),
        "mechanical_coordination_number": packings.get("mechanical_coordination_number"),
        "rattler_fraction": packings.get("rattler_fraction"),
        "dissipated_share": certificate["dissipated_share_at_end"],
        "theta": model.get("theta"),
        "form": model.get("form"),
        "admissible": model.get("admissible"),
        "inadmissible_from": model.get("inadmissible_from"),
        "force_evaluations": certificate["force_evaluations"],
        "reason": fit.reason or model.get("reason") or model.get("form_reason"),
    }
