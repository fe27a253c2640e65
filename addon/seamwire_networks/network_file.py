# SPDX-License-Identifier: GPL-3.0-or-later
"""Networks as files: JSON, one wire or stroke a line; docs/network-format.md and network.schema.json say what is in them.

Wires and strokes are stored as in the mesh, see `serialization`, but with plain numbers. The file also has the positions, normals and
sharpness at their vertices, which locate them on another mesh.
"""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from .placing import Moments, Shape
from .tool import (
    CLAMP_PERCENTILE,
    DAMAGED,
    METRICS,
    checked_wire,
    packed,
    stored_stroke,
    stroke_record,
    unpacked,
    wire_of,
    wire_record,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .tool import Drawn, Record, Stroke, Wire

FORMAT = "seamwire-network"
VERSION = 1


class NetworkFileError(ValueError):
    """A file cannot be used."""


class Origin(NamedTuple):
    """The mesh that a network was drawn on: its name, how many visible parts it had, and where its surface lies in object coordinates."""

    name: str
    vertices: int
    edges: int
    triangles: int
    moments: Moments


@dataclass(frozen=True)
class FileCourse:
    """Where a wire runs, to be found on another mesh. The first vertex does not come again in a closed wire."""

    record: Record  # the wire, see `serialization.wire_record`
    places: NDArray[np.float64]  # (k, 3) of its vertices, in object coordinates
    normals: NDArray[np.float64]  # (k, 3)
    creases: NDArray[np.float64]  # (k,) the largest angle between triangles at each, in degrees

    @property
    def spacing(self) -> float:
        """The mean distance between two places."""
        lengths = np.linalg.norm(np.diff(self.places, axis=0), axis=1)
        return float(lengths.mean()) if len(lengths) else 0.0

    @property
    def name(self) -> str:
        """How it is called in messages: by its seeds."""
        record = self.record
        if record["closed"]:
            return f"loop at vertex {record['vertices'][0]}"
        return f"wire {_text_of(record['start'])} to {_text_of(record['end'])}"


@dataclass(frozen=True)
class NetworkFile:
    """The content of a file."""

    origin: Origin
    metric: str
    clamp: float  # the percentile of feature strengths that counts as the strongest
    courses: tuple[FileCourse, ...]  # by their vertices
    strokes: tuple[Record, ...]  # see `serialization.stroke_record`

    @classmethod
    def of(
        cls,
        network: Drawn,
        shape: Shape,
        *,
        name: str = "",
        metric: str = "feature",
        clamp: float = CLAMP_PERCENTILE,
    ) -> NetworkFile:
        """Return what there is to keep of a network on a mesh with a name; wires that clear seams are not. See the class."""
        # A mesh does not keep the order of its wires.
        courses = []
        for wire in sorted((wire for wire in network.wires if wire.marks), key=lambda wire: wire.vertices):
            record = wire_record(wire, shape.where)
            chain = list(wire.vertices)
            courses.append(FileCourse(record, shape.places[chain], shape.normals[chain], shape.creases[chain]))
        return cls(
            Origin(name, len(shape.points), len(shape.edges), len(shape.triangles), shape.moments),
            metric,
            clamp,
            tuple(courses),
            tuple(stroke_record(stroke, shape.where, order) for order, stroke in enumerate(network.strokes)),
        )

    # As text

    def text(self) -> str:
        """Write it, the same text for the same network."""
        origin = self.origin
        head = {
            "format": FORMAT,
            "version": VERSION,
            "mesh": {
                "name": origin.name,
                "vertices": origin.vertices,
                "edges": origin.edges,
                "triangles": origin.triangles,
                "middle": _rounded(origin.moments.middle),
                "axes": _rounded(origin.moments.axes),
            },
            "metric": self.metric,
            "clamp": round(float(self.clamp), 4),
        }
        lists = {
            "wires": [_wire_row(course) for course in self.courses],
            "strokes": [_stroke_row(record) for record in self.strokes],
        }
        parts = [f"{json.dumps(key)}: {_line(value)}" for key, value in head.items()]
        for key, rows in lists.items():
            body = ",\n".join(_line(row) for row in rows)
            parts.append(f"{json.dumps(key)}: [\n{body}\n]" if rows else f"{json.dumps(key)}: []")
        return "{\n" + ",\n".join(parts) + "\n}\n"

    @classmethod
    def parse(cls, text: str) -> NetworkFile:
        """Read what `text` wrote. Raises NetworkFileError if it is something else, damaged, or from a later version."""
        try:
            data = json.loads(text)
        except (ValueError, RecursionError) as error:
            if isinstance(error, json.JSONDecodeError):
                raise NetworkFileError(f"The file is damaged: line {error.lineno} is not valid JSON") from error
            raise NetworkFileError("The file is damaged: it is not valid JSON") from error
        if not isinstance(data, dict) or data.get("format") != FORMAT:
            raise NetworkFileError("The file contains no Seamwire network")
        version = data.get("version")
        if type(version) is not int or version < 1:
            raise NetworkFileError("The file is damaged: its version is not a number")
        if version > VERSION:
            raise NetworkFileError(
                f"A newer version of Seamwire wrote the file: it has version {version}, and this one reads up to {VERSION}"
            )
        try:
            where = "mesh"
            stored = data["mesh"]
            counts = [_count(stored[key]) for key in ("vertices", "edges", "triangles")]
            moments = Moments(_points([stored["middle"]], 1)[0], _points(stored["axes"], 3))
            origin = Origin(str(stored["name"]), *counts, moments)
            where = "metric"
            metric, clamp = data["metric"], float(data["clamp"])
            if metric not in METRICS or not 0.0 < clamp <= 100.0:
                raise ValueError
            courses, strokes = [], []
            for number, row in enumerate(data["wires"], start=1):
                where = f"wire {number}"
                courses.append(_course(row, origin.vertices))
            for number, row in enumerate(data.get("strokes", []), start=1):
                where = f"stroke {number}"
                strokes.append(_stroke_record(row, origin.vertices))
        except DAMAGED as error:
            raise NetworkFileError(f"The file is damaged: {where}") from error
        return cls(origin, metric, clamp, tuple(courses), tuple(strokes))

    # On the same mesh

    def problem_with(self, shape: Shape) -> str:
        """Return why a mesh is not the one that it was drawn on, by its numbers; nothing if it is."""
        if len(shape.points) != self.origin.vertices:
            return f"The network belongs to a mesh with {self.origin.vertices} vertices, but this one has {len(shape.points)}"
        there = {tuple(sorted(edge)) for edge in shape.edges.tolist()}
        for course in self.courses:
            vertices = course.record["vertices"]
            around = [*vertices, vertices[0]] if course.record["closed"] else vertices
            for one, two in map(sorted, itertools.pairwise(around)):
                if (one, two) not in there:
                    return f"The network belongs to a mesh with other edges: edge {one}-{two} is missing here"
        return ""

    def wires(self, shape: Shape) -> list[Wire]:
        """Return its wires on the mesh that it was drawn on, by their numbers; see `problem_with`."""
        return [wire_of(course.record, shape.where) for course in self.courses]

    def strokes_on(self, shape: Shape) -> list[Stroke]:
        """Return its strokes on the mesh that it was drawn on, by numbers."""
        found = (stored_stroke(record, shape.where, [tuple(record["corners"][0][:2])]) for record in self.strokes)
        return [stroke for stroke in found if stroke is not None]


def _line(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


def _rounded(values: NDArray[np.float64], digits: int | None = None) -> list:
    """Return numbers as lists: as short as single precision can be written, or with so many digits."""

    def short(value: object) -> object:
        if isinstance(value, list):
            return [short(one) for one in value]
        number = round(float(value), digits) if digits is not None else float(str(np.float32(value)))
        return int(number) if number.is_integer() and abs(number) < 1e9 else number

    return short(np.asarray(values, dtype=np.float64).tolist())


def _text_of(stored: int | list[int]) -> str:
    return "-".join(map(str, stored)) if isinstance(stored, list) else str(stored)


def _numbers(stored: Any) -> Any:  # noqa: ANN401 - what a file holds
    """Return vertex numbers; raises ValueError where something else is there."""
    for one in stored if isinstance(stored, list) else [stored]:
        _count(one)
    return stored


def _count(stored: object) -> int:
    if type(stored) is not int or not 0 <= stored < 1 << 31:
        raise ValueError
    return stored


def _points(stored: object, count: int) -> NDArray[np.float64]:
    points = np.array(stored, dtype=np.float64)
    if points.shape != (count, 3) or not np.isfinite(points).all():
        raise ValueError
    return points


_PACKED = ("curve", "places", "ends", "faces")
"""Fields of a wire's record that its row in a file writes differently or leaves out, because other meshes have other triangles."""


def _wire_row(course: FileCourse) -> Mapping[str, object]:
    record = course.record
    row = {name: value for name, value in record.items() if name not in _PACKED}
    if "curve" in record:
        row["curve"] = _rounded(unpacked(record["curve"]))
    row["places"] = _rounded(course.places)
    row["normals"] = _rounded(course.normals, 3)
    row["creases"] = _rounded(course.creases, 0)
    return row


def _course(row: Mapping[str, Any], count: int) -> FileCourse:
    vertices = _numbers(row["vertices"])
    if not isinstance(vertices, list) or not vertices:
        raise ValueError
    places, normals = (_points(row[name], len(vertices)) for name in ("places", "normals"))
    angles = np.array(row["creases"], dtype=np.float64)
    if angles.shape != (len(vertices),) or not np.isfinite(angles).all():
        raise ValueError
    record = {name: value for name, value in row.items() if name not in {"places", "normals", "creases"}}
    for name in ("start", "end", *(("heading",) if row["heading"] is not None else ())):
        _numbers(record[name])
    record["ends"] = [places[0].tolist(), places[1 if row["closed"] is True else -1].tolist()]
    if row["along"] == "SURFACE":
        curve = np.array(row["curve"], dtype=np.float64)
        if curve.ndim != 2 or curve.shape[1] != 3:
            raise ValueError
        record["curve"], record["places"] = packed(curve), packed(places)
    picks = [record["start"], record["end"], record["heading"] or [], record.get("through") or []]
    flat = [one for pick in (*picks, vertices) for one in (pick if isinstance(pick, list) else [pick])]
    if any(number >= count for number in flat):
        raise ValueError
    return FileCourse(checked_wire(record), places, normals, angles)


def _stroke_row(record: Record) -> Mapping[str, object]:
    points = {name: _rounded(unpacked(record[name])) for name in ("points", "places")}
    return {**record, **points, "radius": None if record["radius"] is None else _rounded(record["radius"])}


def _stroke_record(row: Mapping[str, Any], count: int) -> Record:
    corners, vertices = row["corners"], _numbers(row["vertices"])
    if not corners or any(len(_numbers(triple)) != 3 or not set(triple) <= set(vertices) for triple in corners):
        raise ValueError
    if row["vertex_count"] != count or max(vertices) >= count or not math.isfinite(row["eta"]):
        raise ValueError
    points = {"points": _points(row["points"], len(corners)), "places": _points(row["places"], len(vertices))}
    return {**row, **{name: packed(values) for name, values in points.items()}}
