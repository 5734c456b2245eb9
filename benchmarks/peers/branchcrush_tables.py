"""Compress a packing with the code of any checkout of this project, and keep its tables.

PYTHONPATH=CHECKOUT/src python branchcrush_tables.py CHECKOUT case.json output.json

The case is that of `branchcrush_compress.py`, whose own copy in the checkout turns it into
variables of in.compress: which these are differs between versions. Writes the tables of states and
of strain steps as JSON, column by column.
"""

import json
import runpy
import sys
import tempfile
import time
from pathlib import Path

# The package of the checkout, by PYTHONPATH.
import branchcrush
from branchcrush.lammps.compression import compress


def main(checkout, case_path, output_path):
    """Run a case and write its tables."""
    checkout = Path(checkout).resolve()
    if not Path(branchcrush.__file__).is_relative_to(checkout):
        raise SystemExit(f"branchcrush comes from {branchcrush.__file__}, not from {checkout}")
    peers = checkout / "benchmarks" / "peers"
    # For what the driver imports.
    sys.path.insert(0, str(peers))
    driver = runpy.run_path(str(peers / "branchcrush_compress.py"))
    case, packing = driver["read_case"](case_path, driver["DEFAULTS"])
    variables = driver["variables_of"](case, packing)
    with tempfile.TemporaryDirectory(prefix="branchcrush-") as folder:
        folder = Path(folder)
        start, start_cpu = time.perf_counter(), time.process_time()
        done = compress(
            *packing,
            variables,
            inputs=driver["INPUTS"],
            folder=folder,
            log=folder / "log",
            ranks=int(case.get("ranks", 1)),
        )
        result = {
            "inside_s": time.perf_counter() - start,
            "inside_cpu_s": time.process_time() - start_cpu,
            "output_MB": sum(file.stat().st_size for file in folder.rglob("*.gz")) / 1e6,
        }
    for name in ("path", "steps"):
        table = getattr(done, name)
        result[name] = {column: values.tolist() for column, values in table.items()}
    Path(output_path).write_text(json.dumps(result) + "\n", encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        raise SystemExit(__doc__)
    main(*sys.argv[1:])
