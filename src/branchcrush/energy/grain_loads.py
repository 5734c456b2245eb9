"""What each grain bears in one state: contacts, forces and energies, and what predictors say."""

import numpy as np
from numpy.typing import NDArray

from branchcrush.energy.designs import prepared
from branchcrush.energy.predictors import PREDICTORS, branch_columns
from branchcrush.energy.split import PAPER_EXPONENT
from branchcrush.errors import FitError
from branchcrush.packings.network import Network
from branchcrush.statistics.gamma_regression import fitted_parameters

# Names of the loads that predictors give begin so.
PREDICTED = "predicted_"


def grain_loads(network: Network) -> dict[str, NDArray]:
    r"""Return numbers that each grain of a network has, and that one could foretell breaking by.

    .. math:: E_g = \tfrac{1}{2} \sum_{b \ni g} E_b

    The same sum of :math:`l^3` is what the paper's split gives the branches of a grain, up to a
    factor that all grains of the state share.

    Parameters
    ----------
    network : Network

    Returns
    -------
    dict of ndarray, each of shape (N,)
        largest_force [N], contacts (walls' too), radius [m], mean_branch and longest_branch [m],
        energy [J], split_energy [m^3], share_smaller: the share of its contacts whose other grain
        is smaller [-]. All but the radius are 0 for a grain without contacts.

    Examples
    --------
    >>> none = np.empty(0)
    >>> one = np.ones(1)
    >>> network = Network(np.array([1.0, 2.0, 1.0]), np.array([0]), np.array([1]), one, 3 * one,
    ...                   8 * one, none.astype(int), none, none)
    >>> loads = grain_loads(network)
    >>> loads["energy"].tolist(), loads["share_smaller"].tolist(), loads["split_energy"].tolist()
    ([4.0, 4.0, 0.0], [0.0, 1.0, 0.0], [13.5, 13.5, 0.0])
    """
    grains, length = network.radius.size, network.length
    ends = np.concatenate([network.i, network.j])
    others = np.concatenate([network.j, network.i])

    def summed(values: NDArray) -> NDArray:
        return np.bincount(ends, np.tile(values, 2), minlength=grains)

    largest, longest = np.zeros(grains), np.zeros(grains)
    np.maximum.at(largest, ends, np.tile(network.force, 2))
    np.maximum.at(largest, network.wall_grain, network.wall_force)
    np.maximum.at(longest, ends, np.tile(length, 2))
    number = np.maximum(network.contacts, 1)
    smaller = (network.radius[others] < network.radius[ends]).astype(float)
    return {
        "largest_force": largest,
        "contacts": (network.contacts + network.wall_contacts).astype(float),
        "radius": network.radius,
        "mean_branch": summed(length) / number,
        "longest_branch": longest,
        "energy": summed(network.energy) / 2.0,
        "split_energy": summed(length**PAPER_EXPONENT) / 2.0,
        "share_smaller": np.bincount(ends, smaller, minlength=grains) / number,
    }


def predicted_loads(network: Network) -> dict[str, NDArray]:
    """Return the energy that each predictor, fitted to the state's branches, gives every grain.

    Half of each branch's, as for `grain_loads`. Branches that hold no energy have no part in the
    fit, and what the predictor gives them all the same counts.

    Parameters
    ----------
    network : Network

    Returns
    -------
    dict of ndarray, each of shape (N,)
        By the predictors' names after `PREDICTED` [J]; those that cannot be fitted are not there.
    """
    largest = network.radius.max()
    pair = network.radius_i, network.radius_j
    columns = branch_columns(*pair, network.energy, largest)
    every = branch_columns(*pair, np.ones(network.i.size), largest)
    found = {}
    for name, predictor in PREDICTORS.items():
        try:
            design, made = prepared(predictor.design, [columns])
            theta = fitted_parameters(made, design)
        except FitError:
            continue
        _, of_all = prepared(predictor.design, [every])
        energy = np.exp(design(theta, *of_all[0][:-1])[0]) / 2.0
        # Half of it to each of its two grains.
        ends, twice = np.concatenate([network.i, network.j]), np.tile(energy, 2)
        found[PREDICTED + name] = np.bincount(ends, twice, minlength=network.radius.size)
    return found
