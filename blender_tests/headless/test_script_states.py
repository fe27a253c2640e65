# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions for scripts on objects as files and scripts leave them: in other modes, new, hidden, elsewhere, linked."""

from collections.abc import Callable
from pathlib import Path

import bpy
import numpy as np
import pytest
import seamwire
from scene import add_grid, edit, seams

Work = Callable[[bpy.types.Object], object]

WORKS: dict[str, Work] = {
    "mark": lambda obj: seamwire.mark(obj, [[10, 14]]),
    "unwrap": lambda obj: seamwire.unwrap(obj, changed_only=False),
    "suggest": lambda obj: seamwire.suggest(obj, islands=2),
}
every_work = pytest.mark.parametrize("work", WORKS.values(), ids=WORKS)


def state() -> list[tuple[object, ...]]:
    """Return the mode and the selection of each object in the view layer, and whether it is active."""
    layer = bpy.context.view_layer
    return [(obj.name, obj.mode, obj.select_get(), obj == layer.objects.active) for obj in layer.objects]


def add(kind: str) -> bpy.types.Object:
    """Add an object, active and alone selected."""
    if kind == "MESH":
        obj = add_grid(5, name="Beside")
    else:
        group, _, name = {
            "CURVE": "curve.primitive_bezier_circle_add",
            "FONT": "object.text_add",
            "META": "object.metaball_add",
            "LATTICE": "object.add",
            "ARMATURE": "object.armature_add",
        }[kind].partition(".")
        getattr(getattr(bpy.ops, group), name)(**({"type": "LATTICE"} if kind == "LATTICE" else {}))
        obj = bpy.context.active_object
    for other in bpy.context.view_layer.objects:
        other.select_set(other == obj)
    return obj


@pytest.mark.every_blender
@every_work
@pytest.mark.parametrize("own", [True, False], ids=["own", "beside"])
@pytest.mark.parametrize("mode", ["SCULPT", "WEIGHT_PAINT", "VERTEX_PAINT", "TEXTURE_PAINT", "EDIT", "PARTICLE_EDIT"])
def test_any_mode_of_a_mesh_stays_as_it_is(mode: str, own: bool, work: Work) -> None:
    obj = add_grid(5)
    active = obj if own else add("MESH")
    if mode == "PARTICLE_EDIT":
        active.modifiers.new("Hair", "PARTICLE_SYSTEM").particle_system.settings.type = "HAIR"
    bpy.ops.object.mode_set(mode=mode)
    before = state()
    assert work(obj)
    assert state() == before
    assert (active.name, mode, True, True) in before


@pytest.mark.every_blender
@pytest.mark.parametrize("kind", ["CURVE", "FONT", "META", "LATTICE", "ARMATURE"])
def test_another_object_may_be_in_edit_mode(kind: str) -> None:
    obj = add_grid(5)
    add(kind)
    bpy.ops.object.mode_set(mode="EDIT")
    before = state()
    for work in WORKS.values():
        work(obj)
        assert state() == before
    assert seams(obj) and obj.data.uv_layers


@pytest.mark.every_blender
def test_weights_are_painted_while_the_bones_are_posed() -> None:
    obj = add_grid(5)
    bones = add("ARMATURE")
    bpy.ops.object.mode_set(mode="POSE")
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode="WEIGHT_PAINT")
    before = state()
    for work in WORKS.values():
        work(obj)
        assert state() == before
    assert seams(obj) and obj.data.uv_layers
    assert (bones.mode, obj.mode) == ("POSE", "WEIGHT_PAINT")


@pytest.mark.every_blender
@every_work
def test_two_meshes_in_edit_mode_stay_there_and_one_is_worked_on(work: Work) -> None:
    first, second = add_grid(5, name="First"), add_grid(5, name="Second")
    edit()
    assert first.mode == second.mode == "EDIT"
    before = state()
    assert work(first)
    assert state() == before
    first.update_from_editmode()
    second.update_from_editmode()
    assert not second.data.uv_layers and not seams(second)
    assert first.data.uv_layers or seams(first)


@every_work
def test_without_an_active_object_there_is_none_afterwards(work: Work) -> None:
    obj = add_grid(5)
    bpy.context.view_layer.objects.active = None
    assert work(obj)
    assert bpy.context.view_layer.objects.active is None and obj.mode == "OBJECT"


