# SPDX-License-Identifier: GPL-3.0-or-later
"""Work of which only the newest request counts."""

from __future__ import annotations

import gc
import time
import weakref
from collections.abc import Iterator

import pytest
from seamwire.core.base.newest import Newest


class Owner:
    """Makes its answers with its own method."""

    def __init__(self) -> None:
        self.newest: Newest[int, int] = Newest(self.make, "test")

    def make(self, request: int) -> int:
        return 2 * request


@pytest.fixture
def without_cycles() -> Iterator[None]:
    """Let Python not look for cycles meanwhile."""
    gc.disable()
    yield
    gc.enable()


@pytest.mark.usefixtures("without_cycles")
@pytest.mark.parametrize("on_thread", [False, True])
def test_closing_frees_the_owner_at_once(on_thread: bool) -> None:
    owner = Owner()
    (owner.newest.want if on_thread else owner.newest.answer_now)(3)
    end = time.monotonic() + 20.0
    while owner.newest.busy:
        assert time.monotonic() < end
        time.sleep(0.001)
    assert owner.newest.answer == 6
    gone = weakref.ref(owner)
    owner.newest.close()
    del owner
    while on_thread and gone() is not None:  # the thread may be about to end
        assert time.monotonic() < end
        time.sleep(0.001)
    assert gone() is None


def test_a_closed_one_keeps_its_answer_and_makes_no_other() -> None:
    owner = Owner()
    owner.newest.answer_now(3)
    owner.newest.close()
    owner.newest.answer_now(4)
    owner.newest.want(5)
    assert not owner.newest.busy
    assert owner.newest.answer == 6
