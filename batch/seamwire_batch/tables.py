# SPDX-License-Identifier: GPL-3.0-or-later
"""The results as tables: CSV for programs, Markdown with pictures for people."""

from __future__ import annotations

import csv
import io
import statistics
from collections.abc import Sequence
from pathlib import Path
from typing import Any

COLUMNS = (
    *("name", "status", "objects", "faces", "seams", "islands", "angle", "area", "worst"),
    *("warnings", "seconds", "inside", "megabytes", "error"),
)


def write(path: Path, text: str) -> None:
    r"""Write a file whole or not at all; bytes of file names that are not UTF-8 are written as ``\udcXX``."""
    part = path.with_name(f".{path.name}.part")
    part.write_text(text, encoding="utf-8", errors="backslashreplace")
    part.replace(path)


def as_csv(records: Sequence[dict[str, Any]]) -> str:
    """Return a line for each asset; several warnings are separated by semicolons."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    for record in records:
        row = {**record, "warnings": "; ".join(record.get("warnings", []))}
        writer.writerow(["" if row.get(name) is None else row[name] for name in COLUMNS])
    return text.getvalue()


def as_markdown(records: Sequence[dict[str, Any]], out: Path) -> str:
    """Return the table, then what was odd, then the pictures that are there."""
    count = {
        status: sum(record["status"] == status for record in records)
        for status in ("done", "failed", "crashed", "hung", "memory")
    }
    done = [record for record in records if record["status"] == "done"]
    ended = ", ".join(f"{number} {status}" for status, number in count.items() if number)
    lines = ["# Seamwire batch", "", f"{len(records)} assets: {ended or 'none'}.", ""]
    if done:
        lines += [
            f"Median of those done: {statistics.median(record['seconds'] for record in done):.1f} s,"
            f" {statistics.median(record['megabytes'] for record in done):.0f} MB at most in memory.",
            "",
        ]
    lines += [
        "| asset | status | faces | seams | islands | stretch: angle | area | worst island | warnings | seconds |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for record in records:
        numbers = [record.get(name, "") for name in ("faces", "seams", "islands", "angle", "area", "worst")]
        cells = [record["name"], record["status"], *numbers, len(record.get("warnings", [])), record["seconds"]]
        lines.append("| " + " | ".join(_cell(cell) for cell in cells) + " |")
    told = [
        f"- {_cell(record['name'])}: {_cell(text)}"
        for record in records
        for text in [*([record["error"]] if record.get("error") else []), *record.get("warnings", [])]
    ]
    if told:
        lines += ["", "## Errors and warnings", "", *told]
    pictures = [record["name"] for record in done if (out / f"{record['name']}.png").is_file()]
    if pictures:
        lines += ["", "## Pictures", "", "Islands and seams, a checked texture, the layout.", ""]
        lines += [line for name in pictures for line in (f"{_cell(name)}", "", f"![{_cell(name)}](<{name}.png>)", "")]
    return "\n".join(lines) + "\n"


def _cell(value: object) -> str:
    return str(value).replace("|", "\\|").replace("\n", " ")
