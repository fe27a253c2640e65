# SPDX-License-Identifier: GPL-3.0-or-later
"""Folders of assets for a stand-in for Blender."""

from __future__ import annotations

import csv
import io
import shutil
import sys
from pathlib import Path

from seamwire_batch import cli

ASSETS = {
    "a.obj": "a",
    "b.stl": "crash",
    "c.glb": "c",
    "d.ply": "fail",
    "e.fbx": "hang",
    "f.obj": "exit",
    "g.blend": "memory",
}
ENDS = {
    "a.obj": "done",
    "b.stl": "crashed",
    "c.glb": "done",
    "d.ply": "failed",
    "e.fbx": "hung",
    "f.obj": "crashed",
    "g.blend": "memory",
}


class Place:
    """Folders of assets and of results, and the command line for them."""

    def __init__(self, folder: Path, assets: dict[str, str]) -> None:
        self.assets, self.out = folder / "assets", folder / "out"
        self.blender = folder / "fake_blender.py"
        shutil.copy(Path(__file__).with_name("fake_blender.py"), self.blender)
        (folder / "net.json").write_text("{}")
        self.network = folder / "net.json"
        for name, content in assets.items():
            path = self.assets / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(content)

    def words(self, *more: str) -> list[str]:
        command = [
            "--blender",
            f"{sys.executable} {self.blender}",
            "--network",
            str(self.network),
            "--out",
            str(self.out),
        ]
        return [str(self.assets), *command, *more]

    def run(self, *more: str) -> int:
        return cli.main(self.words(*more))

    def calls(self) -> list[str]:
        path = self.blender.with_name("calls.txt")
        return path.read_text().split() if path.exists() else []

    def rows(self) -> dict[str, dict[str, str]]:
        text = (self.out / "results.csv").read_text()
        return {row["name"]: row for row in csv.DictReader(io.StringIO(text))}

    def results(self) -> set[str]:
        return {path.relative_to(self.out).as_posix() for path in self.out.rglob("*") if path.is_file()}
