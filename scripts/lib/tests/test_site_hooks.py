# SPDX-License-Identifier: GPL-3.0-or-later
"""Links of the documentation site to files outside docs/."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from site_hooks import relinked

FORGE = "https://forge.example/seamwire/"


@pytest.mark.parametrize(
    ("page", "link", "led"),
    [
        ("install.md", "[script](../README.md#from-a-script)", f"[script]({FORGE}blob/main/README.md#from-a-script)"),
        ("library/a.md", "[h](../../native/a.hpp)", f"[h]({FORGE}blob/main/native/a.hpp)"),
        ("library/a.md", "[m](../method.md#wires)", "[m](../method.md#wires)"),
        ("library/a.md", "![p](../images/p.png)", "![p](../images/p.png)"),
        ("a.md", "[x](https://a.b/../c)", "[x](https://a.b/../c)"),
    ],
)
def test_links_out_of_the_site_lead_to_the_forge(page: str, link: str, led: str) -> None:
    assert relinked(f"See {link}.", page, FORGE) == f"See {led}."


def test_without_a_forge_they_are_plain_text() -> None:
    assert (
        relinked("See [script](../README.md#from) and [m](method.md).", "install.md", None)
        == "See script and [m](method.md)."
    )
