"""The contact forces of a packing, and what they carry: how broad, how even, and on which grains.

`distribution`
    Forces over their mean: `force_distribution`, the tail above a threshold in `force_tail`, and
    the mean force by branch length in `force_by_length`. `force_network_result` returns all.
`fabric`
    Directions of branches and of forces: `fabric_tensor` and its `deviator`, beside what chance
    gives as many independent branches. `fabric_result` returns it for a sample.
`chains`
    Which contacts hand on the most in line: `force_chains`, by the stress of each grain.
`stress`
    Which grains carry the stress: `stress_by_radius`, and cumulated from the finest on in
    `stress_sharing`. `stress_sharing_result` returns both.

Each module ends with a function that returns its tables and its numbers of one sample in one state,
from a list of networks, one a seed. A new measure belongs there, and in a column or key of them.
"""
