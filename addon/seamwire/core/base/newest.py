# SPDX-License-Identifier: GPL-3.0-or-later
"""Work beside the drawing of which only the newest request counts."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Asked = TypeVar("Asked")
Answer = TypeVar("Answer")


class Newest(Generic[Asked, Answer]):
    """Answers requests with `make` in its own thread. Only the newest waiting request is answered.

    If `make` was stopped for a newer request, it raises `given_up`.
    """

    def __init__(self, make: Callable[[Asked], Answer], name: str, given_up: tuple[type[Exception], ...] = ()) -> None:
        self._make: Callable[[Asked], Answer] | None = make
        self._name = name
        self._given_up = given_up
        self._lock = threading.Lock()
        self._wanted: list[Asked] = []
        self._working = False
        self._closed = False
        self._error: Exception | None = None
        self._answer: Answer | None = None

    @property
    def busy(self) -> bool:
        """Whether something is being computed, or an error waits for `check`."""
        return self._working or self._error is not None

    @property
    def answer(self) -> Answer | None:
        return self._answer

    def check(self) -> None:
        error, self._error = self._error, None
        if error is not None:
            raise error

    @property
    def superseded(self) -> bool:
        return bool(self._wanted) or self._closed

    def want(self, request: Asked) -> None:
        with self._lock:
            if self._closed:
                return
            self._wanted = [request]
            if self._working:
                return
            self._working = True
        threading.Thread(target=self._work, name=self._name, daemon=True).start()

    def answer_now(self, request: Asked) -> None:
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
                self._error = None if self._closed else error
                continue
            if not self._closed:
                self._answer, self._error = made, None
