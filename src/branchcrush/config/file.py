"""The configuration file as such: whether it is there, is text, is YAML, has no key twice."""

from os import PathLike
from pathlib import Path
from typing import Any

import yaml

from branchcrush.errors import ConfigError


class _Loader(yaml.SafeLoader):
    """Refuses a key given twice, of which YAML would silently keep the last."""

    def construct_mapping(self, node, deep=False):
        seen = {}
        for key, _ in node.value:
            # Keys of a merge (<<) may be given again: that is what merging is for.
            name = key.value if isinstance(key, yaml.ScalarNode) and key.value != "<<" else None
            if name in seen and name is not None:
                raise yaml.MarkedYAMLError(
                    problem=f"{name} is given twice in one section, first in line {seen[name]}",
                    problem_mark=key.start_mark,
                )
            seen[name] = key.start_mark.line + 1
        return super().construct_mapping(node, deep)


def config_file_problem(path: str | PathLike[str]) -> str | None:
    """Return what keeps a file from being read as a configuration, or None.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    str or None
        One line, with what to do.

    Examples
    --------
    >>> config_file_problem("nowhere.yaml")[:37]
    'config: there is no file nowhere.yaml'
    """
    path = Path(path)
    if path.is_dir():
        return f"config: {path} is a folder, and must be a text file of keys and values"
    if not path.exists():
        return (
            f"config: there is no file {path} in {Path.cwd()}: run where one lies, or name its "
            "folder with --directory"
        )
    try:
        content = yaml.load(path.read_text(encoding="utf-8-sig"), Loader=_Loader)
    except UnicodeDecodeError:
        return f"config: {path} is no text in UTF-8: save it as such"
    except OSError as error:
        return f"config: {path} cannot be read: {error.strerror}"
    except yaml.MarkedYAMLError as error:
        line = error.problem_mark.line + 1 if error.problem_mark else "?"
        return f"config: {path}, line {line}: {_plain(error.problem)}; mend the YAML there"
    except yaml.YAMLError as error:
        return f"config: {path} is no YAML: {str(error).splitlines()[0]}"
    except (ValueError, RecursionError) as error:  # a date in month 13; a thousand brackets
        return f"config: {path} is no usable YAML: {error}"
    if _contains_itself(content):
        return f"config: {path} has a section that contains itself: write it without *"
    if not isinstance(content, dict) or "samples" not in content:
        return f"config: {path} must hold keys and values, and among them samples"
    return None


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
    if problem := config_file_problem(path):
        raise ConfigError(problem)
    return yaml.load(Path(path).read_text(encoding="utf-8-sig"), Loader=_Loader)


def _contains_itself(content, above=()):
    """Return whether a section is inside itself, which an alias of YAML can do."""
    if not isinstance(content, (dict, list)):
        return False
    below = content.values() if isinstance(content, dict) else content
    within = (*above, id(content))
    return id(content) in above or any(_contains_itself(item, within) for item in below)


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
