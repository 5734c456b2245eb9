"""What is read in `benchmarks.fuzz`: each reader with sound files, and what a sound result is."""

import contextlib
import io
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

import numpy as np

from branchcrush.config.build import compression_of
from branchcrush.config.checks import checked_study
from branchcrush.config.file import config_file_content
from branchcrush.config.grading_files import checked_grading
from branchcrush.config.reading import grading_report
from branchcrush.config.schema import kind_of_sample
from branchcrush.errors import GradingError, ReadingError
from branchcrush.files.histories import read_history
from branchcrush.packings.contact_laws import LinearContact
from branchcrush.readers.packing import read_frames
from branchcrush.readers.report import reading_report
from branchcrush.readers.states import first_packing, packing_tables

ROOT = Path(__file__).parents[1]
_TABLES, _SAND = ROOT / "tests/data/gradings", ROOT / "examples/crushable_sand"
_MASS = {"basis": "mass", "size": "diameter", "unit": "mm"}
_CHANNELS = {"basis": "volume", "size": "diameter", "unit": "um"}
_GRADINGS = {
    "sieve": ("fines_below_last_sieve.csv", {"form": "sieve", **_MASS, "min": 0.01}),
    "sieve_phi": (
        "phi_cumulative_coarser.csv",
        {"form": "sieve", **_MASS, "openings": "phi", "values": "percent_coarser"},
    ),
    "sieve_retained": (
        "mass_retained_and_pan.csv",
        {"form": "sieve", **_MASS, "values": "mass_retained", "min": 0.02},
    ),
    "channels": (
        "laser_channels.csv",
        {"form": "histogram", **_CHANNELS, "sizes": "middles", "scale": "log"},
    ),
    "channels_lower": ("laser_channels.csv", {"form": "histogram", **_CHANNELS, "sizes": "lower"}),
}
_EDGES = "from,to,volume %\n" + "".join(f"{2**n},{2**n * 2},{3 + n}\n" for n in range(12))
_DENSITY = "size,density\n" + "".join(f"{1 + 0.5 * n},{0.02 * n * (30 - n):g}\n" for n in range(31))
_RADII = "size [mm]\n" + "\n".join(f"{0.5 + 0.01 * n:.4g}" for n in range(60)) + "\n"
_HISTORY = "time;stress [kPa]\n0;0\n1;250\n2;100\n3;1,5\n4;900\n"
_TEST = {
    "stress_unit": "MPa",
    "values": "void_ratio",
    "initial_void_ratio": 0.80,
}
# Beside the studies of the repository: what they have not.
_STUDY = """\
samples: &all
  listed: &one
    grading: {form: sieve, basis: mass, size: diameter, unit: mm, file: synthetic_before.csv}
    grains: 3e3
    sampling: number_quantiles
    allow_unrepresentative: true
    boundary: walls
    initial_solid_fraction: 0.2
    contact: {law: hertz, young_modulus: 7.0e10, poisson_ratio: 0.17}
    loading: {mean_stress: {from: 1.0e6, to: 1.0e7, states: 5}, unloading: true}
    seeds: [3, 5, 8]
    refined_seeds: 1
    ranks: 2
  other:
    <<: *one
    loading: {solid_fraction: 0.7, states: 9, quality: draft}
    breakage: {strength: 2.0e7, weibull_modulus: 3, unit: mm, reference_diameter: 1.0,
      smallest_diameter: 0.05}
  read:
    packing:
      format: columns
      grains: synthetic_before.csv
      contacts: [synthetic_after.csv]
      columns: {id1: a, id2: b, force: [x, y, z]}
      cell: {low: [0, 0, 0], high: [1, 1, 1]}
      wall_ids: [-1, -2]
    boundary: periodic
    contact: {law: linear, normal_stiffness: 1.0e6}
energy_split: {bins: 20, confidence: 0.95, resamples: 2000}
thermodynamics:
  form: einav
  history: {strain: [0, 0.01, 0.02]}
  resistance: elastic_strain
  elastic_strain: 0.0125
figures: {dpi: 100}
keep_dumps: last
"""


@dataclass(frozen=True)
class Reader:
    """A reader, and a sound file for it."""

    data: bytes
    name: str  # of the file
    read: object  # takes its path, and raises what a user would meet


