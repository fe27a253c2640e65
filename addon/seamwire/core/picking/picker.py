# SPDX-License-Identifier: GPL-3.0-or-later
"""What a click would take on the visible part of an edit mesh: a seed, a wire, a seam, a feature, or the plain mesh."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from operator import is_not
from typing import TYPE_CHECKING

import numpy as np

from ..base import native
from ..network.network import Snap
from ..network.picks import FacePoint, place_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    import seamwire_core
    from numpy.typing import ArrayLike, NDArray

    from ..base.mesh_arrays import Arrays
    from ..network.picks import Pick
    from ..network.wires import Wire
    from ..offers.crests import Crests
    from ..sketch.sketch import Sketch

Bend = Callable[["NDArray[np.float64]"], "NDArray[np.float64]"]
REACH = 14.0
"""Pixels beside the mesh in which the library finds it."""
FEATURE_QUANTILE = 0.75
"""A vertex counts as a feature from this share of all vertices' strengths on: on a plain nothing is stronger than noise."""
_SEEDS, _WIRES, _CURVES, _SEAMS, _CRESTS = range(5)
"""The layers of the library's picker. Those before the seams are empty until they are set."""
_SEED_REACH, _WIRE_REACH, _SEAM_REACH, _CREST_REACH = 9.0, 6.0, 4.0, 10.0
"""Pixels beside each in which it is found: few for seams, because edges beside them can be picked too."""


