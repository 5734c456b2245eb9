"""A finished study whose files are damaged, and who tells of it: for `damage` and tests."""

import contextlib
import io
import warnings
from pathlib import Path
from types import SimpleNamespace

import branchcrush
from branchcrush.command.main import main
from branchcrush.errors import ResultsError
from branchcrush.files.made import is_record, read_record
from branchcrush.records import recorded_job


class Interrupt(Exception):
    """Ends a job that was only to look at its inputs."""


class _Named(list):
    """Files or values by name, as Snakemake gives them to a script."""

    def __init__(self, values):
        super().__init__(values.values())
        self.__dict__.update(values)

    def items(self):
        return self.__dict__.items()


def files_of(folder):
    """Return all files of the results in a folder, below it, but for hidden ones."""
    found = (path for path in Path(folder, "results").rglob("*") if path.is_file())
    return sorted(str(path.relative_to(folder)) for path in found if path.name[0] != ".")


def kind_of(path):
    """Return what is said of a file in the figures: the end of its name, or that it is a record."""
    return "record" if is_record(path) else Path(path).suffix.removeprefix(".")


class Damaged:
    """A finished study whose files are damaged, and who tells of it.

    Parameters
    ----------
    folder : path-like
        It holds `results`.
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        self.files = files_of(folder)
        records = {path: read_record(self.folder / path) for path in self.files if is_record(path)}
        self.jobs = records
        # The jobs that read each file, by the path of their record; of a record, what it tells of.
        self.readers = {}
        for path, record in records.items():
            for read in record["inputs"]:
                self.readers.setdefault(read, []).append(path)
        for path, record in records.items():
            of_outputs = [self.readers.get(told, []) for told in record["outputs"]]
            self.readers[path] = [reader for readers in of_outputs for reader in readers]
        self.opened = self._opened()

    @contextlib.contextmanager
    def changed(self, path, content):
        """Let a file hold something else, or be away where the content is None."""
        file = self.folder / path
        before = file.read_bytes()
        file.unlink()
        try:
            if content is not None:
                file.write_bytes(content)
            yield
        finally:
            file.write_bytes(before)

    def job_says(self, record_path):
        """Return what a job says that begins now, as the workflow starts it; "" where it begins."""
        record, said = self.jobs[record_path], io.StringIO()
        outputs = {f"output{k}": path for k, path in enumerate(record["outputs"])}
        made = SimpleNamespace(
            rule=record["rule"],
            wildcards=_Named(record["wildcards"]),
            params=_Named({**record["params"], "code": record["code"]}),
            input=_Named({f"input{k}": path for k, path in enumerate(record["inputs"])}),
            output=_Named({**outputs, "record": record_path}),
            log=[str(self.folder / ".snakemake" / "damage.log")],
        )
        with contextlib.chdir(self.folder), contextlib.redirect_stderr(said):
            try:
                with recorded_job(made):
                    raise Interrupt
            except Interrupt:
                return ""
            except SystemExit:
                return said.getvalue()

    def api_says(self, path):
        """Return what the results API says when it opens a file; "" where it says nothing."""
        with warnings.catch_warnings(record=True) as warned:
            warnings.simplefilter("always")
            try:
                self.opened[path](branchcrush.open_study(self.folder))
            except ResultsError as error:
                return f"{error}\n"
        return "".join(f"{warning.message}\n" for warning in warned)

    def verify_says(self):
        """Return exit code and lines of `branchcrush verify`."""
        said = io.StringIO()
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
            code = main(["verify", str(self.folder)])
        return code, said.getvalue().splitlines()

    def told_by(self, path):
        """Return who tells of a damaged file, with what they say, but for `verify`."""
        said = {}
        if readers := self.readers.get(path):
            said["job"] = self.job_says(readers[0])
        if path in self.opened:
            said["api"] = self.api_says(path)
        return said

    def _opened(self):
        """Return by its path how each file is opened by the results API."""
        opened = {"results/datapackage.json": lambda study: study.provenance}
        study = branchcrush.open_study(self.folder)
        places = [(lambda study: study, study)]
        for name, sample in study.samples.items():
            places.append((lambda study, name=name: study[name], sample))
            for seed, packing in sample.seeds.items():
                of = lambda study, name=name, seed=seed: study[name].seed(seed)  # noqa: E731
                places.append((of, packing))
                if packing.crushed:
                    places.append((lambda study, of=of: of(study).crushed, packing.crushed))
                npz = f"results/{packing.prefix}packing.npz"
                opened[npz] = lambda study, of=of: of(study).loose
        for of, place in places:
            for name, result in place.results.items():
                for end, file in result.paths.items():
                    part = "summary" if end == ".json" else "data"
                    if file.is_file():
                        opened[str(file.relative_to(self.folder))] = (
                            lambda study, of=of, name=name, part=part: getattr(
                                of(study).results[name], part
                            )
                        )
        return opened


def flipped(content, rng):
    """Return bytes of which one bit is another."""
    place = rng.randrange(8 * len(content))
    changed = bytearray(content)
    changed[place // 8] ^= 1 << place % 8
    return bytes(changed)
