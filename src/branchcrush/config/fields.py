"""What the sections of the configuration have in common: numbers that say what they allow."""

import math
from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, ValidationInfo, WithJsonSchema
from pydantic_core import PydanticCustomError

# What Python reads as a number; bounds are not checked in text, so that nothing is refused wrongly.
_NUMBER_IN_TEXT = r"^\s*[+-]?(\d(_?\d)*\.?(\d(_?\d)*)?|\.\d(_?\d)*)([eE][+-]?\d(_?\d)*)?\s*$"


class Section(BaseModel):
    """A section of the configuration: no keys but its own, and none changed once checked."""

    model_config = ConfigDict(extra="forbid", frozen=True)


@dataclass(frozen=True)
class Allowed:
    """What a key may hold, in the words of the error where it is missing.

    A key that holds a number has them already; `description` is for documentation.

    Examples
    --------
    >>> class Table(Section):
    ...     file: Annotated[str, Allowed("must be the name of a file")]
    """

    allowed: str


class Number:
    """Reads a number within bounds, also from text such as 1e6, which YAML takes for text.

    Parameters
    ----------
    above, least, below, most : float, optional
        Bounds; the value may be `least` and `most` itself.
    whole : bool
        Whether it must be an integer.
    unit : str, optional
        Of the value.
    unit_of : str, optional
        Key of the same section that tells the unit instead.
    hint : str
        What else to say when it is refused.

    Examples
    --------
    >>> Number(least=2, most=5, whole=True).allowed
    'must be a whole number from 2 to 5'
    """

    def __init__(
        self,
        above: float | None = None,
        least: float | None = None,
        below: float | None = None,
        most: float | None = None,
        whole: bool = False,
        unit: str = "",
        unit_of: str | None = None,
        hint: str = "",
    ) -> None:
        self.above, self.least, self.below, self.most = above, least, below, most
        self.whole, self.unit, self.unit_of, self.hint = whole, unit, unit_of, hint

    @property
    def allowed(self) -> str:
        """What may be given, in words."""
        return self._in_words(self.unit)

    def json_schema(self) -> dict[str, Any]:
        """Return the JSON schema of what may be given: a number, or a text that spells one.

        Examples
        --------
        >>> Number(above=0, most=5).json_schema()["anyOf"][0]
        {'type': 'number', 'exclusiveMinimum': 0, 'maximum': 5}
        """
        bounds = {
            "exclusiveMinimum": self.above,
            "minimum": self.least,
            "exclusiveMaximum": self.below,
            "maximum": self.most,
        }
        given = {key: bound for key, bound in bounds.items() if bound is not None}
        kind = {"type": "integer" if self.whole else "number", **given}
        return {"anyOf": [kind, {"type": "string", "pattern": _NUMBER_IN_TEXT}]}

    def _in_words(self, unit):
        """Return what may be given, with the unit."""
        words = "must be a whole number" if self.whole else "must be a number"
        if self.least is not None:
            words += f" from {_plain(self.least)}"
            words += " up" if self.most is None else f" to {_plain(self.most)}"
        else:
            ends = [("above", self.above), ("below", self.below), ("at most", self.most)]
            given = [f"{word} {_plain(end)}" for word, end in ends if end is not None]
            words += " " + " and ".join(given)
        return f"{words} {unit}".rstrip() + self.hint

    def __call__(self, value: Any, info: ValidationInfo) -> float:
        """Return the number, or refuse it with all that is allowed.

        Parameters
        ----------
        value : object
            What the YAML file holds at the key.
        info : pydantic.ValidationInfo
            Of the section so far, where the unit may be.

        Returns
        -------
        float, or int for a whole number

        Raises
        ------
        PydanticCustomError
            From `refusal`.
        """
        number = number_of(value)
        if number is None or not self._within(number):
            unit = info.data.get(self.unit_of, "") if self.unit_of else self.unit
            comma = isinstance(value, str) and "," in value and not self.whole
            hint = ", with a decimal point" if comma else ""
            raise refusal(self._in_words(unit) + hint, unit=unit)
        return int(number) if self.whole else float(number)

    def _within(self, number):
        return (
            (self.above is None or number > self.above)
            and (self.least is None or number >= self.least)
            and (self.below is None or number < self.below)
            and (self.most is None or number <= self.most)
            and (not self.whole or number == int(number))
        )