@dataclass(frozen=True)
class Camera:
    width: float  # pixels
    height: float
    perspective: NDArray[np.float64]  # (4, 4), takes world coordinates to clip space
    # (k, 4) the planes of Blender's clipping border: what lies on the negative side of one is not shown.
    clipped: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 4)))

    def to_pixels(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Project (n, 3) world points to (n, 2) pixels from the bottom left; NaN behind the viewer, or where clipped away."""
        clip = points @ self.perspective[:, :3].T + self.perspective[:, 3]
        shown = (points @ self.clipped[:, :3].T + self.clipped[:, 3] >= 0.0).all(axis=1)
        w = np.where((clip[:, 3] > 1e-9) & shown, clip[:, 3], np.nan)[:, None]
        return (clip[:, :2] / w * 0.5 + 0.5) * (self.width, self.height)


class Picker:
    """Finds what is under the cursor on one edit mesh.

    In all methods, `matrix` is the object's (4, 4) matrix, which may rotate, scale and shear. `cursor` is in pixels from the region's
    bottom left, and `scale` is that of the display. With `xray`, what lies behind faces is found too. `seams`, (s, 2), are those that no
    wire runs along. `bend` takes the points of a curve on the mesh, (k, 3), to where they are seen, if that is elsewhere.
    """

    def __init__(self, arrays: Arrays, seams: ArrayLike = (), bend: Bend | None = None) -> None:
        self._arrays = arrays
        self._bend: Bend = bend or (lambda curve: curve)
        self._core: seamwire_core.Picker = native.load().Picker(
            arrays.points, arrays.triangles, arrays.polygons, arrays.edges, arrays.to_object
        )
        self._told: dict[str, tuple[object, ...]] = {}  # what the library's picker was told of
        self._strength: NDArray[np.float64] | None = None
        self._preferred: frozenset[int] = frozenset()
        self._seeds: tuple[Pick, ...] = ()
        self._wires: tuple[Wire, ...] = ()
        self._curves: Sequence[NDArray[np.float64]] = ()
        self.set_seams(seams)

    def wait(self) -> None:
        self._core.wait()

    def set_seams(self, seams: ArrayLike) -> None:
        self._seams = np.asarray(seams, dtype=np.int64).reshape(-1, 2)
        ends = self._arrays.points[self._seams.reshape(-1)]
        self._core.set_layer(_SEAMS, ends, np.arange(len(self._seams)), _SEAM_REACH)

    def snap(
        self,
        camera: Camera,
        matrix: ArrayLike,
        cursor: tuple[float, float],
        *,
        vertices_only: bool,
        edges_only: bool = False,
        anywhere: bool = False,
        session: Sketch | None = None,
        xray: bool = False,
        preferred: frozenset[int] = frozenset(),
        strength: NDArray[np.float64] | None = None,
        crests: Crests | None = None,
        scale: float = 1.0,
    ) -> Snap | None:
        """Return what a click would take: a seed before a wire, a wire before a seam, a seam before the plain mesh.

        Without a session neither its seeds and wires nor seams are found. With `anywhere`, of vertices alone only those are found that are
        meant, and otherwise the point of the surface under the cursor. Preferred vertices and crests are taken before anything else of the
        plain mesh nearby. Then the nearest corner is taken, and otherwise the feature nearby with most strength, (n,).
        """
        if session is not None:
            self._follow(session)
        has_new_strength = strength is not None and strength is not self._strength
        if has_new_strength or (preferred and preferred is not self._preferred):
            self._strength, self._preferred = strength, preferred
            strengths = () if strength is None else strength
            least = np.quantile(strengths, FEATURE_QUANTILE) if len(strengths) else 0.0
            self._core.set_vertices(strengths, least, list(preferred))
        if crests is not None and self._is_new("crests", crests):
            ends, owners = crests.segments.reshape(-1, 3), crests.faces[crests.pieces]
            self._core.set_layer(_CRESTS, ends, owners, _CREST_REACH, crests.vertices[crests.pieces[:, None] + (0, 1)])
        found = self._core.pick(
            *_seen_by(camera, matrix, cursor),
            scale,
            xray,
            layers=() if session is None else (_SEEDS, _WIRES, _SEAMS),
            vertices_only=vertices_only,
            edges_only=edges_only,
            anywhere=anywhere,
            preferred=bool(preferred),
            features=strength is not None,
            crests=-1 if crests is None else _CRESTS,
        )
        return None if found is None else self._snap(found)

    def curve_at(
        self,
        curves: Sequence[NDArray[np.float64]],
        reach: float,
        camera: Camera,
        matrix: ArrayLike,
        cursor: tuple[float, float],
        xray: bool = False,
        scale: float = 1.0,
    ) -> tuple[int, float] | None:
        """Return the curve within reach that is nearest to the cursor and not hidden, and how far it is from the near plane."""
        if len(curves) != len(self._curves) or any(map(is_not, curves, self._curves)):
            self._curves = curves
            self._set_curves(_CURVES, curves, reach)
        found = self._core.pick(*_seen_by(camera, matrix, cursor), scale, xray, layers=(_CURVES,), layers_only=True)
        return None if found is None else (found.owner, found.depth)

    def seen_along(self, camera: Camera, matrix: ArrayLike, pick: Pick) -> tuple[float, float, float] | None:
        """Return the direction from the viewer to a pick, in the coordinates of the mesh, or None if it lies behind the viewer."""
        to_world = np.array(matrix, dtype=np.float64)
        to_world[:3, :3] = to_world[:3, :3] @ self._arrays.to_object
        place = np.array([*place_of(pick, self._arrays.points), 1.0])
        if not np.linalg.det(to_world) or np.isnan(camera.to_pixels((to_world @ place)[None, :3])).any():
            return None
        to_clip = camera.perspective @ to_world
        x, y, _, w = to_clip @ place
        near, far = np.linalg.solve(to_clip, np.array([[x / w, y / w, z, 1.0] for z in (-1.0, 1.0)]).T).T
        return tuple((far[:3] / far[3] - near[:3] / near[3]).tolist())

    def surface_at(self, camera: Camera, matrix: ArrayLike, cursor: tuple[float, float]) -> seamwire_core.Picked | None:
        """Return the `place` of the surface under the cursor, its `triangle`, and its `depth` behind the near plane in world units."""
        return self._core.pick(*_seen_by(camera, matrix, cursor), surface_only=True)

    def _snap(self, found: seamwire_core.Picked) -> Snap:
        if found.layer == _SEEDS:
            return Snap(self._seeds[found.owner], "SEED")
        if found.layer >= 0:
            wire = self._wires[found.owner] if found.layer == _WIRES else None
            vertices = self._seams[found.owner] if wire is None else np.array(wire.vertices)
            away = (self._arrays.points[vertices] - found.place) @ self._arrays.to_object.T
            return Snap(int(vertices[np.linalg.norm(away, axis=1).argmin()]), "SEAM" if wire is None else "WIRE", wire)
        point = found.place, found.triangle, self._arrays.triangles, self._arrays.points
        pick: Pick = FacePoint.at(*point) if found.pick is None else found.pick
        return Snap(
            pick,
            "FEATURE" if found.is_feature else "MESH",
            crossing=found.crossing,
            is_close_call=found.is_close_call,
            triangle=found.triangle if isinstance(pick, tuple) and found.triangle >= 0 else None,
            inside=found.is_inside,
        )

    def _follow(self, session: Sketch) -> None:
        """Tell the library what of a sketch can be found. A held seed and its wires cannot, because they follow the mouse."""
        if not self._is_new("sketch", session.drawn, session.options.along, session.seed_place, session.moved):
            return
        moved, followed = session.moved
        picks = tuple(pick for pick in session.seeds() if pick not in followed)
        wires = tuple(wire for wire in session.wires if wire.id not in moved)
        if self._is_new("drawn", picks, wires):
            self._seeds, self._wires = picks, wires
            ends = np.repeat(np.reshape([place_of(pick, self._arrays.points) for pick in picks], (-1, 3)), 2, axis=0)
            self._core.set_layer(_SEEDS, ends, np.arange(len(picks)), _SEED_REACH)
            self._set_curves(_WIRES, [wire.points for wire in wires], _WIRE_REACH)

    def _is_new(self, name: str, *key: object) -> bool:
        before, self._told[name] = self._told.get(name), key
        return before != key

    def _set_curves(self, layer: int, curves: Sequence[NDArray[np.float64]], reach: float) -> None:
        pieces = [np.stack([seen[:-1], seen[1:]], axis=1).reshape(-1, 3) for seen in map(self._bend, curves)]
        owners = np.repeat(np.arange(len(pieces)), [len(ends) // 2 for ends in pieces])
        self._core.set_layer(layer, np.concatenate([np.empty((0, 3)), *pieces]), owners, reach)


def _seen_by(camera: Camera, matrix: ArrayLike, cursor: tuple[float, float]) -> tuple:
    return camera.perspective, matrix, (camera.width, camera.height), cursor, camera.clipped
