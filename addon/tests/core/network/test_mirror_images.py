# SPDX-License-Identifier: GPL-3.0-or-later
"""The images of a network's wires, and what they mark."""

from __future__ import annotations

from seamwire.core.network.drawn import Drawn
from seamwire.core.network.symmetry import MirrorImages
from table import symmetry, wire


def test_wires_and_images_mark_and_clear_and_the_last_one_counts() -> None:
    images = MirrorImages(symmetry())
    network = Drawn((images.completed(wire(0, 1, mirror=(0,))), wire(4, 5, marks=False)))
    assert network.wires[0].images == ((4, 5),)
    assert images.net_effect(network) == ([(0, 1)], [(4, 5)])
    assert images.completed(network.wires[0]) is network.wires[0], "they are found once"


def test_images_that_are_found_late_have_only_edges_that_are_seams() -> None:
    images = MirrorImages(symmetry())
    assert images.completed(wire(0, 1, 2, mirror=(0,)), {(4, 5)}).images == ((4, 5),)


def test_a_wire_that_stays_alone_is_told_of_once() -> None:
    images = MirrorImages(symmetry())
    alone = wire(0, 7, mirror=(0,))  # no such edge on the other side
    assert not images.warning(wire(0, 1, mirror=(0,)))
    assert str(images.warning(alone)).startswith("Part of this wire has no mirror image")
    assert not images.warning(alone)
