# SPDX-License-Identifier: GPL-3.0-or-later
"""The guide to the library: each snippet is run."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import library_pages
from library_pages import EXAMPLES, FIRST, PAGES, PROJECT


@pytest.fixture(scope="session")
def first_names() -> dict:
    return library_pages.first_program()


@pytest.fixture
def scan(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, first_names: dict) -> None:
    """A file of the reader's own, in the current folder."""
    lines = [f"v {x} {y} {z}" for x, y, z in first_names["points"]]
    lines += [f"f {a}/{a} {b} {c}" for a, b, c in first_names["triangles"] + 1]
    (tmp_path / "scan.obj").write_text("\n".join(lines))
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
@pytest.mark.usefixtures("scan")
def test_python_snippets_run(page: Path, first_names: dict, tmp_path: Path) -> None:
    names = {} if page == FIRST else dict(first_names)
    if page == FIRST:
        pytest.importorskip("matplotlib")
    library_pages.run_python(page, names)
    if page == FIRST:
        assert (tmp_path / "geodesics.png").stat().st_size > 10_000
        assert np.array_equal(names["scan"].points, names["surface"].points)


def test_the_first_program_prints_what_the_page_says(capsys: pytest.CaptureFixture) -> None:
    library_pages.first_program()
    assert capsys.readouterr().out == library_pages.blocks(FIRST, "text")[0][1]


def test_the_geodesic_in_the_feature_metric_follows_the_ridge(first_names: dict) -> None:
    heights = {name: wire.points[:, 2].min() for name, wire in first_names["wires"].items()}
    assert heights["feature metric"] > 0.9 * first_names["z"].max() > heights["Euclidean"] * 1.2


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_snippets_in_cpp_are_those_of_the_examples(page: Path) -> None:
    source = library_pages.example_of(page)
    snippets = library_pages.example_snippets(source) if source.exists() else {}
    assert [code for _, code in library_pages.blocks(page, "cpp")] == list(snippets.values())


def test_each_example_has_a_page() -> None:
    sources = {library_pages.example_of(page) for page in PAGES}
    assert {*EXAMPLES.glob("**/*.cpp")} <= sources


def test_the_snippet_for_cmake_is_that_of_the_project() -> None:
    license_line, _, project = (PROJECT / "CMakeLists.txt").read_text().partition("\n")
    assert "SPDX" in license_line
    assert [code for _, code in library_pages.blocks(FIRST, "cmake")] == [project]
