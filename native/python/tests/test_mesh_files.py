# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh files from Python; native/tests/files tries the formats themselves."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import seamwire_core as sw

POINTS = np.array([(0.0, 0, 0), (1 / 3, 0, 0), (1, 1, 0), (0, 1, 1e-300), (2, 2, 2)])
CORNERS, SIZES = [0, 1, 2, 3, 0, 1, 4], [4, 3]
COLORS = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.2, 0.4, 0.6), (1, 1, 1)])


@pytest.mark.parametrize("ending", ["obj", "ply", "off"])
@pytest.mark.parametrize("colors", [None, COLORS])
def test_a_mesh_is_read_back(tmp_path: Path, ending: str, colors: np.ndarray | None) -> None:
    path = tmp_path / f"mésh 1.{ending}"
    sw.write_mesh(path, sw.PolygonMesh(POINTS, CORNERS, SIZES, colors))
    mesh = sw.read_mesh(str(path))
    np.testing.assert_array_equal(mesh.points, POINTS)
    assert mesh.corners.tolist() == CORNERS
    assert mesh.sizes.tolist() == SIZES
    if colors is None:
        assert mesh.colors is None
    else:
        np.testing.assert_allclose(mesh.colors, colors, atol=1e-12)
    assert f"5 vertices, 2 polygons{'' if colors is None else ', colors'}>" in repr(mesh)


def test_a_mesh_is_a_surface_with_the_edges_of_its_polygons(tmp_path: Path) -> None:
    sw.write_mesh(tmp_path / "a.stl", sw.PolygonMesh(POINTS, CORNERS, SIZES))
    read = sw.read_mesh(tmp_path / "a.stl").surface()
    assert read.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [0, 1, 4]]
    assert len(read.edges) == 7
    surface = sw.PolygonMesh(POINTS, CORNERS, SIZES).surface()
    assert surface.edges.tolist() == [[0, 1], [0, 3], [0, 4], [1, 2], [1, 4], [2, 3]]
    with pytest.raises(sw.Cancelled):
        sw.PolygonMesh(POINTS, CORNERS, SIZES).surface(lambda _: False)


def test_errors_are_those_of_files(tmp_path: Path) -> None:
    assert issubclass(sw.FileError, OSError)
    with pytest.raises(sw.FileError, match=r"no\.obj: the file cannot be opened"):
        sw.read_mesh(tmp_path / "no.obj")
    with pytest.raises(sw.FileError, match=r"must end in one of \.obj, \.ply, \.stl, \.off"):
        sw.read_mesh(tmp_path / "a.blend")
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0\n")
    with pytest.raises(sw.FileError, match=r"a\.obj, line 2: there are 2 numbers instead of 3"):
        sw.read_mesh(tmp_path / "a.obj")
    with pytest.raises(sw.FileError, match=r"cannot be written"):
        sw.write_mesh(tmp_path / "no" / "a.obj", sw.PolygonMesh(POINTS, CORNERS, SIZES))
    with pytest.raises(ValueError, match=r"^colors: there are 2 for 5 points"):
        sw.PolygonMesh(POINTS, CORNERS, SIZES, COLORS[:2])
    with pytest.raises(ValueError, match=r"^points: vertex 1 is not finite"):
        sw.write_mesh(tmp_path / "a.obj", sw.PolygonMesh([(0, 0, 0), (0, np.nan, 0), (1, 0, 0)], [0, 1, 2], [3]))
    with pytest.raises(TypeError):
        sw.read_mesh(7)


def test_lines_are_written(tmp_path: Path) -> None:
    sw.write_lines(tmp_path / "a.obj", [POINTS[:3], POINTS[3:].tolist()])
    assert (tmp_path / "a.obj").read_text().count("\nl ") == 2
    assert np.array_equal(sw.read_mesh(tmp_path / "a.obj").points, POINTS)
