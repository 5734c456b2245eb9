"""Distributions of grain radius: what they are, how grains are drawn, what a number stands for.

All radii are in metres. A grading is one and the same whether it was given by number, as a
simulation counts, or by mass, as a sieve weighs.

`distribution.Grading`
    The one type that every form returns: densities, moments, means over the grains; its
    cumulative curves and quantiles are those of `cumulative.CumulativeCurves`, held on the
    `panels` of log R.
`forms`, `mixtures`, `tables`
    How a grading is made: by a formula, of single sizes or of other gradings, from a sieve curve
    or a density at a few radii. `truncation` cuts any density at two radii.
`sampling.sampled_radii`
    The radii of N grains, at random or at the quantiles.
`curves`
    What is read off a grading: diameters such as D50, its summary and its table beside the grains
    drawn.
`representativity`, `narrower`
    Whether N grains can stand for a grading, how near the drawn ones come to it, and which narrower
    range they could stand for.
`size_fits`
    Lognormal and Weibull curves through a few sizes, such as D10, D50 and D90.

A new form is a function of `forms` that returns `truncated(density, ...)`, its entry in
`config.build.FORMS`, and its section in `config.gradings`; the tests of
`tests/unit/gradings/test_distribution.py` then hold for it when it is listed there.
"""