@pytest.mark.every_blender
@every_work
def test_an_object_that_shares_its_mesh_with_one_in_another_mode_works(work: Work) -> None:
    obj = add_grid(5)
    other = bpy.data.objects.new("Other", obj.data)
    bpy.context.collection.objects.link(other)
    edit()
    before = state()
    assert work(other)
    assert state() == before


@pytest.mark.every_blender
@every_work
def test_an_object_can_be_used_as_soon_as_a_script_has_made_it(work: Work) -> None:
    obj = add_grid(5)
    collection = bpy.data.collections.new("New")
    bpy.context.scene.collection.children.link(collection)
    copy = obj.copy()
    copy.data = obj.data.copy()
    copy.scale = (1.0, 3.0, 1.0)
    collection.objects.link(copy)
    assert work(copy)
    moved = bpy.data.objects.new("Moved", obj.data.copy())
    bpy.context.collection.objects.link(moved)
    bpy.context.collection.objects.unlink(moved)
    collection.objects.link(moved)
    assert work(moved)


@pytest.mark.every_blender
def test_an_appended_object_can_be_used_at_once(tmp_path: Path) -> None:
    obj = add_grid(5)
    path = str(tmp_path / "library.blend")
    bpy.data.libraries.write(path, {obj})
    bpy.data.objects.remove(obj)
    for link in (False, True):
        with bpy.data.libraries.load(path, link=link) as (_, into):
            into.objects = ["Grid"]
        (found,) = into.objects
        bpy.context.collection.objects.link(found)
        if not link:
            assert seamwire.mark(found, [[10, 14]]).marked == 4
            continue
        for work in WORKS.values():
            with pytest.raises(
                ValueError, match=r"^Grid cannot be edited: it is linked from .*library\.blend\. Make it local$"
            ):
                work(found)
        override = found.override_create()
        bpy.context.collection.objects.link(override)
        for work in WORKS.values():
            with pytest.raises(
                ValueError, match=r"Grid.* cannot be edited: .*(linked from|a library override).*\. Make it local"
            ):
                work(override)


@every_work
def test_where_an_object_is_that_is_not_in_the_view_layer_is_said(work: Work) -> None:
    add_grid(5)
    obj = bpy.data.objects.new("Elsewhere", bpy.data.objects["Grid"].data.copy())
    with pytest.raises(ValueError, match=r"Elsewhere is not in the view layer ViewLayer: it is in no scene\. Link it"):
        work(obj)
    scene = bpy.data.scenes.new("Second")
    scene.collection.objects.link(obj)
    with pytest.raises(ValueError, match=r"it is in the scene Second\. Switch to that scene"):
        work(obj)
    collection = bpy.data.collections.new("Off")
    bpy.context.scene.collection.children.link(collection)
    collection.objects.link(obj)
    bpy.context.view_layer.layer_collection.children[collection.name].exclude = True
    with pytest.raises(ValueError, match=r"its collection is excluded\. Include the collection"):
        work(obj)
    bpy.data.objects.remove(obj)
    with pytest.raises(ValueError, match="The object was removed"):
        work(obj)
    bpy.data.scenes.remove(scene)


@pytest.mark.every_blender
@every_work
def test_a_hidden_object_is_refused_by_name(work: Work) -> None:
    obj = add_grid(5)
    collection = bpy.data.collections.new("Lights off")
    bpy.context.scene.collection.children.link(collection)
    collection.objects.link(obj)
    bpy.context.collection.objects.unlink(obj)
    in_layer = bpy.context.view_layer.layer_collection.children[collection.name]
    hidings: tuple[Callable[[bool], object], ...] = (
        obj.hide_set,
        lambda hide: setattr(obj, "hide_viewport", hide),
        lambda hide: setattr(collection, "hide_viewport", hide),
        lambda hide: setattr(in_layer, "hide_viewport", hide),
    )
    bpy.context.view_layer.update()
    for hide in hidings:
        hide(True)
        with pytest.raises(ValueError, match=r"Grid cannot be edited: it is hidden\. Show it"):
            work(obj)
        hide(False)
    obj.hide_select = True
    assert work(obj)
    assert obj.hide_select


def hide_faces(obj: bpy.types.Object, count: int) -> None:
    """Hide the first faces of a mesh, and what belongs to these alone."""
    faces = obj.data.polygons
    shown = {pair for face in list(faces)[count:] for pair in face.edge_keys}
    kept = {vertex for pair in shown for vertex in pair}
    faces.foreach_set("hide", np.arange(len(faces)) < count)
    for edge in obj.data.edges:
        edge.hide = edge.key not in shown
    for vertex in obj.data.vertices:
        vertex.hide = vertex.index not in kept


