# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts what ``scripts/test`` ran: ``summary.py REPORTS [SECONDS]``. Ends with 1 when anything failed.

REPORTS holds ``stages.txt``, with a line ``name exit-code seconds processor-seconds`` for each stage. A stage has ``name.xml`` or
``name.*.xml`` in JUnit's form, or ``name.txt`` with a line ``passed|failed what`` for each check and the indented lines of its message.
``blenders.txt`` is there if several Blenders were asked for, with a line ``ready|skipped|failed what`` for each. A Blender that is not
available is named; one that does not start is a failure, and so is a run in which none was ready. SECONDS is how long all of it took.

The failed tests come last, each with its message, so that they are seen without scrolling.
"""

import sys
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from pathlib import Path

MOST_FAILURES = 8
"""Failures that are printed: with two lines each they fit into the last twenty lines."""
WIDTH = 200
"""Characters of a message that are printed."""


@dataclass
class Results:
    """How many tests passed and were skipped, and the failed ones with their messages.

    Parameters
    ----------
    passed, skipped
        Counts.
    failures
        Pairs of what failed and the first line of its message, which may be empty.
    """

    passed: int = 0
    skipped: int = 0
    failures: list[tuple[str, str]] = field(default_factory=list)

    def add(self, other: "Results") -> None:
        """Add the results of more tests."""
        self.passed += other.passed
        self.skipped += other.skipped
        self.failures += other.failures

    def __str__(self) -> str:
        """Write the counts as the plain closing line."""
        counts = f"{self.passed} passed, {len(self.failures)} failed"
        return f"{counts}, {self.skipped} skipped" if self.skipped else counts


def message_of(case: ElementTree.Element, problem: ElementTree.Element) -> str:
    """Return the line that says most: the message of the failure, what pytest marked with an E, or the last lines that CTest kept."""
    message = (problem.get("message") or "").strip()
    if message in ("", "Failed"):
        text = problem.text or case.findtext("system-out") or ""
        lines = [line.strip() for line in text.splitlines() if line.strip()]
        message = next((line[1:] for line in lines if line.startswith("E ")), " / ".join(lines[-2:]))
    return " ".join(message.split())


def read_junit(path: Path) -> Results:
    """Read the test cases of a JUnit file; a file that cannot be read is a failure."""
    try:
        cases = ElementTree.parse(path).getroot().iter("testcase")
    except ElementTree.ParseError as error:
        return Results(failures=[(path.name, str(error))])
    results = Results()
    for case in cases:
        problem = next((found for name in ("failure", "error") if (found := case.find(name)) is not None), None)
        if problem is not None:
            what = f"{path.stem}: {case.get('classname')} {case.get('name')}"
            results.failures.append((what, message_of(case, problem)))
        elif case.find("skipped") is not None or case.get("status") in ("disabled", "notrun"):
            # CTest tells a disabled test by its status alone.
            results.skipped += 1
        else:
            results.passed += 1
    return results


def read_checks(path: Path) -> Results:
    """Read the checks of a text report."""
    results = Results()
    for line in path.read_text().splitlines():
        if line.startswith(" "):
            what, message = results.failures[-1]
            results.failures[-1] = what, f"{message} {line.strip()}".strip()
            continue
        result, what = line.split(maxsplit=1)
        if result == "passed":
            results.passed += 1
        else:
            results.failures.append((f"{path.stem}: {what}", ""))
    return results


def read_stage(reports: Path, name: str, code: int) -> Results:
    """Read the results of one stage. A stage that ended badly, or ran no test, fails even if its reports know of no failure."""
    results = Results()
    for path in sorted(reports.glob(f"{name}.xml")) + sorted(reports.glob(f"{name}.*.xml")):
        results.add(read_junit(path))
    if (reports / f"{name}.txt").exists():
        results.add(read_checks(reports / f"{name}.txt"))
    if not results.failures and (code != 0 or results.passed == 0):
        results.failures.append((name, f"ended with {code}" if code != 0 else "ran no test"))
    return results


def read_blenders(path: Path) -> tuple[Results, list[str]]:
    """Read which Blenders failed, and return a line for each that was not available."""
    found: dict[str, list[str]] = {"ready": [], "skipped": [], "failed": []}
    for line in path.read_text().splitlines():
        result, what = line.split(maxsplit=1)
        found[result].append(what)
    failures = found["failed"]
    if not found["ready"]:
        failures = [*failures, "no Blender is available"]
    return Results(failures=[("Blender", what) for what in failures]), [f"Blender {what}" for what in found["skipped"]]


def summarize(reports: Path, seconds: int | None = None) -> int:
    """Print the results of every stage, the failures, and the counts of all; return the exit code."""
    total = Results()
    lines = []
    stages = reports / "stages.txt"
    for line in stages.read_text().splitlines() if stages.exists() else []:
        name, code, took, used = line.split()
        results = read_stage(reports, name, int(code))
        total.add(results)
        lines.append(f"{name + ':':<22} {int(took):5} s, {int(used):5} s of the processor; {results}")
    if (reports / "blenders.txt").exists():
        results, without = read_blenders(reports / "blenders.txt")
        total.add(results)
        lines += without
    if total.passed == 0 and not total.failures:
        total.failures.append(("scripts/test", "nothing ran"))
    for what, message in total.failures[:MOST_FAILURES]:
        lines += [f"FAILED {what}", *([f"       {message[:WIDTH]}"] if message else [])]
    if len(total.failures) > MOST_FAILURES:
        lines.append(f"and {len(total.failures) - MOST_FAILURES} more failures: see {reports}")
    if seconds is not None:
        lines.append(f"everything took {seconds // 60} min {seconds % 60} s")
    print(*lines, total, sep="\n")
    return 1 if total.failures else 0


if __name__ == "__main__":
    sys.exit(summarize(Path(sys.argv[1]), *map(int, sys.argv[2:3])))
