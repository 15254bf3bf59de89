"""How far long work is."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Union

#: A function of the share that is done, from 0 to 1; a bar of tqdm, or whatever has `n`, `total` and
#: `update(more)` like one; or None.
Progress = Union[Callable[[float], object], Any, None]


def told(progress: Progress) -> Callable[[float], object] | None:
    """The function for it. A bar without a total gets that of 1.

    >>> class Bar:
    ...     n, total = 0, 200
    ...     def update(self, more):
    ...         self.n += more
    >>> bar = Bar()
    >>> told(bar)(0.25)
    >>> bar.n
    50.0
    """
    if not hasattr(progress, "update"):
        return progress
    if progress.total is None:
        progress.total = 1

    def tell(share: float) -> None:
        progress.update(share * progress.total - progress.n)

    return tell
