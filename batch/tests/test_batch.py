# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs over many assets, with a stand-in for Blender: what one asset does costs that one alone, and a run that was killed goes on."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from place import ASSETS, ENDS, Place
from seamwire_batch import cli, worker
from seamwire_batch.jobs import Job, Journal, Machine, SeamOptions, UsageError, find_assets, read_list

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="processes end otherwise there")


@pytest.fixture
def place(tmp_path: Path) -> Place:
    return Place(tmp_path, ASSETS)


def test_each_asset_ends_as_it_does_and_the_others_are_done(place: Place) -> None:
    before = {path: path.read_bytes() for path in place.assets.iterdir()}
    assert place.run("--limit", "2", "--memory", "64", "--jobs", "3") == 1
    assert {name: row["status"] for name, row in place.rows().items()} == ENDS
    assert (place.out / "a.obj").read_text() == "A"
    assert place.results() == {
        *("a.obj", "a.obj.png", "c.glb", "c.glb.png", "journal.jsonl", "results.csv", "results.md", "sheet.png"),
    }, "nothing is left of what did not end well"
    assert {path: path.read_bytes() for path in place.assets.iterdir()} == before
    rows = place.rows()
    assert rows["b.stl"]["error"] == "Blender ended with signal SIGSEGV"
    assert rows["e.fbx"]["error"] == "Not finished after 2 s"
    assert rows["g.blend"]["error"] == "More than 64 MB"
    text = (place.out / "results.md").read_text()
    assert "7 assets: 2 done, 1 failed, 2 crashed, 1 hung, 1 memory." in text
    assert "- d.ply: It is no good" in text and "- a.obj: a\\|b" in text and "![c.glb](<c.glb.png>)" in text


def test_an_operator_without_memory_is_told_from_one_that_fails(tmp_path: Path) -> None:
    place = Place(tmp_path, {"a.obj": "need", "b.obj": "fail", "c.obj": "c"})
    assert place.run("--memory", "64") == 1
    rows = place.rows()
    assert {name: row["status"] for name, row in rows.items()} == {
        "a.obj": "memory",
        "b.obj": "failed",
        "c.obj": "done",
    }
    assert rows["a.obj"]["error"] == "More than 64 MB"
    assert place.run("--retry") == 1
    assert place.rows()["a.obj"]["status"] == "failed", "no limit is to blame"


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="memory is limited on Linux only")
def test_the_limit_counts_memory_that_is_used_and_not_what_threads_reserve() -> None:
    code = """
import sys, threading
from seamwire_batch import worker
worker.limit_memory(192)
threading.stack_size(1 << 18)
done = threading.Barrier(33)
for _ in range(32):
    threading.Thread(target=lambda: (b" ".join([b"x" * 9000]), done.wait())).start()
done.wait()
bytearray(128 << 20)
try:
    bytearray(256 << 20)
except MemoryError:
    sys.exit(7)
"""
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=Path(worker.__file__).parent.parent, timeout=60, check=False
    )
    assert done.returncode == 7


def test_what_hangs_is_ended_with_its_children(tmp_path: Path) -> None:
    place = Place(tmp_path, {"e.fbx": "hang"})
    place.run("--limit", "1")
    processes = place.blender.with_name("pids.txt").read_text().split()
    assert len(processes) == 2, "the one that hangs and its child"
    for text in processes:
        for _ in range(50):
            if not Path(f"/proc/{text}").exists() or " Z " in Path(f"/proc/{text}/stat").read_text():
                break
            time.sleep(0.02)
        else:
            pytest.fail(f"process {text} runs still")


def test_a_run_goes_on_and_only_what_changed_is_done_again(place: Place) -> None:
    place.run("--limit", "1")
    first = place.calls()
    assert len(first) == len(ASSETS)
    assert place.run("--limit", "1") == 1
    assert place.calls() == first, "what failed is left alone too"
    (place.assets / "a.obj").write_text("changed")
    (place.assets / "f.obj").write_text("well now")
    (place.out / "c.glb").unlink()
    place.run("--limit", "1")
    assert sorted(place.calls()[len(first) :]) == ["a.obj", "c.glb", "f.obj"]
    assert (place.out / "a.obj").read_text() == "CHANGED"
    assert place.rows()["f.obj"]["status"] == "done"
    before = len(place.calls())
    place.run("--limit", "1", "--retry")
    assert sorted(place.calls()[before:]) == ["b.stl", "d.ply", "e.fbx", "g.blend"]
    before = len(place.calls())
    place.network.write_text('{"another": 1}')
    place.run("--limit", "1")
    assert len(place.calls()) - before == len(ASSETS), "another network: all anew"


