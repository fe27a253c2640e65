# SPDX-License-Identifier: GPL-3.0-or-later
"""Work beside the drawing of which only the newest request counts."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Request = TypeVar("Request")
Answer = TypeVar("Answer")


class Newest(Generic[Request, Answer]):
    """Answers requests in its own thread. Only the newest waiting request is answered.

    Parameters
    ----------
    make
        Answers one; called on the thread.
    name
        The thread's.
    given_up
        What `make` raises where it was stopped for a newer request.
    """

    def __init__(
        self, make: Callable[[Request], Answer], name: str, given_up: tuple[type[Exception], ...] = ()
    ) -> None:
        self._make: Callable[[Request], Answer] | None = make
        self._name = name
        self._given_up = given_up
        self._lock = threading.Lock()
        self._wanted: list[Request] = []
        self._working = False
        self._closed = False
        self._error: Exception | None = None
        self._answer: Answer | None = None

    @property
    def busy(self) -> bool:
        """Whether something is being computed."""
        return self._working

    @property
    def answer(self) -> Answer | None:
        """The latest result. Raises what went wrong on the thread."""
        if self._error is not None:
            raise self._error
        return self._answer

    @property
    def superseded(self) -> bool:
        """Whether what is being computed is not wanted any more."""
        return bool(self._wanted) or self._closed

    def want(self, request: Request) -> None:
        """Ask for something."""
        with self._lock:
            if self._closed:
                return
            self._wanted = [request]
            if self._working:
                return
            self._working = True
        threading.Thread(target=self._work, name=self._name, daemon=True).start()

    def answer_now(self, request: Request) -> None:
        """Answer at once, on the thread that asks."""
        if self._make is not None:
            self._answer = self._make(request)

    def close(self) -> None:
        """Drop what is asked for; a running computation ends unseen."""
        with self._lock:
            self._closed = True
            self._wanted = []
            # `make` often belongs to the owner of this object. Python would free neither until it looks for cycles.
            self._make = None

    def _work(self) -> None:
        while True:
            with self._lock:
                if self._make is None or not self._wanted:
                    self._working = False
                    return
                make, request = self._make, self._wanted.pop()
            try:
                made = make(request)
            except self._given_up:
                continue
            except Exception as error:
                # The main thread raises it: here nobody would see it.
                self._error = error
                self._working = False
                return
            if not self._closed:
                self._answer = made