@pytest.mark.every_blender
def test_a_mesh_without_a_visible_face_is_told_with_one_sentence() -> None:
    obj = add_grid(5)
    hide_faces(obj, 16)
    said = set()
    for work in (*WORKS.values(), seamwire.cut):
        with pytest.raises(ValueError, match="No face is visible in Grid: it has no faces, or all are hidden") as error:
            work(obj)
        said.add(str(error.value))
    assert len(said) == 1


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"chains": [3, 5]}, r"chains\[0\]: 3 is not a list of seeds"),
        ({"chains": None}, "chains: None is not a list"),
        ({"chains": 5}, "chains: 5 is not a list"),
        ({"chains": "0 5"}, "chains: '0 5' is not a list"),
        ({"chains": [{0, 5}]}, r"chains\[0\]: \{0, 5\} is not a list"),
        ({"chains": [["123", 5]]}, r"chains\[0\]\[0\]: '123' is neither"),
        ({"chains": [[True, 5]]}, r"chains\[0\]\[0\]: True is neither"),
        ({"loops": 5}, "loops: 5 is not a list"),
        ({"strokes": [0, 1, 2]}, r"strokes\[0\]: 0 is not a list of vertices"),
        ({"strokes": None}, "strokes: None is not a list"),
        ({"avoid": 4}, "avoid: 4 is not a list"),
        ({"along": None}, "along=None: choose one of"),
        ({"finish": ["CUT"]}, "finish=.*: choose one of"),
        ({"metric": 1}, "metric=1: choose one of"),
        ({"take": []}, "take=.*: choose one of"),
        ({"clear": "no"}, "clear='no': choose True or False"),
        ({"mirror": 5}, "mirror: 5 is not a list of axes"),
        ({"mirror": [["X"]]}, r"mirror: \['X'\] is not an axis"),
        ({"strength": "10"}, "strength='10': choose a number"),
        ({"strength": float("nan")}, "strength=nan: choose a number"),
        ({"strength": 10**400}, "strength=10*: choose a number"),
        ({"strength": 1000}, "strength=1000: choose a number from 1 to 100"),
        ({"strength": -1}, "strength=-1: choose a number from 1 to 100"),
    ],
)
def test_a_wrong_argument_of_mark_is_named(options: dict[str, object], said: str) -> None:
    obj = add_grid(5)
    with pytest.raises(ValueError, match=said):
        seamwire.mark(obj, **{"chains": [[10, 14]], **options})
    assert seams(obj) == []


@pytest.mark.parametrize(
    ("work", "options", "said"),
    [
        (seamwire.suggest, {"parts": None}, "parts=None: choose a number"),
        (seamwire.suggest, {"parts": 500}, "parts=500: choose a number from 0 to 100"),
        (seamwire.suggest, {"distortion": float("nan")}, "distortion=nan: choose a number"),
        (seamwire.suggest, {"islands": 0}, "islands=0: choose a number that is at least 1"),
        (seamwire.suggest, {"islands": 2.5}, "islands=2.5: choose a whole number"),
        (seamwire.suggest, {"front": 3}, "front=3: choose one of VIEW, FRONT, NONE"),
        (seamwire.suggest, {"symmetric": "yes"}, "symmetric='yes': choose True or False"),
        (seamwire.suggest, {"view_direction": (1, 2)}, r"view_direction=\(1, 2\): choose 3 numbers"),
        (seamwire.suggest, {"view_direction": 3}, "view_direction: 3 is not a list"),
        (seamwire.unwrap, {"method": None}, "method=None: choose one of SEAMWIRE"),
        (seamwire.unwrap, {"stack": None}, "stack=None: choose True or False"),
    ],
)
def test_a_wrong_option_is_named(work: Callable[..., bool], options: dict[str, object], said: str) -> None:
    obj = add_grid(5)
    with pytest.raises(ValueError, match=said):
        work(obj, **options)
    assert seams(obj) == [] and not obj.data.uv_layers


@pytest.mark.parametrize("value", [None, "Grid", 5])
def test_what_is_no_object_is_refused(value: object) -> None:
    for work in (*WORKS.values(), seamwire.cut):
        with pytest.raises(ValueError, match="is not an object"):
            work(value)