def test_after_a_kill_nothing_is_half_and_the_rest_is_done(tmp_path: Path) -> None:
    place = Place(tmp_path, {f"{number:02}.obj": "slow" for number in range(8)})
    environment = {**os.environ, "PYTHONPATH": str(Path(cli.__file__).parents[1])}
    process = subprocess.Popen(
        [sys.executable, "-m", "seamwire_batch.cli", *place.words()], env=environment, stdout=subprocess.DEVNULL
    )
    for _ in range(400):
        if len(Journal(place.out).read()) >= 2:
            break
        time.sleep(0.025)
    process.send_signal(signal.SIGKILL)
    process.wait()
    done = {path.name for path in place.out.glob("*.obj")}
    assert 2 <= len(done) < 8
    assert all((place.out / name).read_text() == "SLOW" for name in done)
    recorded = set(Journal(place.out).read())
    time.sleep(0.7)  # the one that was being worked on ends, and its result goes nowhere
    before = place.calls()
    assert place.run() == 0
    assert {path.name for path in place.out.glob("*.obj")} == {f"{number:02}.obj" for number in range(8)}
    assert set(place.calls()[len(before) :]).isdisjoint(recorded)
    assert not (place.out / ".parts").exists()


def test_a_torn_line_of_the_journal_costs_that_line(tmp_path: Path) -> None:
    journal = Journal(tmp_path)
    journal.add({"name": "a", "status": "done"})
    with (tmp_path / "journal.jsonl").open("ab") as file:
        file.write(b'{"name": "b", "sta')
    assert set(journal.read()) == {"a"}
    journal.add({"name": "c", "status": "failed"})
    journal.add({"name": "a", "status": "hung"})
    assert {name: record["status"] for name, record in journal.read().items()} == {"a": "hung", "c": "failed"}


def test_a_source_is_read_once(place: Place, tmp_path: Path) -> None:
    source = tmp_path / "shirt.blend"
    source.write_text("")
    words = [word for word in place.words("--limit", "1") if word not in {"--network", str(place.network)}]
    assert cli.main([*words, "--source", str(source), "--place", "pairs", "--pairs", "1-2 3-4 5-6"]) == 1
    assert place.rows()["a.obj"]["status"] == "done"
    assert len(place.calls()) == len(ASSETS)


def test_folders_keep_their_shape_and_formats_without_uvs_become_blend(tmp_path: Path) -> None:
    place = Place(tmp_path, {"x/a.stl": "a", "y/a.stl": "b", "a.obj": "c"})
    assert place.run("--recursive") == 0
    assert {"x/a.stl.blend", "y/a.stl.blend", "a.obj"} <= place.results()
    assert place.run("--recursive", "--format", "glb") == 0
    assert {"x/a.stl.glb", "a.obj.glb"} <= place.results()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--network", "NET", "--mark", "chains=0 1"], "one of --network"),
        ([], "one of --network"),
        (["--mark", "chains"], "give NAME=VALUE"),
        (["--network", "none.json"], "no file none.json"),
        (["--network", "NET", "--pairs", "1"], "not a pair"),
        (["--network", "NET", "--place", "pairs"], "needs --source"),
        (["--network", "NET", "--blender", "/no/blender"], "no Blender '/no/blender'"),
        (["--network", "NET", "--addon", "/nowhere"], "no folder seamwire in /nowhere"),
        (["--network", "NET", "--list", "none.txt"], "--list"),
        (["--network", "NET", "--out", "ASSETS"], "no assets"),
        (["--network", "NET", "nothing.txt"], "neither a folder nor one of"),
        (["--network", "NET", "--out", "NET"], "--out: "),
        (["--network", "NET", "--out", "NET/below"], "--out: "),
    ],
)
def test_what_cannot_be_done_is_said_before_anything_begins(
    place: Place, words: list[str], message: str, capsys: pytest.CaptureFixture
) -> None:
    names = {"NET": str(place.network), "NET/below": str(place.network / "below"), "ASSETS": str(place.assets)}
    known = ["--blender", f"{sys.executable} {place.blender}", "--out", str(place.out), str(place.assets)]
    assert cli.main([*known, *(names.get(word, word) for word in words)]) == 2
    assert message in capsys.readouterr().err
    assert not place.out.exists() and place.calls() == []


