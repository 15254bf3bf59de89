"""Options of methods that take parameters of a case by name too."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from functools import wraps
from inspect import Parameter, signature
from typing import Any, TypeVar

Method = TypeVar("Method", bound=Callable[..., Any])


def options_first(method: Method) -> Method:
    """Says so where a name that is given is an option of the method and a parameter of the case: it is the option."""
    options = {name for name, one in signature(method).parameters.items()
               if one.kind in (Parameter.KEYWORD_ONLY, Parameter.POSITIONAL_OR_KEYWORD)}

    @wraps(method)
    def called(self: Any, *arguments: Any, **given: Any) -> Any:
        for name in options.intersection(given, self.parameters):
            warnings.warn(f"{name} is an option of {method.__name__}, and is taken as that; the parameter of this case "
                          f"is set by with_values({{'{name}': ..}})", UserWarning, stacklevel=2)
        return method(self, *arguments, **given)

    return called  # type: ignore[return-value]
