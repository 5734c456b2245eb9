"""What a study asks for: the configuration, checked in the user's words, and made into objects.

The Snakefile reads the file; `file` says what keeps it from being read, `schema` and `gradings`
what every key may hold, `names` what samples may be called, `checks` what needs the grains, the
files and the folder. A mistake is a line with the key, its value, and what is allowed (`messages`).

- `schema.Config` is the whole configuration, `schema.checked_config` makes it; `Sample.settings`
  are the plain values that rules hand to their jobs. `gradings` has a section for each form,
  `compression` those of contacts and loading, `breakage` of grains that break, `evaluation` those
  of what is made of the packings.
- `json_schema` writes `config.schema.json` from them, which editors read, and `reference` the
  tables of `docs/configuration.md`: `python -m branchcrush.config.json_schema`.
- `checks.checked_study` makes it too, and refuses what no study can be made of: before any job.
- `build.grading_of`, with `FORMS`, and `sample.sample_of` make the objects of a job from plain
  values. They import no pydantic, so that jobs start at once.
- `reading.grading_report` tells how a grading is read, with sizes and lines to paste; `table_keys`
  are the keys of forms that read a file.
- `fields.number` is the type of a key that holds a number, with its bounds in words;
  `stresses.increasing_stresses` reads the stresses of a loading, `units.UNITS` are those of sizes.

A newcomer adds a key where its section stands, with a description, which a test asks for; a form of
gradings as a section in `gradings` and an entry of `build.FORMS`; a contact law as a section of
`compression.Contact`; and runs the command above.
"""
