"""Certificates, verified."""

from __future__ import annotations

from os import PathLike
from typing import TYPE_CHECKING

from . import _core

if TYPE_CHECKING:
    from ._measured import Checked


def check(file: str | PathLike[str], *, time_limit: float = 0) -> Checked:
    """Verifies a file of certificates, of an enclosure, of cycles or of a horseshoe.

    Nothing in it is believed: integrals are proved again, and every step is verified in Arb's arithmetic.

    :raises CaseError: for what is no such file.

    >>> import tempfile
    >>> from casimir import load
    >>> path = tempfile.mktemp(suffix=".json")
    >>> box = load("euler").enclose(duration=1, certificate=path)
    >>> checked = check(path)
    >>> checked.kind, checked.holds, checked.parts[0]["integrals"]
    ('run', True, ['H', 'F1'])
    """
    from . import _measured

    try:
        with open(file, encoding="utf-8", errors="replace") as stream:
            text = stream.read(2**29 + 1)
    except OSError as problem:
        from ._errors import CaseError

        raise CaseError(f"{file}: the certificate does not exist or cannot be read") from problem
    return _measured.checked_of(*_core.checked(text, str(file), time_limit))
