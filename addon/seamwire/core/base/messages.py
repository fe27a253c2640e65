# SPDX-License-Identifier: GPL-3.0-or-later
"""What there is to tell the artist, as codes and values. The words are not here, see ``words/sentences.py``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable


@dataclass(frozen=True)
class Message:
    """Something to tell: a code, and the values that its sentence needs. It is false if there is nothing to tell."""

    code: str = ""
    values: tuple[tuple[str, object], ...] = ()

    @classmethod
    def of(cls, code: str, /, **values: object) -> Message:
        """Return the message with a code and values."""
        return cls(code, tuple(values.items()))

    def __bool__(self) -> bool:
        return bool(self.code)

    def __str__(self) -> str:
        return _wording(self)


NOTHING = Message()
"""There is nothing to tell."""


class Told(Exception):  # noqa: N818 - the base of errors, which end in Error
    """An error with a message for the artist, or its code and values."""

    def __init__(self, why: str | Message, /, **values: object) -> None:
        self.message = Message.of(why, **values) if isinstance(why, str) else why
        super().__init__(self.message.code)

    def __str__(self) -> str:
        return str(self.message)


class Refused(Told, ValueError):  # noqa: N818 - the same
    """Something cannot be done."""


def message_of(error: Exception) -> Message:
    """Return what an error tells; errors of the library bring their own words."""
    return error.message if isinstance(error, Told) else Message.of("library", text=str(error))


def word_with(wording: Callable[[Message], str]) -> None:
    """Let messages become text by a function."""
    global _wording
    _wording = wording


def _bare(message: Message) -> str:
    return " ".join((message.code, *(f"{name}={value}" for name, value in message.values)))


_wording: Callable[[Message], str] = _bare
