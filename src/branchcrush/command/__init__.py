"""What a user types besides Snakemake: the console command `branchcrush`, thin over the rooms.

- `main.main` reads the command line; `grading`, `preview`, `check` and `export` are its
  commands. Each takes
  plain values, prints, and returns an exit code: 0, 1 for problems of the user's input. 2 is a
  command line that cannot be read, or names a file or a folder that is not there.
- `preview.study_preview` is what the rule preview calls too.
"""