@cache
def readers():
    """Return every reader with a sound file, by name.

    Returns
    -------
    dict of Reader
    """
    found = {}
    for case, which, path in _packings():
        found[f"{case}.{which}"] = Reader(
            path.read_bytes(), path.name, partial(_packing, case, which)
        )
    for name, (file, section) in _GRADINGS.items():
        found[name] = Reader((_TABLES / file).read_bytes(), file, partial(_grading, section))
    edges = {"form": "histogram", **_CHANNELS, "sizes": "edges"}
    found["channels_edges"] = Reader(_EDGES.encode(), "edges.csv", partial(_grading, edges))
    density = {"form": "density", **_MASS}
    found["density"] = Reader(_DENSITY.encode(), "density.csv", partial(_grading, density))
    retained, section = _GRADINGS["sieve_retained"]
    book = _workbook((_TABLES / retained).read_text(encoding="utf-8"))
    found["workbook"] = Reader(book, "sand.xlsx", partial(_grading, section))
    radii = {"form": "radii", "basis": "number", "size": "radius", "unit": "mm"}
    found["radii"] = Reader(_RADII.encode(), "radii.txt", partial(_grading, radii))
    test = (_SAND / "synthetic_compression.csv").read_bytes()
    found["compression"] = Reader(test, "test.csv", _compression)
    found["history"] = Reader(_HISTORY.encode(), "history.csv", _history)
    for path in sorted((ROOT / "examples").glob("*/config.yaml")):
        found[f"config.{path.parent.name}"] = Reader(
            path.read_bytes(), "config.yaml", partial(_study, path.parent)
        )
    found["config.all_keys"] = Reader(_STUDY.encode(), "config.yaml", partial(_study, _SAND))
    return found


def _packings():
    from tests.unit.readers.conftest import CASES, DATA

    for case, (folder, _, grains, contacts, _) in CASES.items():
        yield case, "grains", DATA / folder / grains
        yield case, "contacts", DATA / folder / contacts


def _packing(case, which, path):
    """Read a packing, one of its files in the place of the sound one."""
    from tests.unit.readers.conftest import source_of_case

    law = LinearContact(1e6)
    read = read_frames(source_of_case(case, **{which: [path]}))
    tables = packing_tables(read, law)
    reading_report(read, law, [str(path)])
    positions, radii, edge = first_packing(read)
    numbers = [positions, radii, edge, *(tables.contacts[name] for name in tables.contacts)]
    if not all(np.isfinite(each).all() for each in numbers) or np.any(radii <= 0) or edge <= 0:
        raise AssertionError("a packing was read that is none")


def _grading(section, path):
    """Read a grading as a study does, and as the command line tells of it."""
    grading, problems = checked_grading({**section, "file": str(path)})
    grading_report({**section, "file": str(path)})
    if problems:
        raise GradingError("\n".join(problems))
    low, high = grading.support()
    numbers = [low, high, grading.moment(3), *grading.mass_ppf([0.1, 0.5, 0.9])]
    if not np.isfinite(numbers).all() or not 0 < low <= numbers[4] <= high * (1 + 1e-9):
        raise AssertionError("a grading was read that is none")


def _compression(path):
    table = compression_of({"file": str(path), **_TEST})
    if not np.isfinite([table.stress, table.strain]).all() or np.any(np.diff(table.stress) <= 0):
        raise AssertionError("a compression curve was read that is none")


def _history(path):
    if not np.isfinite(read_history(path, "stress", "kPa")).all():
        raise AssertionError("a history was read that is none")


def _study(folder, path):
    """Read a configuration as `branchcrush check` does, beside the tables that it may name."""
    with contextlib.chdir(folder):
        study = checked_study(config_file_content(path), path.parent)
    for name, sample in study.samples.items():
        sample.settings()
        if kind_of_sample(sample) not in ("read", "compressed") or not name:
            raise ReadingError("a sample without a kind or a name was taken")


def _workbook(text):
    """Return the bytes of a workbook of a table."""
    import openpyxl

    book, content = openpyxl.Workbook(), io.BytesIO()
    for line in text.splitlines():
        book.active.append([_cell(cell) for cell in line.split(",")])
    book.create_sheet("notes").append(["none"])
    book.save(content)
    return content.getvalue()


def _cell(text):
    try:
        return float(text)
    except ValueError:
        return text
