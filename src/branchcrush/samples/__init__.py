"""All seeds of a sample together: what the rules of the workflow compute.

One module a rule, with one function that its script calls: tables in, tables out. A function that
needs the contacts of many seeds is given what reads those of one, and holds no two at a time.

`ensemble`
    Which seeds and states a fit may use (`certified_loading`), and which of them have a name
    (`named_states`).
`certificate`, `verdict`
    Measures and certificate of every saved state, the jamming points; convergence (`convergence`),
    the way back (`unloading`) and the verdict of the sample.
`seed_contacts`
    What is kept of the contacts of one seed for the results of who touches whom.
`branch_lengths`, `contact_numbers`
    Branch lengths beside their predictions, and contact numbers by radius.
`rods`
    Coordination number and rattlers along the loading, by rods that push.
`energy_split`
    The energy split function and its exponent, at the end and along the loading.
`sharing`
    How energy, force and stress are shared by grains and branches.
`elastic_law`, `rearrangement`
    The elastic law before crushing, and what of the packings' stress it does not give back.
`thermodynamics`, `crushing_model`, `forms_of_sample`, `crushing_curves`, `crushing_bands`
    The crushing model in all its forms, on the elastic energy that was measured.
`crushed`, `crushed_path`, `crushed_sizes`, `crushed_gradings`, `crushed_lengths`, `crushed_line`
    Grains that break: states of one packing, and of all seeds gradings, branch lengths, compression
    line, means, and the forms of the model beside them (`crushed_forms`); `crushed_words` says what
    is undefined or not checked.
`crushing_predicted`, `crushing_prediction`
    The crushing without a simulation, beside the simulated one, and how far it is off.
`crushed_grains`, `crushed_roc`, `crushed_survival`, `crushed_exponents`
    Who breaks and who survives, and how energy is split meanwhile; `crushed_grains_words` says so.
`grading`
    The grading that the seeds realise, beside the target.

A new result of a sample is a function here that takes tables and returns tables, with a rule in
`workflow/rules` and a script of a few lines. This room may hold tables of pandas, and reads no
files: the scripts do.
"""
