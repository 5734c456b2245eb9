"""Grains in a cubic cell at one instant: where they are, whom they touch, and what that carries.

`placement.random_packing`
    The loose packing that a compression begins with, by random sequential addition; `cell_grid`
    is how it finds who is near.
`contact_laws`
    Force and energy of a contact by its overlap: `LinearContact`, `HertzContact`, and the registry
    `CONTACT_LAWS`.
`contacts`
    Coordination, rattlers, stress and balance, from plain arrays of contacts.
`network.Network`
    The contacts of one packing in one state, read from the tables of a run by `state_networks`;
    its rattlers are sought once and kept. `grains` gives energy, stress and neighbours of each
    grain of one.
`geometry`
    Volumes of spheres and of the cell.
`sizes.size_problem`
    Whether grains are of sizes that some have, or their unit is another.
`cells`
    The cell of each state as the vectors of its edges: a cube, or what another code had.

A new contact law is a dataclass of `contact_laws` with `force`, `energy`, `name` and `exponent`, an
entry of `CONTACT_LAWS`, its section in `config.schema`, and `lammps_inputs/mod.<name>`.
"""
