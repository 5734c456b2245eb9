"""Grains that break: how strong they are, what they feel, and what they break into.

Arrays and numbers only: `lammps.crushing` asks this room which grains of a packing at rest are
overloaded, and puts in their place the fragments that it is told here.
"""
