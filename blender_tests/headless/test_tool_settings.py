# SPDX-License-Identifier: GPL-3.0-or-later
"""Which settings the tool shows where."""

from dataclasses import fields
from types import SimpleNamespace

import bpy
import pytest
from scene import add_grid, edit
from seamwire.mesh import settings as chosen
from seamwire.tool.acts import ACTS
from seamwire.tool.keymaps import HELP_PANEL
from seamwire.ui import toolbar
from seamwire.words.keys import Action

pytestmark = pytest.mark.every_blender


class Layout:
    """Takes the place of Blender's layout, and notes the controls."""

    def __init__(self, shown: list[str]) -> None:
        self.shown = shown

    def prop(self, owner: object, name: str, **_options: object) -> None:
        """Note a property that there is."""
        assert hasattr(owner, name)
        self.shown.append(name)

    def operator(self, name: str, **_options: object) -> None:
        """Note an operator that there is."""
        getattr(bpy.ops.mesh, name.partition(".")[2]).get_rna_type()
        self.shown.append(name)

    def popover(self, panel: str, **_options: object) -> None:
        """Note a popover that there is."""
        assert hasattr(bpy.types, panel)
        self.shown.append(panel)

    def label(self, **_options: object) -> None:
        """Show text."""

    def _part(self, **_options: object) -> "Layout":
        return Layout(self.shown)

    row = column = box = _part


@pytest.fixture
def tool() -> chosen.SeamwireSettings:
    """The settings, with a mesh in Edit Mode; put back afterwards."""
    add_grid(3)
    edit()
    yield chosen.settings()
    for name in ("along", "metric"):
        chosen.settings().property_unset(name)


def shown_in(region: str) -> list[str]:
    """Return the controls in a kind of region."""
    shown: list[str] = []
    context = SimpleNamespace(
        region=SimpleNamespace(type=region), preferences=bpy.context.preferences, edit_object=bpy.context.edit_object
    )
    toolbar.draw_settings(context, Layout(shown))
    return shown


@pytest.mark.parametrize("along", ["EDGES", "SURFACE"])
def test_the_header_has_at_most_six_controls_and_the_help(tool: chosen.SeamwireSettings, along: str) -> None:
    tool.along = along
    suggest, unwrap, *shown, help_panel = shown_in("TOOL_HEADER")
    assert (suggest, unwrap) == ("mesh.seamwire_suggest", "mesh.seamwire_unwrap")
    assert 3 < len(shown) <= 6
    assert help_panel == HELP_PANEL
    assert {"along", "clear", "VIEW3D_PT_seamwire_overlays"} <= set(shown)


@pytest.mark.parametrize("along", ["EDGES", "SURFACE"])
def test_every_setting_is_shown_once_outside_the_header(tool: chosen.SeamwireSettings, along: str) -> None:
    tool.along = along
    shown = shown_in("WINDOW")
    toolbar.VIEW3D_PT_seamwire_overlays.draw(
        SimpleNamespace(layout=Layout(shown)), SimpleNamespace(preferences=bpy.context.preferences)
    )
    of_mesh = {"use_mirror_x", "use_mirror_y", "use_mirror_z"}
    other = "strength_surface" if along == "EDGES" else "strength_edges"
    names = {prop.identifier for prop in tool.bl_rna.properties} - {"rna_type", "name", other}
    assert sorted(shown) == sorted(names | of_mesh)


def test_the_sidebar_has_a_panel_for_each_group(tool: chosen.SeamwireSettings) -> None:
    assert shown_in("UI") == []
    for name in toolbar.GROUPS:
        panel = getattr(bpy.types, f"VIEW3D_PT_seamwire_{name.lower()}")
        assert (panel.bl_region_type, panel.bl_parent_id) == ("UI", "VIEW3D_PT_active_tool")


def test_options_have_the_defaults_of_the_settings(tool: chosen.SeamwireSettings) -> None:
    options = chosen.Options()
    for field in fields(chosen.Options):
        prop = tool.bl_rna.properties.get(field.name)
        if prop is not None and prop.type in {"BOOLEAN", "ENUM"} and field.name not in {"along", "finish"}:
            assert prop.default == getattr(options, field.name), field.name


def test_each_action_of_a_chain_is_in_the_table() -> None:
    assert set(Action) <= set(ACTS)
