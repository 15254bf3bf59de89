"""Tables for notebooks."""

from __future__ import annotations

import html
from collections.abc import Iterable, Sequence
from typing import Any


def escaped(value: Any) -> str:
    """Text as HTML, numbers as text."""
    return html.escape(f"{value:.6g}" if isinstance(value, float) else str(value))


def table(head: Sequence[str], rows: Iterable[Sequence[Any]], caption: str = "") -> str:
    """A table; a cell that is a tuple of one text is HTML already.

    >>> table(["a"], [["<"], [("<i>x</i>",)]], "one & two")
    '<table><caption>one &amp; two</caption><tr><th>a</th></tr><tr><td>&lt;</td></tr><tr><td><i>x</i></td></tr></table>'
    """
    def cell(value: Any) -> str:
        return value[0] if isinstance(value, tuple) else escaped(value)

    parts = [f"<caption>{escaped(caption)}</caption>"] if caption else []
    parts.append("<tr>" + "".join(f"<th>{escaped(one)}</th>" for one in head) + "</tr>")
    parts += ["<tr>" + "".join(f"<td>{cell(one)}</td>" for one in row) + "</tr>" for row in rows]
    return "<table>" + "".join(parts) + "</table>"
