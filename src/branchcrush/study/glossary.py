"""The terms of the pages, read from `docs/glossary.md`: one source for the pages and the site."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from markupsafe import Markup, escape

_ENTRY = re.compile(r"\*\*(.+?)\*\*(?: \(([^)]*)\))?: (.+)", re.DOTALL)
_LINK = re.compile(r"\[([^\]]*)\]\([^)]*\)")
_SUBSCRIPT = re.compile(r"(\w)_(\w)\b")


@dataclass(frozen=True)
class Term:
    """A term and its meaning.

    Parameters
    ----------
    names : tuple of str
        What it is called, words and symbols.
    meaning : str
        In plain text.

    Examples
    --------
    >>> Term(("Solid fraction", "φ"), "Volume of the grains over that of the cell.").anchor
    'term-solid-fraction'
    """

    names: tuple[str, ...]
    meaning: str

    @property
    def anchor(self) -> str:
        """Where the glossary of a page has it."""
        return "term-" + re.sub(r"[^\w]+", "-", self.names[0].lower().replace("*", "star"))

    @property
    def heading(self) -> Markup:
        """Its names, with their subscripts."""
        return Markup(", ").join(map(with_subscripts, self.names))


def read_glossary(text: str) -> list[Term]:
    r"""Return the terms of the glossary in their order.

    Parameters
    ----------
    text : str
        Markdown: paragraphs that begin with the names in bold, apart by commas and semicolons.

    Returns
    -------
    list of Term

    Examples
    --------
    >>> read_glossary("# Words\n\n**Void ratio, e**: voids over *grains*, see [A](a.md).")
    [Term(names=('Void ratio', 'e'), meaning='voids over grains, see A.')]
    """
    found = (_ENTRY.fullmatch(part.strip()) for part in text.split("\n\n"))
    return [
        Term(
            tuple(_plain(name) for name in re.split(r"[,;] | and ", entry[1])),
            _plain(entry[3]),
        )
        for entry in found
        if entry
    ]


def terms_by_name(terms: Sequence[Term]) -> Mapping[str, Term]:
    """Return the terms by every name that they have, with a capital and without.

    Raises
    ------
    ValueError
        Where two terms have one name.

    Examples
    --------
    >>> terms_by_name([Term(("Rattler",), "carries no load")])["rattler"].meaning
    'carries no load'
    """
    named: dict[str, Term] = {}
    for term in terms:
        for name in term.names:
            for key in _written(name):
                if named.setdefault(key, term) is not term:
                    raise ValueError(f"two terms of the glossary are called {name}")
    return named


def _written(name: str) -> set[str]:
    """Return a name as it stands within a sentence and at its beginning; a symbol has one form."""
    rest = name[1:]
    return {name[:1].lower() + rest, name[:1].upper() + rest} if rest[:1].islower() else {name}


def with_subscripts(text: str) -> Markup:
    """Return text whose symbols stand as on paper, φ_J with its J below.

    Examples
    --------
    >>> with_subscripts("φ_J < 1")
    Markup('φ<sub>J</sub> &lt; 1')
    """
    return Markup(_SUBSCRIPT.sub(r"\1<sub>\2</sub>", str(escape(text))))


def _plain(text: str) -> str:
    """Return Markdown without its marks: links by their words, no emphasis, lines joined."""
    bare = re.sub(r"(?<!\\)[*`]", "", _LINK.sub(r"\1", text))
    return " ".join(bare.replace("\\*", "*").split())
