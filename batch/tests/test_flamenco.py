# SPDX-License-Identifier: GPL-3.0-or-later
"""The job type for Flamenco: what it compiles is what Flamenco's documentation asks for, and what it runs does the work."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import pytest
from place import ASSETS, ENDS, Place
from seamwire_batch import cli

quickjs = pytest.importorskip("quickjs")

SCRIPT = Path(cli.__file__).with_name("seamwire-batch.js").read_text(encoding="utf-8")
AUTHOR = """
const made = [];
const author = {
    Command: (name, parameters) => ({ name: name, parameters: parameters }),
    Task: (name, type) => ({
        name: name, type: type, commands: [], dependencies: [],
        addCommand(command) { this.commands.push(command); },
        addDependency(task) { this.dependencies.push(task.name); },
    }),
};
function compiled(settings) {
    compileJob({ settings: JSON.parse(settings), addTask: (task) => made.push(task) });
    return JSON.stringify(made);
}
"""
"""The functions that a job compiler script has from Flamenco, as far as https://flamenco.blender.org/usage/job-types/ tells of it."""


def script() -> Any:  # noqa: ANN401 - quickjs has no types
    context = quickjs.Context()
    context.eval(AUTHOR + SCRIPT)
    return context


def settings(**given: object) -> dict[str, Any]:
    kinds = json.loads(script().eval("JSON.stringify(JOB_TYPE)"))["settings"]
    return {kind["key"]: kind.get("default", "") for kind in kinds} | given


def tasks(**given: object) -> list[dict[str, Any]]:
    return json.loads(script().get("compiled")(json.dumps(settings(**given))))


def test_the_job_type_is_what_the_documentation_asks_for() -> None:
    kind = json.loads(script().eval("JSON.stringify(JOB_TYPE)"))
    assert set(kind) <= {"label", "description", "settings"} and isinstance(kind["label"], str)
    types = {"string": str, "int32": int, "float": float, "bool": bool}
    assert len({one["key"] for one in kind["settings"]}) == len(kind["settings"])
    for one in kind["settings"]:
        assert set(one) <= {"key", "type", "subtype", "required", "default", "description", "choices", "visible"}
        assert type(one.get("default", types[one["type"]]())) is types[one["type"]]
        assert one.get("subtype", "file_path") in {"file_path", "dir_path", "hashed_file_path"}
        assert one.get("visible", "hidden") in {"visible", "hidden", "submission", "web"}
        assert one["key"].isidentifier()
        if "choices" in one:
            assert one["type"] == "string" and one["default"] in one["choices"]


def test_tasks_have_names_of_their_own_known_types_and_commands_that_are_lists_of_words() -> None:
    made = tasks(
        assets="/shots", out="/out", way="network", **{"from": "/net.json"}, shards=3, options="--mirror\nx\n\n"
    )
    assert [task["name"] for task in made] == ["shard-1", "shard-2", "shard-3", "tables"]
    assert {task["type"] for task in made} <= {"blender", "ffmpeg", "file-management", "misc"}
    assert made[-1]["dependencies"] == ["shard-1", "shard-2", "shard-3"]
    assert all(task["dependencies"] == [] for task in made[:-1])
    for task in made:
        (command,) = task["commands"]
        assert command["name"] == "exec" and set(command["parameters"]) == {"exe", "args"}
        assert all(isinstance(word, str) for word in command["parameters"]["args"])
    words = [
        "/shots",
        "--out",
        "/out",
        "--limit",
        "600",
        "--blender",
        "{blender}",
        "--network",
        "/net.json",
        "--mirror",
        "x",
    ]
    assert made[-1]["commands"][0]["parameters"]["args"] == words
    assert made[1]["commands"][0]["parameters"]["args"] == [*words, "--shard", "2/3"]


@pytest.mark.parametrize(
    ("given", "message"), [({"way": "source"}, "name the file"), ({"way": "suggest", "shards": 0}, "one shard")]
)
def test_what_cannot_be_compiled_is_said(given: dict[str, object], message: str) -> None:
    with pytest.raises(quickjs.JSException, match=message):
        tasks(assets="/shots", out="/out", **given)


@pytest.mark.skipif(sys.platform == "win32", reason="processes end otherwise there")
def test_what_the_tasks_run_does_the_work(tmp_path: Path) -> None:
    place = Place(tmp_path, ASSETS)
    made = tasks(
        assets=str(place.assets),
        out=str(place.out),
        way="network",
        **{"from": str(place.network)},
        shards=2,
        limit=1,
        blender=f"{sys.executable} {place.blender}",
        options="--memory\n64",
    )
    codes = [cli.main(task["commands"][0]["parameters"]["args"]) for task in made]
    assert codes == [0, 0, 1]
    assert {name: row["status"] for name, row in place.rows().items()} == ENDS
    assert len(place.calls()) == len(ASSETS)
