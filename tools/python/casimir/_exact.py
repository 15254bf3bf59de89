"""Numbers and expressions on their way between Python and the exact language of case files."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from functools import lru_cache
from fractions import Fraction
from numbers import Rational
from typing import TYPE_CHECKING, Any, Union

from ._errors import RequestError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

#: What stands for an exact number or an expression: text in the notation of case files, an integer,
#: a fraction, a float (which is exactly the number that it is: 0.1 is not 1/10), or a SymPy expression.
Expression = Union[str, int, float, Fraction, Any]


@lru_cache(maxsize=None)
def _sympy_printer() -> Any:
    """What writes expressions of SymPy in the notation of case files."""
    from sympy.printing.str import StrPrinter

    class Printer(StrPrinter):
        """Names of symbols as they are, constants and functions as case files call them, and numbers exactly."""

        def _print_Pi(self, expression: Any) -> str:
            return "Pi"

        def _print_Exp1(self, expression: Any) -> str:
            return "exp(1)"

        def _print_Abs(self, expression: Any) -> str:
            return f"abs({self._print(expression.args[0])})"

        def _print_Float(self, expression: Any) -> str:
            sign, mantissa, exponent, _ = expression._mpf_
            if not mantissa and exponent:
                raise RequestError(f"{expression} is not a number")
            exact = (-1) ** sign * int(mantissa) * Fraction(2) ** exponent
            return f"({text_of(exact)})"

    return Printer()


def text_of(value: Expression) -> str:
    """The expression in the notation of case files.

    >>> text_of("sqrt(2)/2"), text_of(Fraction(1, 3)), text_of(0.5)
    ('sqrt(2)/2', '1/3', '1/2')
    """
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        raise RequestError(f"{value} is not a number")
    if isinstance(value, Rational):
        value = Fraction(value)
        return str(value.numerator) if value.denominator == 1 else f"{value.numerator}/{value.denominator}"
    if isinstance(value, float):
        if not math.isfinite(value):
            raise RequestError(f"{value} is not a number")
        return text_of(Fraction(value))
    if hasattr(value, "free_symbols"):  # SymPy
        return str(_sympy_printer().doprint(value)).replace("**", "^")
    if hasattr(value, "item"):  # a scalar of NumPy
        return text_of(value.item())
    raise RequestError(f"{value!r} is no expression: text, a number or a SymPy expression is")


def whole(name: str, value: int, low: int, high: int) -> int:
    """The number, where it is in the range.

    >>> whole("degree", 2, 0, 1000)
    2
    """
    if not low <= value <= high:
        raise RequestError(f"{name} is {value}, and goes from {low} to {high}")
    return value


def is_float(value: Expression) -> bool:
    """Whether the number was rounded to binary digits: a float, or one of NumPy's.

    >>> is_float(0.5), is_float("0.5"), is_float(1)
    (True, False, False)
    """
    return isinstance(getattr(value, "item", lambda: value)(), float)


def texts_of(values: Expression | Iterable[Expression] | None) -> list[str]:
    """A list of expressions; one alone is a list of one."""
    if values is None:
        return []
    if isinstance(values, (list, tuple, set, frozenset)):
        return [text_of(value) for value in values]
    return [text_of(values)]


def pairs_of(values: Mapping[str, Expression] | None) -> list[tuple[str, str]]:
    """Names with expressions."""
    if not isinstance(values, (Mapping, type(None))):
        raise TypeError(f"names with their values are expected, {{'x': 1}}, and not {type(values).__name__}")
    return [(str(name), text_of(value)) for name, value in (values or {}).items()]


def reals(values: ArrayLike) -> NDArray:
    """An array of doubles, one row after the other; of complex numbers NumPy would drop a part."""
    import numpy

    array = numpy.asarray(values)
    if numpy.iscomplexobj(array):
        raise TypeError("an array of complex numbers, where real ones are expected")
    return numpy.ascontiguousarray(array, dtype=float)


def number_of(text: str) -> Fraction | str:
    """A fraction where the text is one, and otherwise the text, as of '2*atan(1/3)'."""
    try:
        return Fraction(text)
    except ValueError:
        return text
