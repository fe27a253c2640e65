# SPDX-License-Identifier: GPL-3.0-or-later
"""The plots of the benchmarks' first page: ``native/bench/summary_plots.py``."""

import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "native/bench"))
summary_plots = pytest.importorskip("summary_plots", reason="it needs matplotlib")


def test_every_plot_of_the_first_page_is_drawn_from_the_pages(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pages = ROOT / "docs/benchmarks"
    monkeypatch.setattr(sys, "argv", ["summary_plots.py", str(pages), str(tmp_path)])
    summary_plots.main()
    shown = re.findall(r"images/(benchmarks-\w+\.svg)", (pages / "index.md").read_text(encoding="utf-8"))
    assert sorted(shown) == sorted(path.name for path in tmp_path.glob("*.svg"))


def test_tables_are_found_by_heading_and_number() -> None:
    page = "# A\n\n| a | b |\n|---|---|\n| 1 | 2 |\n\n| c |\n|---|\n| 3 |\n\n## B\n\n| d |\n|---|\n| 4 |\n"
    assert summary_plots.table(page, "A") == [["1", "2"]]
    assert summary_plots.table(page, "A", 1) == [["3"]]
    assert summary_plots.table(page, "B") == [["4"]]
    with pytest.raises(ValueError, match="no table 2 under the heading 'A'"):
        summary_plots.table(page, "A", 2)


def test_the_first_number_of_a_cell_may_have_a_comma_or_no_leading_zero() -> None:
    assert [summary_plots.first_number(cell) for cell in ("x (20,088)", ".60 [.49]", "4.24 / 12.3 %")] == [
        20088,
        0.6,
        4.24,
    ]
    with pytest.raises(ValueError, match="no number in the cell '-'"):
        summary_plots.first_number("-")
