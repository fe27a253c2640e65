# SPDX-License-Identifier: GPL-3.0-or-later
"""The summary is red whenever something was not tested that should have been."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))

import summary

PASSED = '<testsuite><testcase classname="a" name="holds"/></testsuite>'
FAILED = '<testsuite><testcase classname="a" name="holds"/><testcase classname="a" name="breaks"><failure/></testcase></testsuite>'
ERROR = '<testsuite><testcase classname="a" name="starts"><error/></testcase></testsuite>'
SKIPPED = '<testsuite><testcase classname="a" name="elsewhere"><skipped/></testcase></testsuite>'
DISABLED = '<testsuite><testcase classname="a" name="off" status="disabled"/></testsuite>'


def told(reports: Path, capsys: pytest.CaptureFixture[str], files: dict[str, str]) -> tuple[int, list[str]]:
    for name, text in files.items():
        (reports / name).write_text(text)
    code = summary.summarize(reports)
    return code, capsys.readouterr().out.splitlines()


def test_all_passed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    files = {
        "stages.txt": "cpp 0 12 5\nlint 0 3 5\n",
        "cpp.xml": PASSED,
        "lint.txt": "passed ruff\npassed clang-tidy\n",
    }
    code, lines = told(tmp_path, capsys, files)
    assert code == 0
    assert lines == [
        "cpp:                      12 s,     5 s of the processor; 1 passed, 0 failed",
        "lint:                      3 s,     5 s of the processor; 2 passed, 0 failed",
        "3 passed, 0 failed",
    ]


PYTEST = """<testsuite><testcase classname="a.b" name="test_breaks"><failure message="assert 1 == 2">def test():
E   assert 1 == 2</failure></testcase></testsuite>"""
GTEST = """<testsuite><testcase classname="Wire" name="Ends"><failure message="wire_test.cpp:3&#x0A;Expected: 1" type=""/></testcase>
</testsuite>"""
CTEST = """<testsuite><testcase classname="install.example" name="install.example" status="fail"><failure message="Failed"/>
<system-out>built
1.5 over 2 faces
</system-out></testcase></testsuite>"""


@pytest.mark.parametrize(
    ("files", "what", "message"),
    [
        ({"cpp.xml": PYTEST}, "cpp: a.b test_breaks", "assert 1 == 2"),
        ({"cpp.xml": GTEST}, "cpp: Wire Ends", "wire_test.cpp:3 Expected: 1"),
        ({"cpp.xml": CTEST}, "cpp: install.example install.example", "built / 1.5 over 2 faces"),
        ({"cpp.txt": "passed one\nfailed two\n  first line\n  second\n"}, "cpp: two", "first line second"),
    ],
    ids=["pytest", "GoogleTest", "CTest", "check"],
)
def test_failures_and_their_messages_are_in_the_last_lines(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], files: dict[str, str], what: str, message: str
) -> None:
    stages = "".join(f"stage{i} 0 1 1\n" for i in range(30)) + "cpp 1 12 5\n"
    passed = {f"stage{i}.xml": PASSED for i in range(30)}
    _, lines = told(tmp_path, capsys, {"stages.txt": stages, **passed, **files})
    at = lines.index(f"FAILED {what}")
    assert lines[at + 1].strip() == message
    assert len(lines) - at <= 20


def test_many_failures_leave_the_first_ones_in_the_last_lines(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = {"stages.txt": "cpp 1 12 5\n", "cpp.txt": "".join(f"failed test {i}\n  why\n" for i in range(50))}
    _, lines = told(tmp_path, capsys, files)
    assert "FAILED cpp: test 0" in lines[-20:]
    assert any(line.startswith("and 42 more failures") for line in lines[-3:])


@pytest.mark.parametrize(
    "files",
    [
        {"stages.txt": "cpp 8 12 5\n", "cpp.xml": FAILED},
        {"stages.txt": "cpp 8 12 5\n", "cpp.xml": ERROR},
        {"stages.txt": "lint 1 12 5\n", "lint.txt": "passed ruff\nfailed clang-tidy\n"},
        {"stages.txt": "window 0 12 5\n", "window.test_a.xml": PASSED, "window.test_b.xml": FAILED},
    ],
    ids=["failure", "error", "check", "one of two files"],
)
def test_failures_that_reports_tell_are_counted_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], files: dict[str, str]
) -> None:
    code, lines = told(tmp_path, capsys, files)
    assert code == 1
    assert lines[-1].endswith(" 1 failed")


@pytest.mark.parametrize(
    "files",
    [
        {},
        {"stages.txt": ""},
        {"stages.txt": "cpp 0 12 5\n"},
        {"stages.txt": "cpp 139 12 5\n", "cpp.xml": PASSED},
        {"stages.txt": "cpp 0 12 5\n", "cpp.xml": "<testsuite>"},
        {"stages.txt": "cpp 0 12 5\n", "cpp.xml": SKIPPED},
        {"stages.txt": "cpp 0 12 5\n", "cpp.xml": DISABLED},
    ],
    ids=["no stage", "empty", "no report", "crash after the report", "broken report", "all skipped", "all disabled"],
)
def test_stage_without_a_sound_report_fails(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], files: dict[str, str]
) -> None:
    assert told(tmp_path, capsys, files)[0] == 1


def test_skipped_blender_is_named_and_the_rest_counts(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    blenders = "ready 3.4\nskipped 5.2: skipped: needs root (log)\n"
    files = {"stages.txt": "headless-3.4 0 9 5\n", "headless-3.4.xml": PASSED, "blenders.txt": blenders}
    code, lines = told(tmp_path, capsys, files)
    assert code == 0
    assert lines[-2:] == ["Blender 5.2: skipped: needs root (log)", "1 passed, 0 failed"]


@pytest.mark.parametrize("blenders", ["", "skipped 3.4: skipped: no network (log)\n"], ids=["none", "all skipped"])
def test_run_without_any_blender_fails(tmp_path: Path, capsys: pytest.CaptureFixture[str], blenders: str) -> None:
    code, lines = told(tmp_path, capsys, {"stages.txt": "cpp 0 12 5\n", "cpp.xml": PASSED, "blenders.txt": blenders})
    assert code == 1
    assert "       no Blender is available" in lines
    assert lines[-1] == "1 passed, 1 failed"


def test_blender_that_does_not_start_fails(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    blenders = "ready 3.4\nfailed 4.3: failed: it was installed, but does not start: (log)\n"
    files = {"stages.txt": "headless-3.4 0 9 5\n", "headless-3.4.xml": PASSED, "blenders.txt": blenders}
    code, lines = told(tmp_path, capsys, files)
    assert code == 1
    assert "       4.3: failed: it was installed, but does not start: (log)" in lines
    assert lines[-1] == "1 passed, 1 failed"


def test_time_of_all_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "stages.txt").write_text("cpp 0 12 5\n")
    (tmp_path / "cpp.xml").write_text(PASSED)
    assert summary.summarize(tmp_path, 1894) == 0
    assert capsys.readouterr().out.splitlines()[-2:] == ["everything took 31 min 34 s", "1 passed, 0 failed"]
