# SPDX-License-Identifier: GPL-3.0-or-later
"""Work that can be stopped: a generator that yields the finished fraction, and returns the result."""

from __future__ import annotations

from collections.abc import Callable, Generator
from typing import TypeVar

_Result = TypeVar("_Result")

Work = Generator[float, None, _Result]
PLACED = 0.3
"""The fraction that is finished when the first wire is drawn: before that, seeds are placed."""


def _always(_fraction: float) -> bool:
    return True


def result_of(work: Work[_Result], progress: Callable[[float], bool] = _always) -> _Result | None:
    """Do work to its end.

    Parameters
    ----------
    work
        The work.
    progress
        Takes the finished fraction, and returns whether to continue.

    Returns
    -------
    object
        The result, or None if `progress` has stopped the work.
    """
    while True:
        try:
            fraction = next(work)
        except StopIteration as end:
            return end.value
        if not progress(fraction):
            work.close()
            return None