class NumberOrNone(Number):
    """Reads a number within bounds, or nothing where that has a meaning of its own.

    Examples
    --------
    >>> NumberOrNone(least=2)(None, None) is None
    True
    """

    def __call__(self, value: Any, info: ValidationInfo) -> float | None:
        """Return the number, or None for None: as `Number`.

        Parameters
        ----------
        value : object
        info : pydantic.ValidationInfo

        Returns
        -------
        float, int or None

        Raises
        ------
        PydanticCustomError
            From `refusal`.
        """
        return None if value is None else super().__call__(value, info)

    def json_schema(self) -> dict[str, Any]:
        """Return the JSON schema of a number, a text that spells one, or nothing."""
        return {"anyOf": [*super().json_schema()["anyOf"], {"type": "null"}]}


def number_of(value: Any) -> float | None:
    """Return the finite number that a value of the YAML file is or spells, or None.

    Parameters
    ----------
    value : object

    Returns
    -------
    float or None
        A whole number stays an int.

    Examples
    --------
    >>> number_of("1e6"), number_of(True), number_of(float("nan"))
    (1000000.0, None, None)
    """
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        return None
    try:
        # A whole number is kept as one: beyond 2^53 a float is another.
        number = value if isinstance(value, int) else float(value)
        return number if math.isfinite(number) else None
    except (ValueError, OverflowError):
        return None


# Of a key that fills the screen, the beginning tells which it is.
_LONGEST_KEY = 120


def one_line(key: Any) -> str:
    r"""Return a key as text that stays on its line, whatever it holds.

    Parameters
    ----------
    key : object
        Of the YAML file, where a key need not be text.

    Returns
    -------
    str

    Examples
    --------
    >>> one_line("two\nlines"), one_line(3)
    ('two\\nlines', '3')
    """
    text = str(key)
    text = text if len(text) <= _LONGEST_KEY else text[:_LONGEST_KEY] + "..."
    return text if text.isprintable() else repr(text)[1:-1]


def refusal(words: str, **details: Any) -> PydanticCustomError:
    """Return the error of a validator that says what is allowed.

    Parameters
    ----------
    words : str
        What is allowed, or what is wrong.
    **details
        unit: of the value; key, value: below the key that is validated, the one to name and show;
        of_section: True names the section of the key, and no value; missing: True says that the
        key is missing.

    Returns
    -------
    PydanticCustomError
        To be raised.

    Examples
    --------
    >>> print(refusal("must be above min 2 m", unit="m"))
    must be above min 2 m
    """
    return PydanticCustomError("refusal", "{words}", {"words": words, **details})


def _plain(number):
    return f"{number:g}" if isinstance(number, float) else str(number)


def number(kind: type[float] = float, **bounds: Any) -> Any:
    """Return the type of a key that holds a number.

    Parameters
    ----------
    kind : {float, int}
    **bounds
        As those of `Number`.

    Returns
    -------
    type
        For the annotation of the key.

    Examples
    --------
    >>> class Cell(Section):
    ...     grains: number(int, least=2)
    >>> Cell(grains="1e3").grains
    1000
    """
    reader = Number(whole=kind is int, **bounds)
    return Annotated[kind, BeforeValidator(reader), WithJsonSchema(reader.json_schema())]


_SHARE = " (a share: 0.4 is 40 %)"
Positive = number(above=0)
Fraction = number(above=0, below=1, hint=_SHARE)
