"""Bins, regressions and confidence intervals; they know no grain.

Packings of different seeds are independent, branches of one packing are not. So every interval of
the package comes from drawing whole seeds with replacement.

`bins.binned_sums`
    Counts, lengths and energies in bins of length; sums of seeds add up.
`power_law`
    E = A l^n fitted to energies that are broad at every length, and the exponent of the binned
    energies of all seeds.
`gamma_regression`
    The same regression for any design, fitted to single branches; the score and information of
    each seed are kept, so an interval costs little more than the fit.
`intervals.Interval`
    An estimate with its limits, which names its own columns.
`resampling`
    `pooled_interval` makes an interval of a statistic of sums, `interval_of_refits` of refits.
    `Resampling` holds the random state of each kind of result.

A new result takes a state of its own in `Resampling`, at the end; a new statistic is a function
that `pooled_interval` is given.
"""
