"""Particle crushing seen through branch lengths: pack, compress, and split the elastic energy.

The package holds the science; the Snakefile beside it holds the study.

>>> import branchcrush
>>> branchcrush.__version__.count(".")
2
"""

__version__ = "0.1.0"
