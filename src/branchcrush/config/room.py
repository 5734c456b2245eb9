"""Whether the grains of a sample find room: tried out as jobs do, before any job starts."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from branchcrush.errors import PackingError
from branchcrush.gradings.distribution import Grading
from branchcrush.gradings.sampling import sampled_radii
from branchcrush.loading.targets import Loading
from branchcrush.packings.geometry import cube_edge
from branchcrush.packings.placement import random_packing

# Below this solid fraction, and of grains so much smaller than the cell, none was ever without a
# place.
_SURE_FRACTION, _SURE_SHARE = 0.25, 0.7
# Of all seeds that are drawn, a second's work; of more grains so many stand for all of them.
_MOST_GRAINS, _SOME_GRAINS = 20_000, 5000


def room_problems(settings: Mapping[str, Any], grading: Grading, grains: int) -> list[str]:
    """Return whether grains do not fit into their cell, at the beginning or at the end.

    The first seeds, as many as hold 20 000 grains together, are drawn as their jobs draw them, and
    placed where it is not sure that they can be. Of more grains 5000 are tried without walls.

    Parameters
    ----------
    settings : mapping
        Of `config.schema.Sample.settings`.
    grading : Grading
    grains : int

    Returns
    -------
    list of str
        One line, or none; it begins with the key below the sample.

    Examples
    --------
    >>> from branchcrush.gradings.mixtures import single
    >>> settings = {"sampling": "random", "boundary": "walls", "initial_solid_fraction": 0.4,
    ...             "loading": {"target": "solid_fraction", "value": 0.6}, "seeds": [1]}
    >>> room_problems(settings, single(1e-3), 2)[0][:52]
    'initial_solid_fraction = 0.4: seed 1 finds no room, '
    """
    first, sampling = settings["initial_solid_fraction"], settings["sampling"]
    periodic, seeds = settings["boundary"] == "periodic", settings["seeds"]
    last = Loading(**settings["loading"]).end(first)
    many = grains > _MOST_GRAINS
    if many:
        grains, sampling, periodic = _SOME_GRAINS, "number_quantiles", True
    for seed in seeds[: 1 if many else max(1, _MOST_GRAINS // grains)]:
        rng = np.random.default_rng(seed)
        radii = sampled_radii(grading, grains, sampling, rng)
        largest, edge = 2.0 * float(np.max(radii)), cube_edge(radii, first)
        end = cube_edge(radii, last)
        if largest > end and not many:
            return [
                f"grains = {grains}: with seed {seed} the cell would end at an edge of {end:.3g} "
                f"m, smaller than its largest grain of {largest:.3g} m: use more grains or load "
                "less"
            ]
        if first <= _SURE_FRACTION and largest <= _SURE_SHARE * edge:
            continue
        if many and largest > _SURE_SHARE * edge:  # of a few grains, as all of them have not
            continue
        try:
            random_packing(radii, edge, periodic=periodic, rng=rng)
        except PackingError as error:
            return [f"initial_solid_fraction = {first:g}: seed {seed} finds no room, {error}"]
    return []
