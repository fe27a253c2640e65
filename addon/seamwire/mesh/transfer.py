# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks of files and of other objects on the mesh of an object in edit mode."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from ..core.matching import transfer
from ..core.matching.placing import Shape
from .object_session import ObjectSession

if TYPE_CHECKING:
    from collections.abc import Sequence

    import bpy

    from ..core.base.mesh_arrays import Arrays
    from ..core.matching.transferred import Transfer
    from ..core.network.picks import Edge
    from ..core.storage.network_file import NetworkFile
    from .settings import SeamwireSettings

Place = Literal["AUTO", "NUMBERS", "SURFACE", "PAIRS"]
"""How the places of seeds are found: by vertex numbers, on the nearest surface, or by distances to pairs of vertices. AUTO takes numbers
if the topology is the same, otherwise pairs if there are any, otherwise the surface."""


def shape_of(arrays: Arrays) -> Shape:
    """Return a mesh as it takes part in a transfer."""
    return Shape(arrays.points, arrays.triangles, arrays.edges, arrays.to_object)


def network_of(source: ObjectSession, settings: SeamwireSettings) -> NetworkFile:
    """Return the network of an object; its seams without wires are wires in it, and stay as they are in the mesh.

    Raises
    ------
    ValueError
        Where it has no seams.
    """
    session = source.session
    found = tuple(session.drawing.wires_along(source.plain_seams))
    if not session.wires and not found:
        raise ValueError(f"{source.obj.name} has no seams")
    return source.network_file(settings, found)


def pairs_of_groups(source: bpy.types.Object, target: bpy.types.Object) -> list[Edge]:
    """Return a vertex of each object for every name that vertex groups of both have: the one in the group's middle."""
    here, there = group_middles(source), group_middles(target)
    return [(here[name], there[name]) for name in here if name in there]


def group_middles(obj: bpy.types.Object) -> dict[str, int]:
    """Return by their names the vertex that is nearest to the middle of each vertex group that has any."""
    members: dict[int, list[tuple[int, float]]] = {}
    for vertex in obj.data.vertices:
        for membership in vertex.groups:
            if membership.weight > 0.0:
                members.setdefault(membership.group, []).append((vertex.index, membership.weight))
    middles = {}
    for group in obj.vertex_groups:
        if group.index in members:
            numbers, weights = zip(*members[group.index], strict=True)
            places = np.array([obj.data.vertices[number].co for number in numbers])
            middle = np.average(places, axis=0, weights=weights)
            middles[group.name] = numbers[int(np.linalg.norm(places - middle, axis=1).argmin())]
    return middles


def carry_over(
    target: ObjectSession,
    file: NetworkFile,
    *,
    place: Place = "AUTO",
    mirror: int | None = None,
    align: bool = True,
    source: Shape | None = None,
    pairs: Sequence[Edge] = (),
) -> Transfer:
    """Find what a network is on a mesh; nothing is written.

    Parameters
    ----------
    target
        The mesh.
    file
        The network.
    place
        How seeds are placed.
    mirror, align
        As ``core.transfer.by_surface`` takes them; `mirror` rules out the other ways.
    source
        The mesh that the network was drawn on. None if it is not available, and then pairs are ignored.
    pairs
        Vertices of both.

    Raises
    ------
    ValueError
        Where that cannot be.
    """
    arrays = target.arrays
    shape = shape_of(arrays)
    if mirror is not None and place in {"NUMBERS", "PAIRS"}:
        raise ValueError("Mirror needs Place: Nearest Surface")
    if place == "AUTO":
        same = mirror is None and not file.problem_with(target.cage.vertex_count, arrays.edges)
        place = "NUMBERS" if same else "PAIRS" if pairs and mirror is None else "SURFACE"
    if place == "NUMBERS":
        return transfer.by_numbers(file, shape, topology=target.cage.mesh.use_mirror_topology)
    if place == "SURFACE":
        return transfer.by_surface(file, shape, mirror=mirror, align=align, live=target.make_live)
    if source is None:
        raise ValueError("Pairs need the source object")
    return transfer.by_landmarks(file, source, shape, pairs, live=target.make_live)


def write(target: ObjectSession, found: Transfer) -> tuple[int, int]:
    """Let a mesh have what `carry_over` found; return how many wires it did not have, and how many edges became seams."""
    there = {wire.vertices for wire in target.session.wires}
    new = [wire for wire in found.wires if wire.vertices not in there]
    target.add(new, found.strokes)
    marked, _ = target.write(target.plan())
    return len(new), marked
