"""Typed access to what a study wrote, for users, reports and figures: read when asked for.

`study`
    `open_study` returns a `Study`: its samples by name, its tables of all samples, measured
    materials, what is missing.
    The package itself has it, as `branchcrush.open_study`.
`sample`
    A `Sample`: its packings by seed, its results, its energy split as a typed fit.
`packing`
    A `Packing` of one seed, as it was compressed or as it was crushed, and each `State` of it:
    grains, contacts, network, force chains.
`result`
    A `Result`: the table and the numbers that a rule wrote under one name, with unit and meaning of
    each column, where it came from, and `plot`.
`place`
    What these have in common: a `Place` is a folder that the dictionary of `files` names files of.
    By it alone is known which results there are, so that a new one has its place here at once.
`verification`
    `verify` reads every file of a study and holds it against the record of the job that made it.
`crate`
    A study described as RO-Crate: files with their digests, jobs, software, machine.
`vtp`
    A state as files for ParaView; the format itself is `files.vtk_xml`.

Nothing here computes: what is derived comes from the rooms of the science. Tables are those of
pandas. A file that is not there, that is not what its job left, or that another version wrote, is
told with what to do.
"""
