"""What the words above a table say of its columns, in English, German and French."""

import re
import unicodedata
from dataclasses import dataclass

_UNITS = {
    "um": r"\bum\b|\bmicrons?\b|\bmicrometers?\b|\bmicrometres?\b|\bmikrometer\b",
    "nm": r"\bnm\b",
    "mm": r"\bmm\b|\bmillimet(er|re)s?\b",
    "cm": r"\bcm\b|\bcentimet(er|re)s?\b|\bzentimeter\b",
    "inch": r"\binch(es)?\b|\bzoll\b|\bpouces?\b|[\[(]\s*in\.?\s*[\])]|\bin\.?$",
    "m": r"[\[(]\s*m\s*[\])]|(?:^|\s)m$|\bmet(er|re)s?\b",
}
# A title speaks of more than sizes: of the sieves' width, of the place of the sample.
_UNITS_OF_TITLE = {
    unit: rf"[\[(]\s*({word})\s*[\])]|\bin ({word})"
    for unit, word in (
        ("um", "um|microns?"),
        ("nm", "nm"),
        ("mm", "mm"),
        ("cm", "cm"),
        ("inch", "inch(es)?"),
    )
}
_PHI = r"\bphi\b|φ"
_MESH = (
    r"\bmesh(es)?\b|#\s*\d|\bno\.?\s*\d|\bsieve\s*(no\b|nr\b|number|#)|\bus sieve\b|"
    r"\bsieb\s*-?\s*(nr\b|nummer)|\btamis n|\bastm\b|\btyler\b|^#$|\bmaschenzahl"
)
_TYLER, _ASTM = r"\btyler\b", r"\bastm\b|\bus (standard )?sieve\b|\bu\.s\."
_CUMULATIVE = r"\bcum(ul\w*|\.|\b)|\bkum(ul\w*|\.|\b)|summe\b|\bsummen|\bcumule"
_FINER = (
    r"\bfiner\b|\bpassing\b|\bpass\b|\bpassed\b|\bundersize\b|\bunder size\b|"
    r"\bsmaller\b|\bless than\b|durchgang|\bpassants?\b|\btamisats?\b|\bfeiner\b|"
    r"\bcpft\b"
)
_COARSER = (
    r"\bcoarser\b|\boversize\b|\blarger than\b|\bgreater than\b|\bgrober\b|"
    r"\bplus grossier"
)
_RETAINED = r"\bretained\b|\bretaining\b|ruckstand|\brefus\b|\bresidue\b|\bheld\b"
_EACH = (
    r"\bindividual\b|\bdifferential\b|\binterval\b|\bclass weight\b|\bfrequency\b|"
    r"\bpartiels?\b|\bfraction\b|\bklassenanteil|\bfraktion"
)
_GRAMS = (
    r"[\[(]\s*k?g\s*[\])]|\bgrams?\b|\bgrammes?\b|\bgramm\b|"
    r"(?:mass|weight|masse|gewicht|poids|retained|ruckstand|refus),?\s+k?g\b"
)
_PERCENT = r"%|\bpercent\b|\bper cent\b|\bpercentage\b|\bprozent\b|\bpourcent"


