# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel with the first steps and all keys."""

from types import SimpleNamespace

import bpy
import pytest
from seamwire.mesh.settings import preferences
from seamwire.tool import keymaps
from seamwire.ui import menus as panel
from seamwire.words import hints as words
from seamwire.words.keys import Action, Bindings


class Layout:
    """Notes what a panel shows, in a layout that Blender would draw."""

    def __init__(self, shown: list[object]) -> None:
        self.shown = shown

    def __getattr__(self, kind: str) -> object:
        def call(*arguments: object, **options: object) -> object:
            if kind == "label":
                self.shown.append(options["text"])
            elif kind == "prop":
                assert hasattr(*arguments), "the setting exists"
                self.shown.append(arguments[1])
            elif kind == "operator":
                operator = SimpleNamespace(name=arguments[0])
                self.shown.append(operator)
                return operator
            return Layout(self.shown)

        return call


@pytest.fixture(autouse=True)
def keys_as_they_come(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the keymaps be unchanged; other tests may have left them without keys."""
    monkeypatch.setattr(keymaps, "keys", lambda _context: Bindings())


def shown() -> list[object]:
    """Return what the panel shows, in its order."""
    found: list[object] = []
    panel.VIEW3D_PT_seamwire_help.draw(SimpleNamespace(layout=Layout(found)), bpy.context)
    return found


def test_the_panel_shows_each_action_with_its_keys_below_the_heading_of_its_group() -> None:
    found = shown()
    keys = found[found.index("Draw") :]
    expected: list[str] = []
    for action in Action:
        if action.group not in expected:
            expected.append(action.group)
        expected += [Bindings().text(action), action.text]
    assert keys == expected
    assert sum(action.text in keys for action in Action) == len(Action)


def test_a_fifth_group_of_keys_has_room(monkeypatch: pytest.MonkeyPatch) -> None:
    groups = {f"Group {number}": [("A", "Act")] for number in range(5)}
    monkeypatch.setattr(keymaps, "keys", lambda _context: SimpleNamespace(groups=lambda: groups))
    assert [text for text in shown() if text in groups] == list(groups)


@pytest.mark.parametrize("address", ["file:///guide/index.md", ""])
def test_the_panel_has_the_first_steps_their_switch_and_the_guide(
    address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(panel, "guide", lambda: address)
    found = shown()
    assert [text for _, text in words.STEPS if text not in found] == []
    assert "text" in found
    links = [(one.name, one.url) for one in found if isinstance(one, SimpleNamespace)]
    assert links == ([("wm.url_open", address)] if address else [])


def test_each_icon_of_the_first_steps_is_one_of_blenders() -> None:
    icons = bpy.types.UILayout.bl_rna.functions["label"].parameters["icon"].enum_items
    assert [icon for icon, _ in words.STEPS if icon not in icons] == []


def test_the_first_steps_are_shown_until_artists_turn_them_off() -> None:
    assert preferences().bl_rna.properties["text"].default == "STEPS"
