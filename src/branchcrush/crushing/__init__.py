"""The crushing model: what crushing costs, releases and dissipates, in all its forms.

`elasticity`, `interpolated_elasticity`, `elastic_fits`
    `Elasticity` is what the model needs of a material: pressure and energy of the strain, in closed
    form or through what was measured.
`curves`, `forms`
    `ModelForm` is a form of the model, two functions of the crushing parameter C: by what factor
    the energy changes at equal elastic strain, and how the jamming point moves.
`resistance`, `yield_line`
    What holds crushing back, and the load at which each C yields.
`evolution`
    `evolve` follows C, stress and energies along any history of strain or stress.
`leaps`, `admissibility`
    What of a form cannot be, in sentences: crushing that costs energy, leaps, snaps, gaps.
`energy_ratios`, `breakage`, `paper_form`
    Energies of gradings beside each other; measures of laboratories; what is the paper's alone.

Another material is another class with the methods of `Elasticity`, another resistance one with
those of `Resistance`, and another form another pair of curves: `branches.crushing_forms` has them.

Compression is positive, energies are per reference volume [J/m3 = Pa].
"""
