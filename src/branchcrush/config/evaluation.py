"""The configuration of what is made of the packings: energy split, crushing model, figures."""

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


class Thermodynamics(Section):
    """The crushing model."""

    ultimate_alpha: number(above=0, below=3) = Field(
        2.6, description="Fractal dimension of the ultimate grading, on the sample's sizes [-]."
    )
    critical_energy: number(above=0, most=1e15, unit="J/m3") = Field(
        2.0e5, description="Energy per volume at which crushing begins, E_c0 [J/m3]."
    )
    hardening_exponent: number(above=0, most=100) = Field(
        2.0, description="Exponent s of the resistance to crushing, E_c0/(1 − C)^s [-]."
    )


class Figures(Section):
    """What the figures look like."""

    dpi: number(int, least=50, most=1200, unit="dots per inch") = Field(
        300, description="Resolution of the figures [dots per inch]."
    )
