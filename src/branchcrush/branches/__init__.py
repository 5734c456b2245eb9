"""Branches, the lines between the centres of touching grains: their lengths, and who touches whom.

`lengths`
    What is counted: the number of grains and branches in a volume, and the distribution of lengths
    beside Eq. 4, `branch_length_table` and `branch_statistics`.
`random_contacts`
    Eq. 4, any two grains as likely to touch: `random_contact_shares`, `random_contact_moment`.
`contact_numbers`
    Who touches whom, measured: `ContactSums` is what a seed adds, `contact_number_table`,
    `pair_table` and `assortativity` what all seeds say.
`coordination_models`, `coordination`
    Contact numbers from the grading alone. `MODELS` holds a `CoordinationModel` each, with its look
    in figures; each returns a `Coordination`.
`parking`, `parking_places`
    One of them, as many neighbours as find room: all of its `parking_solutions`.
`load_bearing`
    Another, rods that push: which grains carry load, at jamming and beyond.
`predictions`, `nodes`
    Branch lengths that Eq. 4 and every model predict for a grading, a `Prediction` each, and how
    far they are from the measured ones, `distances`. `PREDICTIONS` holds the looks of all.
`coordination_laws`
    Coordination numbers of the void ratio, the jamming law and its fit.
`uniform_stress`, `crushing_gradings`
    Forces on the grains that carry load, each bearing one mean stress, and how a grading goes while
    its grains break.

A new model of contact numbers is a function of radii and their shares, and an entry of `MODELS`:
its branch lengths, distances and figures follow.
"""
