# SPDX-License-Identifier: GPL-3.0-or-later
"""Kept wires that take another course between their seeds, as soon as it is computed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from .seed_drag import Courses, Leg

if TYPE_CHECKING:
    from .network import Network, Wire
    from .solver import LiveWire


@dataclass(frozen=True, eq=False)
class Job:
    """A wire that is to take its other way.

    Parameters
    ----------
    leg
        Finds its courses.
    """

    leg: Leg

    @property
    def wire(self) -> Wire:
        """The wire as it was."""
        return self.leg.wire


class Redraws:
    """The wires that are drawn anew at present."""

    def __init__(self) -> None:
        self._jobs: list[Job] = []

    def __len__(self) -> int:
        return len(self._jobs)

    def add(self, job: Job) -> None:
        """Begin with one more."""
        self._jobs.append(job)

    def drop_last(self) -> bool:
        """Forget the last wire that was to take its other way; return whether there was one."""
        return bool(self._jobs) and self._jobs.pop() is not None

    def clear(self) -> None:
        """Forget all."""
        self._jobs.clear()

    def lives(self) -> list[LiveWire]:
        """Return what computes them."""
        return [job.leg.live for job in self._jobs]

    def done(self) -> Iterator[tuple[Job, Courses | ValueError]]:
        """Yield those whose courses are there, or why there are none, and forget them."""
        for job in list(self._jobs):
            try:
                courses = job.leg.trace(job.wire.end, job.wire.end)
            except ValueError as error:
                self._jobs.remove(job)
                yield job, error
                continue
            if courses.final:
                self._jobs.remove(job)
                yield job, courses


def with_other_way(network: Network, own: Wire, other: Wire) -> Network | None:
    """Return a network where a wire runs another way; None where no way is left."""
    after = network.after(own)
    if after is not None and isinstance(own.end, tuple) and other.last_edge == own.last_edge[::-1]:
        # What goes on from the edge leaves it over this vertex: arriving there is enough.
        other = replace(other, vertices=other.vertices[:-1], points=other.points[:-1])
        if len(other.vertices) < 2:
            return None
    return network.with_courses({own.id: replace(own, alternative=other).toggled()})


def other_way(own: Wire, courses: Courses) -> Wire | None:
    """Return which of both courses a wire does not take; None: both run as it does."""
    others = [way for way in courses.ways if way is not None and not way.like(own)]
    if not others:
        return None
    return others[-1] if own.follow == 0 else others[0]
