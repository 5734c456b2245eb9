"""A row for each sample: `comparison.csv`."""


def comparison_row(name, fit, model, certificate):
    """Return the row of `comparison.csv` of a sample.

    Parameters
    ----------
    name : str
    fit, model, certificate : dict
        `energy_split.json`, `thermodynamics.json` and `certificate.json`.

    Returns
    -------
    dict
        Empty where a sample has no data; `reason` then says why.
    """
    return {
        "sample": name,
        "verdict": certificate["verdict"],
        "exponent": fit.get("exponent"),
        "exponent_low": fit.get("exponent_low"),
        "exponent_high": fit.get("exponent_high"),
        "confidence": fit.get("confidence"),
        "seeds": certificate["seeds"],
        "seeds_certified": certificate["seeds_certified"],
        "branches": fit.get("branches"),
        "solid_fraction": fit.get("solid_fraction"),
        "jamming_solid_fraction": certificate["jamming_solid_fraction"],
        "jamming_scatter_of_seeds": certificate["jamming_solid_fraction_scatter"],
        "jamming_uncertainty_of_one": certificate["jamming_uncertainty"],
        "mean_stress_Pa": fit.get("mean_stress_Pa"),
        "elastic_energy_J_per_m3": fit.get("elastic_energy_J_per_m3"),
        "median_overlap_over_length": fit.get("median_overlap_over_length"),
        "coordination_number": fit.get("coordination_number"),
        "mechanical_coordination_number": fit.get("mechanical_coordination_number"),
        "rattler_fraction": fit.get("rattler_fraction"),
        "dissipated_share": certificate["dissipated_share_at_end"],
        "theta": model.get("theta"),
        "force_evaluations": certificate["force_evaluations"],
        "reason": fit.get("reason") or model.get("reason"),
    }
