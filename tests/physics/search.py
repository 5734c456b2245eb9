"""Contacts found anew: every pair of grains measured through every face of the cell."""

import itertools

import numpy as np

BOUNDARIES, LAWS = ("walls", "periodic"), ("linear", "hertz")
STIFFNESS = {"linear": 1.0e6, "hertz": 1.0e9}
FACES = [(axis, side, f"{'-+'[side]}{'xyz'[axis]}") for axis in range(3) for side in (0, 1)]


def contact_force(law, overlap, radius, other=np.inf):
    """Return F of an overlap; the reduced radius is 1/(1/R + 1/R'), with a wall R."""
    if law == "linear":
        return STIFFNESS[law] * overlap
    reduced = 1.0 / (1.0 / radius + 1.0 / other)
    return STIFFNESS[law] * np.sqrt(reduced) * overlap**1.5


class Search:
    """The contacts of one frame of the particle dump: overlap and force of each."""

    def __init__(self, frame, periodic, law):
        lower, upper = frame.bounds.T
        place, radius = frame.vectors("x", "y", "z"), frame.columns["radius"]
        self.law, self.net = law, np.zeros_like(place)
        self.pairs, self.walls, self.force, self.radius = {}, {}, {}, radius
        images = itertools.product((-1, 0, 1), repeat=3) if periodic else [(0, 0, 0)]
        for image in images:
            vector = place[:, None] - place[None, :] - np.array(image) * (upper - lower)
            distance = np.linalg.norm(vector, axis=-1)
            overlap = radius[:, None] + radius[None, :] - distance
            # Both orders of a pair are met: each once with its image and once with the opposite.
            for i, j in np.argwhere((overlap > 0) & ~np.eye(len(radius), dtype=bool)):
                force = contact_force(law, overlap[i, j], radius[i], radius[j])
                self.net[i] += force * vector[i, j] / distance[i, j]
                if i < j:
                    assert (i, j) not in self.pairs, "the cell is too small for one image a pair"
                    self.pairs[i, j], self.force[i, j] = overlap[i, j], force
        for axis, side, name in [] if periodic else FACES:
            gap = (place[:, axis] - lower[axis], upper[axis] - place[:, axis])[side]
            for i in np.flatnonzero(radius - gap > 0):
                force = contact_force(law, (radius - gap)[i], radius[i])
                self.net[i, axis] += force * (1, -1)[side]
                self.walls[i, name], self.force[i, name] = (radius - gap)[i], force

    def virial(self):
        """Return the sum of force times branch, or times the distance of the centre at a wall."""
        branch = {(i, j): self.radius[[i, j]].sum() - d for (i, j), d in self.pairs.items()}
        distance = {(i, wall): self.radius[i] - d for (i, wall), d in self.walls.items()}
        return sum(self.force[key] * length for key, length in {**branch, **distance}.items())

    def energies(self):
        """Return the integral of the force over the overlap of each contact."""
        exponent = {"linear": 1.0, "hertz": 1.5}[self.law]
        overlaps = {**self.pairs, **self.walls}
        return {key: self.force[key] * overlaps[key] / (exponent + 1.0) for key in overlaps}
