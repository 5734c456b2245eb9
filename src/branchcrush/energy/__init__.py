"""The elastic energy of branches and grains: how it is divided, and what it depends on.

`split`
    `energy_split` makes the energy-split function f(l) of binned energies, `cubic_r_squared` the
    paper's Fig. 6. The exponent itself is fitted in `statistics.power_law`.
`predictors`, `designs`
    `PREDICTORS` holds the mean energies of a branch as functions of its two radii, with the look of
    each in figures. `compared_predictors` fits them all and judges each on seeds left out.
`curvature`, `local_exponents`, `estimators`
    `curvature` says how far the energies are from a power law of branch length, `local_exponents`
    what its exponent is along the length, and `binned_estimators` what other fits make of n.
`radius_ratio`
    `radius_ratio_table`: the energy by the ratio of the radii, at equal length.
`fit`, `state_fit`
    `EnergySplitFit` and its parts are what is known of the energy split of a sample: the types
    behind `energy_split.json`.
`shielding`, `shielding_branches`, `shielding_grains`
    The paper's claim that energies vanish where a grain is far larger than its neighbours, and what
    answers it: `branch_shielding` by the ratio of the two radii, `grain_shielding` by a grain's
    radius over its neighbours'.
`grain_size`
    `grain_energy_exponents`: how the energy of a grain goes with its radius, as Einav's split does.

A new predictor is an entry of `PREDICTORS`: its design, a label, a colour and a marker. All tables
and figures then have it.
"""
