"""Files in and out: results with where they came from, and the tables that users bring.

No other room of the package knows how a result lies on the disk, nor how people write a table of
numbers. LAMMPS's own files are read in `lammps`, the configuration in `config`.

- `tables` writes and reads every result: `write_table` and `read_table` (CSV or Parquet),
  `write_json` and `read_json`, `write_packing` and `read_packing`, each with a `provenance`:
  version, sample, seed and sections of the configuration. `study_provenance` and `stacked_tables`
  are for the tables of all samples.
- `seeds` reads the files of one seed as its contact network is made of them.
- `grading_tables` reads a user's sieve curve, density, channels or list of radii as `declared`
  says, and names every line that is wrong. `sheets` makes lines of cells of a file, whatever
  machine or person wrote it (`decoding` of text, `spreadsheets` of workbooks), `columns` chooses
  the two that are meant, `openings` and `headers` know words; `rows` are the numbers.
  `header_words` are a table's before it is known how it is to be read.
- `sieve_tables` makes a curve of a sieving, `sieve_readings` holds its words and numbers against
  what is declared; `channel_tables`, `channel_edges` and `channel_readings` are the like.
- `histories` reads a user's strains or stresses in turn.
- `dictionary` tells what every file of the results holds, each column and key with its type, unit
  and meaning, from the TOML files in `meanings`; `datapackage` makes `datapackage.json` of it.
- `blocks` fills the places of a page that a command makes, and writes tables in Markdown.
- `origin` reads what made a result from the file itself; `vtk_xml` writes points and lines for
  ParaView.
- `made` is what the record of a job looks like, `intact` whether a file is what its record tells,
  by `digests`; jobs, the results API and `branchcrush verify` ask it before they trust a file.
  `machine` tells with which software and where a study was finished.
- `replacing` opens a file that takes its place when it is complete, so that a job that is killed
  leaves none by halves; `scratch` makes folders that are known to be nobody's when their process is
  dead, and removes such ones; `encoding` turns values into JSON, cells of CSV and arrays of Arrow.

A newcomer adds a result to the stage of `meanings` that it is of, and a test says what is missing
there; a format of results to `tables`, beside the two of `write_table`; a kind of user's table to
`grading_tables`, made of `columns.read_columns` and `rows.refuse`; a word of another
language to `headers` or `openings`.
"""