@dataclass(frozen=True)
class Words:
    """What is written above the two columns, and above both of them.

    Parameters
    ----------
    opening, value : str
        Of each column, as it stands there.
    title : str
        Lines of their own, and comments.

    Examples
    --------
    >>> Words("phi", "cumulative weight %").openings()
    {'phi'}
    """

    opening: str = ""
    value: str = ""
    title: str = ""

    def openings(self) -> set[str]:
        """Return which kinds of openings are meant; empty if nothing is said."""
        text = plain_words(self.opening)
        units = _units(text)
        kinds = set()
        if re.search(_PHI, text):
            kinds.add("phi")
        if re.search(_MESH, text) and not units:
            named = {"astm_e11": re.search(_ASTM, text), "tyler_mesh": re.search(_TYLER, text)}
            kinds |= {kind for kind, said in named.items() if said} or set(named)
            if re.search(r"\bmesh (size|opening|width|aperture)", text):
                kinds.add("size")
        # phi is -log2 of mm, and a diameter's letter.
        if units and not re.search(r"log", text):
            kinds.add("size")
        if kinds:
            return kinds
        title = plain_words(self.title)
        if re.search(_PHI, title):
            return {"phi"}
        if re.search(r"\bmesh\b(?! (size|opening|width|aperture))", title) and not self.units():
            return {"astm_e11", "tyler_mesh"}
        return set()

    def units(self) -> set[str]:
        """Return which units sizes are said to have."""
        text = plain_words(self.opening)
        if re.search(_PHI, text) and "log" in text:
            return set()
        if units := _units(text):
            return units
        title = plain_words(self.title)
        return {unit for unit, word in _UNITS_OF_TITLE.items() if re.search(word, title)}

    def values(self) -> set[str]:
        """Return which kinds of a sieve's values are meant."""
        return _values(plain_words(self.value)) or _values(plain_words(self.title), title=True)

    def percent(self) -> bool:
        """Return whether values are percent of something that is not said."""
        text = plain_words(self.value)
        return bool(re.search(_PERCENT, text)) and not re.search(
            r"/|\bper [a-z]|densit|dicht", text
        )

    def cumulative(self) -> bool:
        """Return whether values are sums up to or from a size."""
        text = plain_words(self.value)
        return bool(re.search(rf"{_CUMULATIVE}|{_FINER}|{_COARSER}", text))

    def per(self) -> set[str]:
        """Return what a density is said to be taken per."""
        text = plain_words(self.value) + " " + plain_words(self.title)
        said = {
            "phi": r"(/|per) ?d?phi\b|(/|per) ?d?φ",
            "log_size": r"\bd ?(log|ln|lg)|\blog|\bln\b|\blg\b|\bper decade\b|q\d?\*",
            "size": r"(/|\bper) ?(d ?d\b|dx\b|mm|um|micron|cm|m\b|size|diameter)"
            r"|1/(mm|um|m)\b|\b(mm|um|m)-1\b|(mm|um)\^-1",
        }
        return {kind for kind, word in said.items() if re.search(word, text)}

    def bases(self) -> set[str]:
        """Return by what values are said to count grains."""
        text = plain_words(self.value)
        mass = (
            r"\bmass\b|\bmasse\b|\bweight\b|\bvol(ume|umen|\.|\b)|gewicht|\bpoids\b|\bdv\b|\bdm\b"
        )
        number = r"\bcounts?\b|\banzahl\b|\bnumbers?\b|\bnombre\b|\bdn\b|\bparticles\b"
        said = {"mass": mass, "number": number}
        return {basis for basis, word in said.items() if re.search(word, text)}

    def sizes(self) -> set[str]:
        """Return which of a channel's sizes are said to stand in the file."""
        text = plain_words(self.opening)
        said = {
            "lower": r"\blower\b|\bfrom\b|\bvon\b|\bunter\w*|\binf\w*|\bmin\b",
            "upper": r"\bupper\b|\bto\b|\bbis\b|\bober\w*|\bsup\w*|\bmax\b",
            "middles": r"\bmid\w*|\bcent(er|re)\w*|mitte|\bmean\b|\bmilieu\b|\bmoyen",
        }
        kinds = {kind for kind, word in said.items() if re.search(word, text)}
        return {"edges"} if {"lower", "upper"} <= kinds else kinds


def plain_words(text: str) -> str:
    """Return a text in small letters without accents, a micro sign as u, blanks as one.

    Parameters
    ----------
    text : str

    Returns
    -------
    str

    Examples
    --------
    >>> plain_words("Rückstand  [µm]"), plain_words("sieve_opening")
    ('ruckstand [um]', 'sieve opening')
    """
    text = unicodedata.normalize("NFKD", text.replace("″", '"').replace("”", '"'))
    text = "".join(mark for mark in text if not unicodedata.combining(mark)).lower()
    text = text.replace("μ", "u").replace("ß", "ss").replace("−", "-").replace("–", "-")
    return " ".join(text.replace("_", " ").split())


def _units(text):
    units = {unit for unit, word in _UNITS.items() if re.search(word, text)}
    return units - {"m"} if len(units) > 1 else units


def _values(text, title=False):
    """Return which kinds of values words speak of."""
    kinds = set()
    if re.search(_FINER, text):
        kinds.add("percent_finer")
    if re.search(_COARSER, text):
        kinds.add("percent_coarser")
    if re.search(_RETAINED, text):
        if re.search(_CUMULATIVE, text):
            kinds.add("percent_coarser")
        else:
            percent, grams = re.search(_PERCENT, text), re.search(_GRAMS, text)
            if percent or not grams:
                kinds.add("percent_retained")
            if grams or not percent:
                kinds.add("mass_retained")
            # Many write it of sums from the coarsest sieve too.
            if not grams and not re.search(_EACH, text):
                kinds.add("percent_coarser")
    if kinds or title:
        return kinds
    if re.search(_CUMULATIVE, text):
        return {"percent_finer", "percent_coarser"}
    if re.search(_GRAMS, text):
        return {"mass_retained"}
    return {"percent_retained", "mass_retained"} if re.search(_EACH, text) else set()
