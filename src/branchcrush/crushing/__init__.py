"""The crushing model of the paper: what crushing costs, releases and dissipates.

`elasticity`
    `Elasticity` is what the model needs of a material: pressure and energy of the strain.
    `PowerLawElasticity` is one, and `fit_elasticity` takes it from a measured loading path.
`model`
    `theta` says which share of the elastic energy complete crushing releases, from the moments of
    the branch lengths; `admissibility_problem` says why there is none.
`law`
    `CrushingLaw` has the free energy, the driving force and the resistance for a parameter C.
`path`
    `crushing_path` follows C, stress and energies along any strain path, `CrushingPath`.

Another material is another class with the methods of `Elasticity`. Another form of the split is
another pair of moments for `theta`. Another resistance is a change of `CrushingLaw` alone: its
`resistance`, `equilibrium_crushing` and `dissipated_energy` belong together.

Compression is positive, energies are per reference volume [J/m3 = Pa]. This room knows neither
gradings nor files.
"""
