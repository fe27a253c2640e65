# SPDX-License-Identifier: GPL-3.0-or-later
"""The display's own pointer reaches Blender where the tests think it does."""

import bpy
import ui as driver

SEEN: list[tuple[str, str, int, int]] = []


class VIEW3D_OT_listen(bpy.types.Operator):  # noqa: N801
    """Notes every event until Esc."""

    bl_idname = "view3d.seamwire_test_listen"
    bl_label = "Listen"

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        SEEN.append((event.type, event.value, event.mouse_region_x, event.mouse_region_y))
        return {"FINISHED"} if event.type == "ESC" else {"RUNNING_MODAL"}


def test_a_real_click_arrives_at_the_position_meant(real_ui: driver.RealUi) -> None:
    bpy.utils.register_class(VIEW3D_OT_listen)
    with real_ui.override():
        bpy.ops.view3d.seamwire_test_listen("INVOKE_DEFAULT")
    real_ui.click((310, 220))
    real_ui.key("ESC")
    bpy.utils.unregister_class(VIEW3D_OT_listen)
    assert ("LEFTMOUSE", "PRESS", 310, 220) in SEEN
    assert ("LEFTMOUSE", "RELEASE", 310, 220) in SEEN
