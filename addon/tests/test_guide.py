# SPDX-License-Identifier: GPL-3.0-or-later
"""The guide names each action, key, setting and value as the tool does."""

from pathlib import Path

import pytest
from seamwire.terms.choices import FINISHES, LOOPS, METRICS
from seamwire.terms.options import SETTINGS
from seamwire.words.keys import Bindings

GUIDE = Path(__file__).resolve().parents[2] / "docs/guide"
TEXT = "".join(path.read_text(encoding="utf-8") for path in sorted(GUIDE.glob("*.md"))).lower()
NAMES = [row.name for table in (SETTINGS, FINISHES, METRICS) for row in table.values()]


def rows(page: str, head: str) -> list[list[str]]:
    """Return the rows of the table of a page that has a head."""
    text = (GUIDE / page).read_text(encoding="utf-8")
    table = text[text.index(head) :].split("\n\n")[0]
    return [[part.strip(" *") for part in row.split("|")[1:-1]] for row in table.splitlines()[2:]]


def test_the_table_of_keys_is_that_of_the_tool() -> None:
    keys = [row for group in Bindings().groups().values() for row in group]
    assert [tuple(row[:2]) for row in rows("keys.md", "| Key | Action |")] == keys


@pytest.mark.parametrize("name", [*NAMES, *LOOPS.values()])
def test_the_guide_names_each_setting_finish_metric_and_loop(name: str) -> None:
    assert name.lower() in TEXT


def test_the_guide_has_a_row_for_each_finish() -> None:
    named = [row[0].split("*")[0] for row in rows("finish.md", "| Finish | The seam is |")]
    assert named == ["Auto", *(finish.name for finish in FINISHES.values())]
