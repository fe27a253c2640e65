# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of the benchmark pages can be read on a narrow screen."""

from pathlib import Path

import pytest

PAGES = Path(__file__).resolve().parents[3] / "docs/benchmarks"
MOST = 7


@pytest.mark.parametrize("page", sorted(PAGES.glob("*.md")), ids=lambda page: page.stem)
def test_tables_have_few_columns(page: Path) -> None:
    rows = [line for line in page.read_text(encoding="utf-8").splitlines() if line.startswith("|")]
    assert rows or page.stem == "index"
    too_wide = [row for row in rows if len(row.strip().strip("|").split("|")) > MOST]
    assert not too_wide, f"more than {MOST} columns"
