"""Contacts that other codes made: their files, held against each other, as states of a packing.

- `texts`: a file as text (plain, .gz, .zst), its blocks of numbers, and the digits they have.
- `dumps`, `vtk`, `mercury`, `tables`: the layouts, each into named columns of frames.
- `liggghts`: what the columns of its compute are, which its files do not say.
- `layouts`: where a packing is read from, and what reads the files of each code.
- `roles`: which column is what: ids, ends, force, overlap.
- `cells`: cells of any shape, and the nearest image in them.
- `places`: grains found by where they are, and pairs that overlap.
- `matching`: contacts held against the grains: each once, with its branch vector and normal force.
- `pairs`, `forces`: contacts each once, and their forces in one sign.
- `packing`: all frames of a packing.
- `report`: in numbers and sentences.
- `states`: the tables that a compression leaves, from such frames.

What is not sure is named, never guessed: a contact given twice, an id without a grain, a file that
breaks off. Virtual contacts, which carry nothing, are left out and counted.

A new layout is a module that yields frames of columns, its word in `layouts.FORMATS`, and its
section in `config/packing.py`. Only `config` and `lammps` stand beside this room; it imports
neither.
"""
