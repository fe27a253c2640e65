# SPDX-License-Identifier: GPL-3.0-or-later
"""What a drawing asks of the mesh, done: wires slid onto, and cut into faces.

Each function takes the session of an object and returns the session that goes on: afterwards vertices may have other numbers.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..core.base import native
from ..core.network.picks import FacePoint
from ..core.seams.seam_wires import wires_between
from ..core.seams.slide_plan import plan as plan_slide
from ..words.reports import count, not_cut
from . import cut as mesh_cut
from . import slide as mesh_slide
from .cut import CutError
from .edit_mesh import restored_after_errors
from .object_session import ObjectSession

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Mapping

    from seamwire_core import CutCurve, CutPlan

    from ..core.network.picks import Edge
    from ..core.network.wires import Wire
    from ..core.offers.surface_loops import TakenCut
    from ..core.sketch.change import Change
    from ..terms.choices import Finish
    from .cut import Cut


@dataclass(frozen=True)
class Finished:
    """What became of wires across the surface when their chain ended."""

    slid: str = ""  # what was slid
    cut: Cut | None = None
    problem: str = ""  # why nothing was cut

    @property
    def text(self) -> str:
        """The report; an empty text if nothing was done."""
        parts = [self.slid] if self.slid else []
        if self.cut is not None:
            if self.cut.wires:
                parts.append(f"{count(self.cut.wires, 'wire')} cut, {count(len(self.cut.edges), 'edge')} marked")
            parts += not_cut(self.cut.uncut, self.cut.left_out)
        if self.problem:
            parts.append(f"not cut: {self.problem}")
        return ", ".join(parts)


def apply(mesh: ObjectSession, change: Change) -> tuple[ObjectSession, Finished]:
    """Let the mesh do what a change asks, once it has the wires: finish them.

    The session of the mesh ends if anything is done. Returns the session that goes on, and the counts of everything that was done. After an
    unexpected error the mesh is restored, with the wires along edges.
    """
    if not any(map(change.finishes, mesh.session.wires)):
        return mesh, Finished()
    with restored_after_errors(mesh.obj):
        return _apply(mesh, change)


def _apply(mesh: ObjectSession, change: Change) -> tuple[ObjectSession, Finished]:
    wires = [wire for wire in mesh.session.wires if change.finishes(wire)]
    drawn = {wire.vertices: wire.finish for wire in wires}
    finished = Finished()
    slid = [wire for wire in wires if wire.finish == "SLIDE"]
    if slid:
        mesh, moved = move(mesh, slid, "SLIDE")
        finished = Finished(f"Slide: {count(len(slid), 'wire')}, {count(moved, 'vertex', 'vertices')} moved")
        wires = [wire for wire in mesh.session.wires if drawn.get(wire.vertices) == wire.finish]
    # Cuts come last, because they renumber.
    cuts = [wire for wire in wires if wire.cuts]
    if not cuts:
        return mesh, finished
    try:
        mesh, done = cut(mesh, plan_cut(mesh, cuts), cuts, kept=True)
    except CutError as error:
        return mesh, replace(finished, problem=str(error))
    return mesh, replace(finished, cut=done)


def move(mesh: ObjectSession, wires: Collection[Wire], finish: Finish) -> tuple[ObjectSession, int]:
    """Slide the vertices of snapped wires, and of their mirror images, onto the wires, if that is the finish. The mesh has these wires.

    Returns the session that goes on, and the number of moved vertices.
    """
    if not wires or finish != "SLIDE":
        return mesh, 0
    own = {wire: [wire, *mesh.session.mirrored(wire)] for wire in wires}
    courses = [(image.vertices, image.points) for images in own.values() for image in images]
    seams = {edge for images in own.values() for image in images for edge in image.edges()}
    vertices = {vertex for chain, _ in courses for vertex in chain}
    stiff = mesh_slide.stiff_vertices(mesh.cage, vertices, seams)
    moves = plan_slide(mesh_slide.faces_at(mesh.cage, mesh.arrays, vertices), courses, stiff)
    if not moves:
        return mesh, 0
    mesh_slide.carry_out(mesh.obj, mesh.cage, moves)
    # The stored wire has the positions of its vertices. It is written again with the same curve.
    after = ObjectSession(mesh.obj)
    curve_of = {wire.vertices: wire.points for wire in wires}
    drawn = after.session.drawn
    kept = [
        wire.changed(points=curve_of[wire.vertices], faces=None) if wire.vertices in curve_of else wire
        for wire in drawn.wires
    ]
    after.session.adopt(replace(drawn, wires=tuple(kept)), after.plain_seams)
    _go_on_with(after, mesh.session.offering.cuts.taken(mesh.session.drawn))
    after.write(after.plan())
    return after, len(moves)


def plan_cut(mesh: ObjectSession, wires: Iterable[Wire]) -> CutPlan:
    """Find what wires across the surface and their mirror images cut, and try it on a copy of the edit mesh.

    The plan leaves out wires that do not run over the mesh, by their numbers here, and mirror images, by higher numbers. Raises CutError
    if no wire runs over the mesh, or nothing is cut.
    """
    wires = list(wires)
    images = [
        (number, image) for number, wire in enumerate(wires) for image in mesh.session.mirrored(wire, curves=True)
    ]
    curves = [_curve(wire) for wire in wires] + [_curve(image, number) for number, image in images]
    plan = mesh_cut.plan(mesh.arrays, curves)
    mesh_cut.rehearse(mesh.cage, plan)
    return plan


def cut(
    mesh: ObjectSession,
    plan: CutPlan,
    wires: Collection[Wire],
    kept: bool = False,
    crumb: float = 0.0,
) -> tuple[ObjectSession, Cut]:
    """Cut the mesh as `plan_cut` has planned for these wires, and return the session that goes on.

    Wires that are cut become wires along edges, between the seeds of those across the surface. The others stay as they are. Vertices, edges
    and faces have other numbers then.

    Parameters
    ----------
    kept
        Whether the mesh has these wires already: their snapped edges cease to be seams.
    crumb
        The part of the mesh's area below which an island beside the cuts becomes part of a larger one.
    """
    taken = mesh.session.offering.cuts.taken(mesh.session.drawn)
    skipped = [number for number, _ in plan.left_out if number < len(wires)]
    wires = [wire for number, wire in enumerate(wires) if number not in skipped]
    if kept:
        for wire in wires:
            mesh.session.drop(wire)
        mesh.write(mesh.plan())
    seeds = {end for wire in wires for end in (wire.start, wire.end)}
    done = mesh_cut.carry_out(mesh.cage, plan, seeds, crumb)
    after = ObjectSession(mesh.obj)
    claimed = {edge for wire in after.session.wires for edge in wire.claims()}
    after.take_over(_cut_wires(after, {edge for edge in done.edges if edge not in claimed}, wires, done.seeds))
    _go_on_with(after, taken)
    after.write(after.plan())
    return after, replace(done, wires=len(wires), left_out=len(plan.left_out))


def _go_on_with(mesh: ObjectSession, taken: Iterable[TakenCut]) -> None:
    """Let closed cuts that were taken before the mesh was changed be bent on it."""
    own = (each.of(mesh.session.drawn) for each in taken)
    mesh.session.offering.cuts.recall(each for each in own if each is not None)


def _cut_wires(
    mesh: ObjectSession, edges: set[Edge], wires: Collection[Wire], seeds: Mapping[int | FacePoint, int]
) -> Iterator[Wire]:
    """Yield wires along edges that others were cut along, between their seeds; what is the image of one is no other."""
    pairs = np.array(sorted(edges), dtype=np.int32).reshape(-1, 2)
    between = list(wires_between(pairs, set(seeds.values()), mesh.arrays.points))
    origin = {frozenset((seeds.get(wire.start), seeds.get(wire.end))): wire for wire in wires}
    mirrors = {wire.mirror for wire in wires}
    shared = mirrors.pop() if len(mirrors) == 1 else ()
    planned = all(wire.planned for wire in wires)
    between.sort(key=lambda wire: frozenset((wire.start, wire.end)) not in origin)
    left = set(edges)
    for wire in between:
        if left.isdisjoint(wire.edges()):
            continue
        own = origin.get(frozenset((wire.start, wire.end)))
        left.difference_update(wire.edges())
        wire = replace(wire, finish="CUT", mirror=shared, images=(), planned=planned)
        if own is not None:
            wire = replace(wire, follow=own.follow, strength=own.strength, mirror=own.mirror, planned=own.planned)
        images = {edge for image in mesh.session.mirrored(wire) for edge in image.edges()}
        if left.issuperset(images):
            left.difference_update(images)
            yield replace(wire, images=None)
        else:
            yield replace(wire, mirror=())


def _curve(wire: Wire, image_of: int | None = None) -> CutCurve:
    """Return a wire across the surface as the library cuts it. It begins and ends at points in triangles, or where its edges do."""
    start, end = (
        (pick.triangle, pick.weights) if isinstance(pick, FacePoint) else vertex
        for pick, vertex in ((wire.start, wire.vertices[0]), (wire.end, wire.vertices[-1]))
    )
    return native.load().CutCurve(wire.points, start, end, wire.faces, image_of)
