"""The configuration file as such: whether it is there, is text, is YAML, has no key twice.

A configuration goes from hand to hand, and is data: what Snakemake or YAML would run in it is
refused before either reads it.
"""

import re
from os import PathLike
from pathlib import Path
from typing import Any

import yaml

from branchcrush.errors import ConfigError

# With `__use_yte__`, Snakemake runs what other such keys hold.
_CODE_KEY = re.compile(r"__.*__", re.DOTALL)
# YAML of 1.1 reads 0170 as octal, 1:30 as 90 and 0x10 as 16.
_DECIMAL = re.compile(r"[-+]?(0|[1-9][0-9_]*)")
# References can make a short file as large as one likes.
_MOST_ENTRIES = 1_000_000
# A study of a thousand samples has less [bytes], and as many keys and values; Snakemake reads it
# again for every job.
_LARGEST, _MOST_NODES = 500_000, 60_000


class _Loader(yaml.SafeLoader):
    """Refuses what YAML would read silently as something else than what is written."""

    nodes = 0

    def compose_node(self, parent, index):
        event = self.peek_event()
        self.nodes += 1
        if self.nodes > _MOST_NODES:
            raise _refused(f"more than {_MOST_NODES} keys and values: put lists into files", event)
        if getattr(event, "tag", None) is not None:
            tag = event.tag.replace("tag:yaml.org,2002:", "!!")
            raise _refused(f"{tag} is a tag, and only plain values are read: remove it", event)
        return super().compose_node(parent, index)

    def construct_mapping(self, node, deep=False):
        seen = {}
        for key, _ in node.value:
            # Keys of a merge (<<) may be given again: that is what merging is for.
            name = key.value if isinstance(key, yaml.ScalarNode) and key.value != "<<" else None
            if name in seen and name is not None:
                raise _refused(
                    f"{name} is given twice in one section, first in line {seen[name]}", key
                )
            seen[name] = key.start_mark.line + 1
        return super().construct_mapping(node, deep)

    def construct_yaml_int(self, node):
        number = super().construct_yaml_int(node)
        if not _DECIMAL.fullmatch(node.value):
            raise _refused(f"{node.value} is {number} to YAML: write it as a plain number", node)
        return number

    def construct_yaml_float(self, node):
        number = super().construct_yaml_float(node)
        if ":" in node.value:
            raise _refused(f"{node.value} is {number} to YAML: write it as a plain number", node)
        return number


_Loader.add_constructor("tag:yaml.org,2002:int", _Loader.construct_yaml_int)
_Loader.add_constructor("tag:yaml.org,2002:float", _Loader.construct_yaml_float)


def _refused(problem, place):
    return yaml.MarkedYAMLError(problem=problem, problem_mark=place.start_mark)


def config_file_problem(path: str | PathLike[str], *, whole: bool = True) -> str | None:
    """Return what keeps a file from being read as a configuration, or None.

    Nothing in the file is run, neither here nor by Snakemake once it has passed.

    Parameters
    ----------
    path : path-like
    whole : bool
        Whether it must name samples; a file given with `--configfile` may hold other keys only.

    Returns
    -------
    str or None
        One line, with what to do.

    Examples
    --------
    >>> config_file_problem("nowhere.yaml")[:37]
    'config: there is no file nowhere.yaml'
    """
    return _read(Path(path), whole)[0]


def _read(path, whole):
    """Return what keeps a file from being read, and what it holds."""
    if not path.exists():
        return (
            f"config: there is no file {path} in {Path.cwd()}: run where one lies, or name its "
            "folder with --directory"
        ), None
    problem, content = _parsed(path)
    if problem is None:
        entries, samples = _entries(content), ", and among them samples" if whole else ""
        if entries is None:
            problem = " has a section that contains itself: write it without *"
        elif entries > _MOST_ENTRIES:
            problem = " has more than a million entries by its *: write it without them"
        elif code := code_problem(content):
            problem = f": {code}"
        elif not isinstance(content, dict) or (whole and "samples" not in content):
            problem = f" must hold keys and values{samples}"
        else:
            return None, content
    return f"config: {path}{problem}", None


def _parsed(path):
    """Return what is wrong with a file as such, said of its name, and what it holds."""
    try:
        if path.is_dir():
            return " is a folder, and must be a text file of keys and values", None
        if path.stat().st_size > _LARGEST:
            return (
                f" has more than the {_LARGEST / 1e6:g} MB that it may have: put lists of sizes "
                "into files of their own"
            ), None
        return None, yaml.load(path.read_text(encoding="utf-8-sig"), Loader=_Loader)
    except UnicodeDecodeError:
        return " is no text in UTF-8: save it as such", None
    except OSError as error:
        return f" cannot be read: {error.strerror}", None
    except yaml.MarkedYAMLError as error:
        line = error.problem_mark.line + 1 if error.problem_mark else "?"
        return f", line {line}: {_plain(error.problem)}; mend the YAML there", None
    except yaml.YAMLError as error:
        return f" is no YAML: {str(error).splitlines()[0]}", None
    except (ValueError, RecursionError) as error:  # a date in month 13; a thousand brackets
        return f" is no usable YAML: {error}", None


def config_file_content(path: str | PathLike[str]) -> dict[str, Any]:
    """Return what a configuration file holds.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    dict

    Raises
    ------
    ConfigError
        From `config_file_problem`.

    Examples
    --------
    >>> config_file_content("nowhere.yaml")
    Traceback (most recent call last):
    branchcrush.errors.ConfigError: config: there is no file nowhere.yaml in ...
    """
    problem, content = _read(Path(path), whole=True)
    if problem:
        raise ConfigError(problem)
    return content


def code_problem(content: Any) -> str | None:
    """Return which key of a configuration stands for code, or None.

    Parameters
    ----------
    content : object
        What a YAML file or the command line holds; no section contains itself.

    Returns
    -------
    str or None
        One line, with what to do.

    Examples
    --------
    >>> code_problem({"samples": [{"__definitions__": ["import os"]}]})
    '__definitions__ is a key of a template that runs code, and a configuration is data: ...
    """
    pending, seen = [content], set()
    while pending:
        section = pending.pop()
        if id(section) in seen or not isinstance(section, (dict, list, tuple, set)):
            continue
        seen.add(id(section))
        for key in section if isinstance(section, dict) else ():
            if isinstance(key, str) and _CODE_KEY.fullmatch(key.strip()):
                return (
                    f"{key} is a key of a template that runs code, and a configuration is data: "
                    "remove it"
                )
        pending += _below(section)
    return None


def _entries(content):
    """Return how many entries a file has with all that its aliases repeat; None if endless."""
    counted = {}

    def count(section):
        if not isinstance(section, (dict, list)):
            return 1
        if id(section) not in counted:
            # Until it is counted, to meet it again is to be inside of it.
            counted[id(section)] = None
            below = [count(item) for item in _below(section)]
            if None in below:
                return None
            counted[id(section)] = 1 + sum(below)
        return counted[id(section)]

    return count(content)


def _below(section):
    return section.values() if isinstance(section, dict) else section


def _plain(problem):
    r"""Return a problem of YAML's parser as a person who knows no parser would put it.

    Examples
    --------
    >>> _plain("found character '\\t' that cannot start any token")
    'a tab, where YAML wants blanks'
    """
    if "'\\t'" in problem:
        return "a tab, where YAML wants blanks"
    return problem
