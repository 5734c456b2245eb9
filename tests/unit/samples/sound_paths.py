"""Paths of sound states, for the tests of the certificate and the verdict."""

import numpy as np
import pandas as pd

STRESS, WORK = 1e6, 2.0


def path_of(legs="lll", loaded=(False, True, True), **columns):
    """Return a `path.csv` of sound states; l is a loading state, u an unloading one."""
    states, loaded = len(legs), np.array(loaded)
    table = {
        "state": range(states),
        "leg": ["loading" if leg == "l" else "unloading" for leg in legs],
        "solid_fraction": 0.6 + 0.02 * np.arange(states),
        "mean_stress_Pa": np.where(loaded, STRESS, 0.0),
        "boundary_stress_Pa": np.where(loaded, STRESS, 0.0),
        "work_J": np.where(loaded, WORK, 0.0),
        "dissipated_J": np.where(loaded, WORK / 10, 0.0),
        "rattler_fraction": 0.1,
        "carries_load": loaded,
        "unbalanced_force_ratio": 1e-8,
        # Without stress it has no meaning.
        "inertial_number": np.where(loaded, 1e-7, np.nan),
        "median_overlap_ratio": 0.01,
        "overlap_ratio_95": 0.02,
        "max_overlap_ratio": 0.03,
        "contact_law_error": 1e-15,
        "escaped": 0,
        "lost": 0,
        "force_evaluations": 1000 * np.arange(states),
        # As read from a CSV file: an empty cell is nan.
        "stopped": np.nan,
    }
    return pd.DataFrame(table).assign(**columns)
