# SPDX-License-Identifier: GPL-3.0-or-later
"""What a mesh keeps of its wires and strokes, as text: records that the labels of its edges call by their numbers.

Which wires a mesh has, its edges say, see `wire_labels`: their labels come and go with Blender's undo. What each wire is, a
record says. A record never changes, and its number follows from what it says: records of different times and meshes go
together, and one that nothing calls any more does no harm.
"""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ...terms.choices import ALONG, DEFAULT_FINISH, FINISHES
from ..base import native
from ..base.refused import Refused
from ..network.picks import FacePoint, undirected
from ..network.strokes import Stroke
from ..network.wires import FOLLOWS, LOOP_KINDS, Wire

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..network.picks import Edge, Pick

FORMAT = "seamwire"
VERSION = 1
WAS_SEAM = 1
"""A member of a label: the edge was a seam before a wire ran along it."""
_FIRST_NUMBER = 16
_TOLERANCE = 1e-4
"""How far a vertex may have moved and still be found by its place, as part of the mesh's size."""

Record = dict[str, Any]


DAMAGED = (ValueError, TypeError, LookupError, AttributeError, OverflowError, RecursionError)
"""What reading raises where a text is not what it should be."""


@dataclass(frozen=True)
class Places:
    """Where a mesh's vertices are, (n, 3), as sessions have them. Object coordinates are ``points @ to_object.T``."""

    points: NDArray[np.float64]
    to_object: NDArray[np.float64]

    @cached_property
    def in_object(self) -> NDArray[np.float64]:
        return self.points @ self.to_object.T

    def from_object(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        return places @ np.linalg.inv(self.to_object).T

    @property
    def tolerance(self) -> float:
        """How far vertices may be from where they were and count as unmoved."""
        return max(_TOLERANCE * float(np.ptp(self.in_object, axis=0).max(initial=0.0)), 1e-12)


class UnreadableError(Refused):
    """A mesh's text cannot be read."""


class NewerError(UnreadableError):
    """It was written by a later version: it must stay as it is."""


class Archive:
    """Records of wires and strokes, and which of them each label of an edge stands for, all by their numbers.

    A label stands for its members: the number of a wire along the edge, its negative for an image of the wire, the number of a stroke
    that begins there, or `WAS_SEAM`. One with a single member is that number itself.
    """

    def __init__(self) -> None:
        self.size = 0  # bytes that all records take as text
        self.wires: dict[int, Record] = {}
        self.strokes: dict[int, Record] = {}
        self._sets: dict[int, tuple[int, ...]] = {}

    @property
    def _kinds(self) -> dict[str, dict[int, Any]]:
        return {"wires": self.wires, "strokes": self.strokes, "sets": self._sets}

    @classmethod
    def parse(cls, text: str) -> Archive:
        """Read what `text` wrote. Raises NewerError or UnreadableError if a later version wrote it, or if it is not a network."""
        archive = cls()
        if not text:
            return archive
        try:
            name, version, *rest = text.split(maxsplit=2)
            if name != FORMAT:
                raise ValueError
            if version != str(VERSION):
                raise NewerError(
                    "A newer version of Seamwire drew the wires of this mesh: they were not read or changed"
                )
            (body,) = rest
            data = json.loads(body)
            archive.size = len(body)
            archive.wires = {_number(number): checked_wire(record) for number, record in data["wires"].items()}
            archive.strokes = {_number(number): dict(record) for number, record in data["strokes"].items()}
            archive._sets = {_number(label): tuple(map(int, members)) for label, members in data["sets"].items()}
        except NewerError:
            raise
        except DAMAGED as error:
            raise UnreadableError("The wires of this mesh cannot be read: its seams were not changed") from error
        return archive

    def text(self, labels: Iterable[int]) -> str:
        """Write what some labels stand for; an empty string where they stand for nothing."""
        used = set(labels)
        used |= {abs(member) for label in used for member in self.members(label)}
        kinds = {
            name: {number: kind[number] for number in sorted(used & kind.keys())} for name, kind in self._kinds.items()
        }
        if not any(kinds.values()):
            return ""
        return f"{FORMAT} {VERSION} {json.dumps(kinds, separators=(',', ':'))}"

    def merge(self, other: Archive) -> bool:
        """Take in the records of another archive, unless a number stands for something else there: labels would change what they mean."""
        pairs = [(own, other._kinds[name]) for name, own in self._kinds.items()]
        if any(self._is_taken(number, own, what) for own, more in pairs for number, what in more.items()):
            return False
        for own, more in pairs:
            self.size += sum(_size(what) for number, what in more.items() if number not in own)
            own.update(more)
        return True

    def _is_taken(self, number: int, kind: dict[int, Any], what: object) -> bool:
        return any(number in own and (own is not kind or own[number] != what) for own in self._kinds.values())

    def newest(self, most: int) -> Archive:
        """Return an archive with the newest records, at most so many bytes of each kind."""
        kept = Archive()
        for name, own in self._kinds.items():
            left, found = most, []
            for number, what in reversed(own.items()):
                left -= _size(what)
                if left < 0:
                    break
                found.append((number, what))
            kept._kinds[name].update(reversed(found))
            kept.size += sum(_size(what) for _, what in found)
        return kept

    def knows(self, label: int) -> bool:
        return all(
            member == WAS_SEAM or abs(member) in self.wires or abs(member) in self.strokes
            for member in self.members(label)
        )

    def members(self, label: int) -> tuple[int, ...]:
        return self._sets.get(label, (label,))

    def label_of(self, members: Iterable[int]) -> int:
        """Return the label that stands for some members; 0: for none."""
        wanted = tuple(sorted(set(members)))
        if len(wanted) < 2:
            return wanted[0] if wanted else 0
        return self.add(self._sets, wanted)

    def add(self, kind: dict[int, Any], what: object) -> int:
        digest = hashlib.blake2b(json.dumps(what, sort_keys=True).encode(), digest_size=4).digest()
        number = max(int.from_bytes(digest, "big") & 0x7FFFFFFF, _FIRST_NUMBER)
        while self._is_taken(number, kind, what):
            number = max((number + 1) & 0x7FFFFFFF, _FIRST_NUMBER)
        if number not in kind:
            kind[number] = what
            self.size += _size(what)
        return number


def _size(what: object) -> int:
    return len(json.dumps(what))


def _number(text: str) -> int:
    number = int(text)
    if not _FIRST_NUMBER <= number <= 0x7FFFFFFF:
        raise ValueError
    return number


# Wires


def wire_record(wire: Wire, where: Places) -> Record:
    """Return what there is to keep of a wire, by the numbers its vertices have now.

    Seams end at vertices, so a point inside a triangle is known only until they are marked.
    """
    places, chain = where.in_object, list(wire.vertices)
    start, end = (pick.vertex if isinstance(pick, FacePoint) else pick for pick in (wire.start, wire.end))
    record: Record = {
        "along": wire.along,
        "vertices": chain,
        "ends": places[[chain[0], chain[1] if wire.closed else chain[-1]]].astype(np.float32).tolist(),
        "start": start,
        "end": end,
        "closed": wire.closed,
        "heading": wire.heading,
        "follow": wire.follow,
        "strength": wire.strength,
        "mirror": list(wire.mirror),
    }
    if wire.kind is not None:
        record["kind"], record["through"] = wire.kind, wire.through
    if wire.finish != DEFAULT_FINISH:
        record["finish"] = wire.finish
    if wire.planned:
        record["planned"] = True
    if wire.along == "SURFACE":
        record["curve"] = packed(wire.points @ where.to_object.T)
        record["places"] = packed(places[chain])
        if wire.faces is not None and len(wire.faces) == len(wire.points) - 1:
            record["faces"] = wire.faces.tolist()
    return json.loads(json.dumps(record))  # tuples become lists, as they will be when it is read again


def checked_wire(record: Record) -> Record:
    """Return a record that was read, where nothing in it can be misunderstood; raises ValueError, TypeError, KeyError."""
    vertices, kind = record["vertices"], record.get("kind")
    ends = np.array(record["ends"], dtype=np.float64)
    sound = (
        type(record["closed"]) is bool
        and all(type(vertex) is int and vertex >= 0 for vertex in vertices)
        and len(vertices) >= (3 if record["closed"] else 2)
        and ends.shape == (2, 3)
        and np.isfinite(ends).all()
        and record["along"] in ALONG
        and record["follow"] in range(len(FOLLOWS))
        and np.isfinite(float(record["strength"]))
        and all(axis in (0, 1, 2) for axis in record["mirror"])
        and record.get("finish", DEFAULT_FINISH) in FINISHES
        and type(record.get("planned", False)) is bool
        and (record["heading"] is None or isinstance(pick_of(record["heading"]), tuple))
        and (kind is None or (isinstance(kind, str) and isinstance(pick_of(record["through"]), tuple)))
        and (record["along"] == "EDGES" or len(unpacked(record["curve"])) > 1)
        and (record["along"] == "EDGES" or len(unpacked(record["places"])) == len(vertices))
    )
    if not sound:
        raise ValueError
    for name in ("start", "end"):
        pick_of(record[name])
    _stored_faces(record)
    return record


def pick_of(stored: int | list[int]) -> Pick:
    if isinstance(stored, list):
        one, two = stored
        return int(one), int(two)
    return int(stored)


def _stored_faces(record: Record) -> NDArray[np.int32] | None:
    """Return the triangles of a stored curve, see `Wire.faces`. Raises ValueError if there are too few or too many."""
    if "faces" not in record:
        return None
    faces = np.array(record["faces"], dtype=np.int32)
    if faces.shape != (len(unpacked(record["curve"])) - 1,):
        raise ValueError
    return faces


def wire_of(record: Record, where: Places, vertices: tuple[int, ...] = ()) -> Wire:
    """Return the wire of a record that was checked; its mirror images are to be found.

    `vertices` are those that it has now. Without them, it is on the mesh that it was made on, by the same numbers. Across the surface it
    has its curve where they have not moved, otherwise it runs along edges.
    """
    vertices, closed = vertices or tuple(record["vertices"]), record["closed"]
    points, faces = where.points[list(vertices + vertices[:1] if closed else vertices)], None
    if record["along"] == "SURFACE":
        before, now = unpacked(record["places"]), where.in_object[list(vertices)]
        if before.shape == now.shape and np.abs(before - now).max(initial=0.0) <= where.tolerance:
            points, faces = where.from_object(unpacked(record["curve"])), _stored_faces(record)
    is_loop = record.get("kind") in LOOP_KINDS
    return Wire(
        record["along"],
        vertices,
        points,
        pick_of(record["start"]),
        pick_of(record["end"]),
        faces,
        closed=closed,
        mirror=tuple(record["mirror"]),
        heading=None if record["heading"] is None else pick_of(record["heading"]),
        follow=record["follow"],
        strength=float(record["strength"]),
        finish=record.get("finish", DEFAULT_FINISH),
        kind=record["kind"] if is_loop else None,
        through=undirected(pick_of(record["through"])) if is_loop else None,
        planned=record.get("planned", False),
    )


def packed(points: NDArray[np.float64]) -> str:
    return base64.b64encode(np.ascontiguousarray(points, dtype="<f4").tobytes()).decode()


def unpacked(text: str) -> NDArray[np.float64]:
    """Read what `packed` wrote; raises ValueError where it is something else."""
    points = np.frombuffer(base64.b64decode(text, validate=True), dtype="<f4").reshape(-1, 3).astype(np.float64)
    if not np.isfinite(points).all():
        raise ValueError
    return points


# Strokes


def stroke_record(stroke: Stroke, where: Places, order: int) -> Record:
    """Return what there is to keep of a stroke. `order` is how many strokes came before."""
    numbers = np.unique(stroke.corners)
    return {
        "points": packed(stroke.points @ where.to_object.T),
        "corners": stroke.corners.tolist(),
        "vertices": numbers.tolist(),
        "places": packed(where.in_object[numbers]),
        "vertex_count": len(where.points),
        "attracts": stroke.attracts,
        "acts_on": stroke.acts_on,
        "eta": stroke.eta,
        "rings": stroke.rings,
        "radius": stroke.radius,
        "order": order,
    }


def stored_stroke(record: Record, where: Places, begins: Iterable[Edge]) -> Stroke | None:
    """Return as much of a stroke in one piece as the mesh has now; None: nothing of it, or it is damaged.

    Its corners alone say where it lies, see `strokes.on_mesh`. Its number stands on the edges `begins`: they show whether vertices have
    the numbers that they had.
    """
    try:
        numbers = np.array(record["vertices"], dtype=np.int64)
        corner = set(record["corners"][0])
        shared = 2 if len(corner) > 1 else 1
        same_numbers = int(record["vertex_count"]) == len(where.points) and any(
            len(corner.intersection(edge)) >= shared for edge in begins
        )
        mapped = _matched(numbers, unpacked(record["places"]), where, same_numbers)
        number_of = dict(zip(numbers.tolist(), mapped.tolist(), strict=True))
        points = where.from_object(unpacked(record["points"]))
        stored = np.array(record["corners"], dtype=np.int64).reshape(len(points), 3)
        acts_on, eta, rings = record["acts_on"], float(record["eta"]), int(record["rings"])
        radius = None if record["radius"] is None else float(record["radius"])
        is_sound = 1.0 <= eta < np.inf and rings >= 1 and (radius is None or 0 < radius < np.inf)
        if not is_sound or not np.isfinite(points).all() or acts_on not in {"both", *FOLLOWS}:
            return None
        corners = np.array([[number_of[vertex] for vertex in triple] for triple in stored.tolist()], dtype=np.int32)
        corners = corners.reshape(-1, 3)
        there = (corners >= 0).all(axis=1)
        borders = np.flatnonzero(np.diff(np.concatenate([[False], there, [False]]).astype(np.int8)))
        runs = zip(borders[::2], borders[1::2], strict=True)
        begin, end = max(runs, key=lambda run: run[1] - run[0], default=(0, 0))
        if end - begin < 2:
            return None
        rows, faces = slice(begin, end), np.full(end - begin, -1, dtype=np.int32)
        return Stroke(points[rows], corners[rows], faces, bool(record["attracts"]), acts_on, eta, rings, radius)
    except DAMAGED:
        return None


def _matched(
    numbers: NDArray[np.int64], places: NDArray[np.float64], where: Places, same_numbers: bool
) -> NDArray[np.int64]:
    """Return the current number of each stored vertex, or -1.

    With `same_numbers`, numbers count more than positions. A mesh that moved by one cell of its pattern has other vertices in the old
    positions.
    """
    points, near = where.in_object, where.tolerance
    if not len(numbers) or not len(points):
        return np.full(len(numbers), -1)
    known = (numbers >= 0) & (numbers < len(points))
    stayed = known & (np.linalg.norm(points[np.where(known, numbers, 0)] - places, axis=1) <= near)
    if same_numbers and known.all():
        return numbers
    mapped = np.where(stayed, numbers, -1)
    if not stayed.all():
        mapped[~stayed] = native.load().nearest_vertices(points, places[~stayed], near)
    return mapped
