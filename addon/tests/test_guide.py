# SPDX-License-Identifier: GPL-3.0-or-later
"""The guide names each action and its keys as the tool does."""

from pathlib import Path

from seamwire.words.keys import Bindings

GUIDE = (Path(__file__).resolve().parents[2] / "docs/guide/keys.md").read_text(encoding="utf-8")


def test_the_table_of_keys_is_that_of_the_tool() -> None:
    table = GUIDE[GUIDE.index("| Key | Action |") :].split("\n\n")[0]
    named = [tuple(part.strip() for part in row.split("|")[1:3]) for row in table.splitlines()[2:]]
    assert named == Bindings().rows()
