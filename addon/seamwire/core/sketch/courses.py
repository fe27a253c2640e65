# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the requests of a network run: found in the background, in the order of the network, and remembered for undo."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple
from weakref import WeakKeyDictionary

from ..base.refused import Refused
from ..network.network import Given, Request
from ..network.wires import Wire
from ..solver.solver import MOST_WAITS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from ..network.network import CourseKey
    from ..solver.solver import LiveWire


@dataclass(frozen=True, eq=False)
class Course:
    """Where one request runs.

    Parameters
    ----------
    wires
        Its wires as far as they are known, those of a line one after another.
    final
        Whether they stay as they are.
    choices
        The ways that *W* goes through, beginning with that without `turns`. Empty if they are not known.
    reason
        Why it has no wire, or not the wire that was asked for.
    """

    wires: tuple[Wire, ...] = ()
    final: bool = False
    choices: tuple[Wire, ...] = ()
    reason: str = ""


UNKNOWN = Course()


class Search(NamedTuple):
    """Finds the course of one request: courses that come nearer to it, of which the last one is final.

    If there is no course, asking for the next one raises ValueError. `lives` returns the live wires that compute for it now.
    """

    courses: Iterator[Course]
    lives: Callable[[], Sequence[LiveWire]]

    @classmethod
    def of(cls, live: LiveWire, courses: Iterator[Course]) -> Search:
        """Search with one live wire. If it says many times that its work is done, and no course is final, that raises Refused."""

        def patiently() -> Iterator[Course]:
            waits, is_done = 0, live.progress() >= 1.0
            for course in courses:
                waits = waits + 1 if is_done and live.progress() >= 1.0 else 0
                if waits > MOST_WAITS and not course.final:
                    raise Refused("The computation ended without a result: this step was dropped")
                yield course
                is_done = live.progress() >= 1.0

        return cls(patiently(), lambda: (live,))


class Courses:
    """The course of each request. Each is found once, as soon as all requests before it have their courses, and is never changed.

    So a course depends on its request, on the final courses of earlier requests, and on the settings and strokes at the time of the edit,
    which the search has. Requests that undo took back are searched on only when redo brings them back.

    Attributes
    ----------
    unfinished
        The requests of the network, in order, whose courses are not final.
    """

    def __init__(self) -> None:
        self._known: WeakKeyDictionary[CourseKey, Course] = WeakKeyDictionary()
        self._searches: WeakKeyDictionary[CourseKey, Search] = WeakKeyDictionary()
        self.unfinished: list[Request] = []

    def of(self, request: Request) -> Course:
        found = self._known.get(request.key)
        if found is None and isinstance(request, Given):
            found = self._known[request.key] = Course((request.wire,), final=True)
        return found or UNKNOWN

    def begin(self, request: Request, course: Course, search: Search | None = None) -> None:
        self._known[request.key] = course
        if search is not None and not course.final:
            self._searches[request.key] = search

    def unknown(self, requests: Iterable[Request]) -> list[Request]:
        """Return those of some requests that are not searched for, and have no course."""
        return [own for own in requests if own.key not in self._known and not isinstance(own, Given)]

    def follow(self, requests: Iterable[Request]) -> list[tuple[Request, Course]]:
        """Search for these requests from now on, in their order. Return them with their courses."""
        found = [(own, self._known.get(own.key) or self.of(own)) for own in requests]
        self.unfinished = [own for own, course in found if not course.final]
        return found

    def lives(self) -> list[LiveWire]:
        return [live for own in self.unfinished[:1] for live in self._searches[own.key].lives()]

    def step(self) -> tuple[Request, bool]:
        """Search on for the first unfinished request. Return it, and whether it has another course now."""
        own = self.unfinished[0]
        before = self.of(own)
        return own, self._searched(own) is not before

    def give_up(self, reason: str = "") -> None:
        """Let everything stay as it is shown, because nothing more is looked for."""
        for own in self.unfinished:
            shown = self.of(own)
            self._end(own, Course(shown.wires, final=True, reason=reason))
        self.unfinished = []

    def _searched(self, request: Request) -> Course:
        try:
            course = next(self._searches[request.key].courses)
        except StopIteration:
            raise AssertionError("A search ended without a final course") from None
        except ValueError as error:
            was = getattr(request, "was", None)
            course = Course(() if was is None else (was,), final=True, reason=str(error))
        before = self.of(request)
        if course.final:
            self._end(request, course)
        elif len(course.wires) != len(before.wires) or not all(map(Wire.like, course.wires, before.wires)):
            self._known[request.key] = course
        return self.of(request)

    def _end(self, request: Request, course: Course) -> None:
        self._searches.pop(request.key, None)
        self._known[request.key] = course
