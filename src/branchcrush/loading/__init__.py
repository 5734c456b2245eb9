"""What a compression is asked for, and what its saved states tell.

`targets.Loading`
    The target, the states on the way to it, and whether it goes back; the other functions of
    `targets` make edges, stresses and numbers of steps of it.
`sample.Sample`
    A named entry of a study: its grading, packing, contact law and loading. `config.build` makes
    it.
`states`
    The contacts of a saved state, from the frames that LAMMPS dumps, and the force and stress that
    stand for no load.
`path.path_row`, `measures`
    The row of `path.csv` of a state, and the measures that it is made of: cell, stress, energy,
    coordination, rest and overlaps.
`jamming.jamming_point`
    Where the stress of a packing vanishes.

A new measure of a state is an entry of what a function of `measures` returns; it is then a column
of `path.csv`. A new target goes into `targets`, and into `config.schema`.
"""
