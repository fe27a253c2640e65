# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts what ``scripts/test`` ran: ``summary.py REPORTS [SECONDS]``. Ends with 1 when anything failed.

REPORTS holds ``stages.txt``, a line ``name exit-code seconds processor-seconds`` a stage, and for each stage ``name.xml`` or ``name.*.xml``
in JUnit's form, or ``name.txt`` with a line ``passed|failed what`` a check. ``blenders.txt`` is there where other Blenders than the
installed one were asked for, with a line ``ready|skipped|failed what`` for each: one that cannot be had is named, one that does not start
is a failure, and so is a run in which none was ready. SECONDS is how long all of it took.
"""

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import NamedTuple


class Counts(NamedTuple):
    """How many tests passed, failed and were skipped."""

    passed: int = 0
    failed: int = 0
    skipped: int = 0

    def __add__(self, other: "Counts") -> "Counts":
        """Add them up one by one."""
        return Counts(*(a + b for a, b in zip(self, other, strict=True)))

    def __str__(self) -> str:
        """Write them as the plain closing line."""
        return f"{self.passed} passed, {self.failed} failed" + (f", {self.skipped} skipped" if self.skipped else "")


def count_junit(path: Path) -> Counts:
    """Count the test cases of a JUnit file; one that cannot be read is a failure."""
    try:
        cases = ElementTree.parse(path).getroot().iter("testcase")
    except ElementTree.ParseError as error:
        print(f"{path.name}: {error}")
        return Counts(failed=1)
    counts = Counts()
    for case in cases:
        failed = case.find("failure") is not None or case.find("error") is not None
        # CTest tells a disabled test by its status alone.
        skipped = case.find("skipped") is not None or case.get("status") in ("disabled", "notrun")
        if failed:
            print(f"failed: {path.stem}: {case.get('classname')} {case.get('name')}")
        counts += Counts(failed=1) if failed else Counts(skipped=1) if skipped else Counts(passed=1)
    return counts


def count_lines(path: Path) -> Counts:
    """Count the checks of a text report."""
    counts = Counts()
    for line in path.read_text().splitlines():
        result, what = line.split(maxsplit=1)
        if result == "failed":
            print(f"failed: {path.stem}: {what}")
        counts += Counts(passed=1) if result == "passed" else Counts(failed=1)
    return counts


def count_stage(reports: Path, name: str, code: int) -> Counts:
    """Count one stage. One that ended badly, or ran no test, counts as a failure even when its reports know of none."""
    counts = Counts()
    for path in sorted(reports.glob(f"{name}.xml")) + sorted(reports.glob(f"{name}.*.xml")):
        counts += count_junit(path)
    if (reports / f"{name}.txt").exists():
        counts += count_lines(reports / f"{name}.txt")
    if counts.failed == 0 and (code != 0 or counts.passed == 0):
        print(f"failed: {name}: " + (f"ended with {code}" if code != 0 else "ran no test"))
        counts += Counts(failed=1)
    return counts


def count_blenders(path: Path) -> tuple[Counts, list[str]]:
    """Count the Blenders that failed, and return a line for each that the tests had to do without."""
    found: dict[str, list[str]] = {"ready": [], "skipped": [], "failed": []}
    for line in path.read_text().splitlines():
        result, what = line.split(maxsplit=1)
        found[result].append(what)
    failures = found["failed"]
    if not found["ready"]:
        failures = [*failures, "no Blender could be had"]
    for failure in failures:
        print(f"failed: Blender: {failure}")
    return Counts(failed=len(failures)), [f"Blender {what}" for what in (*found["skipped"], *failures)]


def summarize(reports: Path, seconds: int | None = None) -> int:
    """Print the counts of every stage and of all, and return the exit code."""
    total = Counts()
    lines = []
    stages = reports / "stages.txt"
    for line in stages.read_text().splitlines() if stages.exists() else []:
        name, code, took, used = line.split()
        counts = count_stage(reports, name, int(code))
        total += counts
        lines += [f"{name} took {took} s, {used} s of the processor", f"{name}: {counts}"]
    if (reports / "blenders.txt").exists():
        counts, without = count_blenders(reports / "blenders.txt")
        total += counts
        lines += without
    if seconds is not None:
        lines.append(f"all took {seconds // 60} min {seconds % 60} s")
    if total.passed == 0 and total.failed == 0:
        print("failed: nothing ran")
        total += Counts(failed=1)
    print(*lines, total, sep="\n")
    return 0 if total.failed == 0 else 1


if __name__ == "__main__":
    sys.exit(summarize(Path(sys.argv[1]), *map(int, sys.argv[2:3])))
