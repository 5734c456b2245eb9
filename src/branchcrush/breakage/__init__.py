"""Grains that break: how strong they are, what they feel, and what they break into.

Arrays and numbers only: `lammps.crushing` asks this room which grains of a packing at rest are
overloaded, and puts in their place the fragments that it is told here (`docs/breakage.md`).

- `rules.Breakage` is what a sample asks for.
- `strength` is Weibull's distribution with the effect of size, drawn by descent.
- `criterion.CRITERIA` are the stresses that are held against a strength.
- `fragments` are the spheres that a grain breaks into, and how they grow.
- `grains.Grains` are all that there are; `grains.exchange` puts fragments in the place of some.
- `shares` are grains that break as shares of mass, by size and strength, for
  `branches.crushing_gradings`.
- `account.Account` books where the work goes.

A newcomer adds a criterion as an entry of `CRITERIA`, in `rules.Breakage` and in `config.breakage`.
"""
