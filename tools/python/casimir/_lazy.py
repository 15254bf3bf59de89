"""Modules that are read when something of them is wanted: half of the time of an import is in their classes."""

from __future__ import annotations

from importlib import import_module
from typing import Any


class Lazy:
    """A module of this package, read at the first use."""

    def __init__(self, name: str):
        self._name = name

    def __getattr__(self, attribute: str) -> Any:
        return getattr(import_module(self._name, __package__), attribute)