def test_results_do_not_go_over_assets(tmp_path: Path) -> None:
    place = Place(tmp_path, {"x/a.obj": "a", "y/a.obj": "b"})
    with pytest.raises(UsageError, match="the same results"):
        find_assets([str(place.assets / "x"), str(place.assets / "y")], place.out, recursive=False)
    assert cli.main([*place.words()[1:], str(place.assets / "x" / "a.obj"), "--out", str(place.assets / "x")]) == 2


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_a_list_is_read_in_every_encoding(encoding: str, end: str, tmp_path: Path) -> None:
    listed = tmp_path / "list.txt"
    lines = ["/m/a.obj", "", '  "C:/x y/Hülle.obj"  ', "'b.obj' ", "\t", "c d.obj"]
    listed.write_bytes(end.join(lines).encode(encoding))
    assert read_list(listed) == ["/m/a.obj", "C:/x y/Hülle.obj", "b.obj", "c d.obj"]


def test_a_list_may_have_names_in_any_bytes_but_must_be_a_text(tmp_path: Path) -> None:
    listed = tmp_path / "list.txt"
    listed.write_bytes(b"/m/\xff.obj\n")
    assert [os.fsencode(name) for name in read_list(listed)] == [b"/m/\xff.obj"]
    for data in (b"\x00\x01\x02\xd8\x00", b"\xff\xfe\x00\xd8\x00", b"PK\x00\x00\x00\x00"):
        listed.write_bytes(data)
        with pytest.raises(UsageError, match="this is not a text"):
            read_list(listed)


def test_a_list_names_assets_and_one_that_is_gone_is_a_failure(place: Place, tmp_path: Path) -> None:
    listed = tmp_path / "list.txt"
    listed.write_text(f"{place.assets / 'a.obj'}\n\n{place.assets / 'gone.obj'}\n")
    assert cli.main([*place.words()[1:], "--list", str(listed)]) == 1
    assert {name: row["status"] for name, row in place.rows().items()} == {"a.obj": "done", "gone.obj": "failed"}


def test_a_file_name_that_is_not_utf_8_costs_no_table(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    place = Place(tmp_path, {"a.obj": "done", os.fsdecode(b"b\xff.obj"): "done"})
    assert place.run("--limit", "1") == 0
    assert "2 done, 0 not" in capsys.readouterr().out
    assert sorted(place.rows()) == ["a.obj", "b\\udcff.obj"]
    assert "b\\udcff.obj" in (place.out / "results.md").read_text(encoding="utf-8")


def test_options_tell_results_apart() -> None:
    one = SeamOptions("mark", arguments={"chains": "0 1"})
    assert one.fingerprint() == SeamOptions("mark", arguments={"chains": "0 1"}).fingerprint()
    assert one.fingerprint() != SeamOptions("mark", arguments={"chains": "0 2"}).fingerprint()
    assert one.fingerprint() != SeamOptions("mark", arguments={"chains": "0 1"}, align=False).fingerprint()
    assert one.fingerprint() != SeamOptions("mark", arguments={"chains": "0 1"}, unwrap={"upright": "0"}).fingerprint()


def test_arguments_are_names_and_values(place: Place, capsys: pytest.CaptureFixture) -> None:
    words = ["assets", "--out", "out", "--suggest", "-", "--unwrap", "straight=false", "--unwrap", "upright=true"]
    options = cli.options_of(cli.parser().parse_args(words))
    assert (options.arguments, options.unwrap) == ({}, {"straight": "false", "upright": "true"})
    assert place.run("--unwrap", "straight") == 2
    assert "--unwrap straight: give NAME=VALUE" in capsys.readouterr().err


def test_a_job_is_told_as_json(tmp_path: Path) -> None:
    job = Job("/a/b.STL", "x/b.STL", "/out", SeamOptions("suggest"), Machine(("blender",)))
    told = json.loads(json.dumps(job.told(tmp_path)))
    assert (told["name"], told["output"], told["way"]) == ("b.STL", "b.STL.blend", "suggest")


def test_several_runs_share_the_folder_and_the_last_one_tells(place: Place) -> None:
    for number in (1, 2, 3):
        assert place.run("--limit", "1", "--shard", f"{number}/3") == 0
        assert not (place.out / "results.csv").exists()
    calls = place.calls()
    assert sorted(calls) == sorted(ASSETS)
    assert place.run("--limit", "1") == 1
    assert place.calls() == calls
    assert {name: row["status"] for name, row in place.rows().items()} == {**ENDS, "g.blend": "crashed"}


def test_dask_without_a_scheduler_is_refused(place: Place, capsys: pytest.CaptureFixture) -> None:
    pytest.importorskip("distributed")
    assert place.run("--engine", "dask") == 2
    assert "needs --scheduler" in capsys.readouterr().err
