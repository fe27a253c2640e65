# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks of objects, and networks on the mesh of an object in edit mode. The operators and `seamwire-batch` use these functions."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from .network_file import NetworkFile
from .placing import Shape, tell
from .tool import count
from .transfer import transfer

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence
    from pathlib import Path

    import bpy

    from .placing import Progress
    from .tool import Edge, ObjectSession, Wire
    from .transfer import Place, Transfer

_SHAPE = ("points", "triangles", "edges", "to_object")
"""What describes a `Shape`, in the order of its parameters."""


@dataclass(frozen=True)
class Source:
    """A network, and what is known of the mesh that it was drawn on."""

    network: NetworkFile
    shape: Shape | None = None  # None if there is only a file
    groups: Mapping[str, int] = field(default_factory=dict)  # see `group_middles`

    @classmethod
    def of(cls, mesh: ObjectSession, settings: bpy.types.PropertyGroup, more: Iterable[Wire] = ()) -> Source:
        """Return the network of an object and more wires, with all that is known of its mesh."""
        return cls(network_of(mesh, settings, more), shape_of(mesh), group_middles(mesh.obj))

    @classmethod
    def load(cls, path: Path, with_mesh: bool = False) -> Source:
        """Read a network from a file, `with_mesh` also what `save` has written beside it. Raises ValueError."""
        try:
            network = NetworkFile.parse(path.read_text(encoding="utf-8-sig"))
        except (OSError, UnicodeDecodeError) as error:
            raise ValueError(f"Cannot read the file: {error}") from error
        if not with_mesh:
            return cls(network)
        with np.load(path.with_suffix(".npz")) as data:
            shape = Shape(*(data[name] for name in _SHAPE))
            return cls(network, shape, dict(zip(data["groups"].tolist(), data["middles"].tolist(), strict=True)))

    def save(self, path: Path) -> None:
        """Write the network to a JSON file, and what is known of the mesh to a file beside it that NumPy reads."""
        path.write_text(self.network.text(), encoding="utf-8")
        np.savez(
            path.with_suffix(".npz"),
            groups=np.array(list(self.groups)),
            middles=np.array(list(self.groups.values()), dtype=np.int64),
            **{name: getattr(self.shape, name) for name in _SHAPE},
        )


def shape_of(mesh: ObjectSession) -> Shape:
    arrays = mesh.arrays
    return Shape(arrays.points, arrays.triangles, arrays.edges, arrays.to_object)


def seam_wires(mesh: ObjectSession, progress: Progress = lambda _: True) -> list[Wire]:
    """Find wires along the seams of an object that have none. The object is not changed. Any thread may do this."""
    found, done = [], 0
    for wire in mesh.session.wires_along(mesh.plain_seams):
        tell(progress, done / len(mesh.plain_seams))
        found.append(wire)
        done += len(wire.edges())
    return found


def network_of(mesh: ObjectSession, settings: bpy.types.PropertyGroup, more: Iterable[Wire] = ()) -> NetworkFile:
    """Return the network of an object, and more wires, as they are saved to a file."""
    network = replace(mesh.session.drawn, wires=(*mesh.session.wires, *more))
    name = mesh.cage.data.name
    return NetworkFile.of(network, shape_of(mesh), name=name, metric=settings.metric, clamp=settings.clamp)


def group_middles(obj: bpy.types.Object) -> dict[str, int]:
    """Return for each vertex group that is not empty the vertex nearest to its middle, by the group's name."""
    obj.update_from_editmode()
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
    source: Source,
    *,
    place: Place = "AUTO",
    mirror: int | None = None,
    align: bool = True,
    pairs: Sequence[Edge] = (),
) -> Callable[..., Transfer]:
    """Return what finds what a network is on a mesh. It writes nothing, takes `progress`, and any thread may call it.

    Other parameters are those of `transfer`. Without pairs of vertices, PAIRS takes the vertex groups with the same names. Raises
    ValueError if these are too few; the function raises it if something else does not fit.
    """
    if place == "PAIRS" and not pairs:
        there = group_middles(target.obj)
        pairs = [(source.groups[name], there[name]) for name in source.groups if name in there]
        if len(pairs) < 3:
            raise ValueError(
                f"Give at least three pairs of vertices: the objects share {count(len(pairs), 'vertex group')}"
            )
    return partial(
        transfer,
        source.network,
        shape_of(target),
        place=place,
        mirror=mirror,
        align=align,
        source=source.shape,
        pairs=pairs,
        topology=target.cage.data.use_mirror_topology,
        live=target.make_live,
    )


def add(target: ObjectSession, found: Transfer) -> int:
    """Add what `carry_over` found to a mesh, which can be written then. Return how many wires it did not have."""
    there = {wire.vertices for wire in target.session.wires}
    new = [wire for wire in found.wires if wire.vertices not in there]
    target.add(new, found.strokes)
    return len(new)
