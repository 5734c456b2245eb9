"""The configuration of what is made of the packings: energy split and figures."""

from pydantic import Field

from branchcrush.config.fields import Fraction, Section, number


class EnergySplit(Section):
    """How the energy-split function is binned and its exponent's interval found."""

    bins: number(int, least=3, most=200) = Field(
        20, description="Equal bins between the smallest and the largest diameter."
    )
    confidence: Fraction = Field(0.95, description="Confidence of every interval [-].")
    resamples: number(int, least=100, most=1_000_000) = Field(
        2000, description="Draws of the seeds, with replacement, for the intervals."
    )


class Figures(Section):
    """What the figures look like."""

    dpi: number(int, least=50, most=1200, unit="dots per inch") = Field(
        300, description="Resolution of the figures [dots per inch]."
    )
