"""What rods that push say of a sample along its loading, from the grading and the strain alone."""

import numpy as np
import pandas as pd

from branchcrush.branches.load_bearing import compressed_coordination
from branchcrush.branches.nodes import grading_nodes
from branchcrush.errors import FitError
from branchcrush.gradings.distribution import Grading


def rods_along_path(grading: Grading, path: pd.DataFrame) -> pd.DataFrame:
    r"""Return the coordination number and the rattlers in each state, by rods that push.

    .. math:: \epsilon = \frac{\phi - \phi_J}{\phi}

    The strain is counted from the measured jamming point; the map's own is another one between
    walls.

    Parameters
    ----------
    grading : Grading
        Target.
    path : DataFrame
        From `samples.ensemble.mean_path`.

    Returns
    -------
    DataFrame
        A row for each state: state, rods_coordination_number and rods_rattler_fraction; nan where
        phi_J is not known, or the grading carries no load by rods.

    Examples
    --------
    >>> from branchcrush.gradings.mixtures import single
    >>> path = pd.DataFrame({"state": [3], "solid_fraction": 0.66})
    >>> rods_along_path(single(1.0), path.assign(solid_fraction_above_jamming=0.02)).round(2)
       state  rods_coordination_number  rods_rattler_fraction
    0      3                      6.78                   0.05
    """
    radius, share = grading_nodes(grading)
    strains = path["solid_fraction_above_jamming"] / path["solid_fraction"]
    rows = []
    for strain in strains:
        kappa = rattlers = float("nan")
        try:
            # A state just below the mean jamming point is at it.
            (contacts, bearing), _ = compressed_coordination(radius, share, max(strain, 0.0))
            kappa, rattlers = float(share @ contacts), float(1.0 - share @ bearing)
        except (FitError, ValueError):
            pass
        rows.append((kappa, rattlers))
    kappa, rattlers = np.reshape(rows, (-1, 2)).T
    return pd.DataFrame(
        {
            "state": path["state"].to_numpy(),
            "rods_coordination_number": kappa,
            "rods_rattler_fraction": rattlers,
        }
    )
