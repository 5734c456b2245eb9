"""Files in and out: results with where they came from, and the tables that users bring.

No other room of the package knows how a result lies on the disk, nor how people write a table of
numbers. LAMMPS's own files are read in `lammps`, the configuration in `config`.

- `tables` writes and reads every result: `write_table` and `read_table` (CSV or Parquet),
  `write_json` and `read_json`, `write_packing` and `read_packing`, each with a `provenance`:
  version, sample, seed and sections of the configuration. `study_provenance` and `stacked_tables`
  are for the tables of all samples.
- `seeds` reads the files of one seed as its contact network is made of them.
- `grading_tables` reads a user's sieve curve, density or list of radii, and names every line that
  is wrong; `rows` reads the numbers of such a file, whatever machine or person wrote it.
- `replacing` opens a file that takes its place when it is complete, so that a job that is killed
  leaves none by halves; `scratch` makes folders that are known to be nobody's when their process is
  dead, and removes such ones; `encoding` turns values into JSON, cells of CSV and arrays of Arrow.

A newcomer adds a format of results to `tables`, beside the two of `write_table`; a kind of user's
table to `grading_tables`, made of `rows.read_rows` and `rows.refuse`.
"""
