"""Case files from their parts."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from ._exact import text_of


def _quoted(value: str) -> str:
    return json.dumps(value, ensure_ascii=False)


def _table(head: str, entries: Mapping[str, Any]) -> list[str]:
    return [f"\n[{head}]"] + [f"{_quoted(str(name))} = {_quoted(text_of(value))}" for name, value in entries.items()]


def case_text(title, hamiltonian, equations, space, parameters, assume, named, integrable, initial, duration) -> str:
    """A case file from its parts; None is left out."""
    lines = [f"title = {_quoted(title)}"]
    if integrable:
        lines.append("integrable = true")
    if hamiltonian is not None:
        lines.append(f"hamiltonian = {_quoted(text_of(hamiltonian))}")
    lines.append("\n[phase_space]")
    brackets = space.pop("brackets")
    for key, value in space.items():
        if value is not None:
            lines.append(f"{key} = {'true' if value is True else json.dumps(value, ensure_ascii=False)}")
    if brackets is not None:
        lines += _table("phase_space.brackets", brackets)
    if parameters:
        lines.append("\n[parameters]")
        for name in parameters:
            condition = f" assume = {_quoted(assume[name])} " if name in assume else ""
            lines.append(f"{_quoted(name)} = {{{condition}}}")
    for head, entries in {**named, "equations": equations}.items():
        if entries:
            lines += _table(head, entries)
    if initial is not None:
        values = {name: value for name, value in parameters.items() if value is not None}

        def inline(entries):
            return "{ " + ", ".join(f"{_quoted(n)} = {_quoted(text_of(v))}" for n, v in entries.items()) + " }"

        lines += ["\n[[scene]]", 'name = "default"', f"initial = {inline(initial)}"]
        if values:
            lines.append(f"parameters = {inline(values)}")
        if duration is not None:
            lines.append(f"duration = {_quoted(text_of(duration))}")
    return "\n".join(lines) + "\n"
