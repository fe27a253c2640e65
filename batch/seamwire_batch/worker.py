# SPDX-License-Identifier: GPL-3.0-or-later
"""One asset in Blender: ``blender --background --factory-startup --python worker.py -- JOB``, or Python with ``bpy``.

JOB is a JSON file of `jobs.Job`. The result goes into ``result.json`` of the job's folder, whole or not at all, beside the files that were
made. Failures of the asset are errors in that file. If Blender ends without the file, it has crashed.
"""

from __future__ import annotations

import importlib
import json
import os
import pkgutil
import sys
import tempfile
import time
import traceback
from contextlib import ExitStack, contextmanager
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import TYPE_CHECKING, Any

if "seamwire_batch" not in sys.modules:
    # Its folder may lie among packages for another Python: they must not stand before Blender's own.
    _folder = Path(__file__).resolve().parent
    _spec = spec_from_file_location(
        "seamwire_batch", _folder / "__init__.py", submodule_search_locations=[str(_folder)]
    )
    sys.modules["seamwire_batch"] = module_from_spec(_spec)
    _spec.loader.exec_module(sys.modules["seamwire_batch"])

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import bpy
    import numpy as np
    from seamwire.mesh.object_session import ObjectSession
    from seamwire_networks.carry import Source

    from seamwire_batch.assets import MeshObjects

_MOST_SKIPPED = 20
"""Objects that are skipped by name."""


def limit_memory(megabytes: int) -> None:
    """Let this process take so much more memory than it has now; what asks for more fails.

    What counts is memory that can be written to. Addresses that are only reserved do not count: each thread's heap reserves 64 MB. Nor do
    the stacks of a thread for each processor, which Blender starts sooner or later.
    """
    import resource

    stack = resource.getrlimit(resource.RLIMIT_STACK)[0]
    stacks = (os.cpu_count() or 1) * (8 << 20 if stack == resource.RLIM_INFINITY else stack)
    most = _kilobytes("VmData") * 1024 + stacks + megabytes * (1 << 20)
    resource.setrlimit(resource.RLIMIT_DATA, (most, most))


def end_with_parent() -> None:
    """Let Linux end this process where the one that started it is killed."""
    import ctypes
    import signal

    ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


def peak_memory() -> float:
    """Return the most memory that this process had, in megabytes; 0: not known."""
    # What getrusage tells is at least what the process had that started this one.
    return _kilobytes("VmHWM") / 1024.0


def _kilobytes(of: str) -> int:
    """Return what Linux tells of this process's memory; 0: not known."""
    try:
        lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    except OSError:
        return 0
    return next((int(line.split()[1]) for line in lines if line.startswith(f"{of}:")), 0)


def enable_addons(folder: str | None) -> None:
    """Enable Seamwire and Seamwire Networks, which are installed or lie in a folder; raises AssetError.

    Blender would unpack an extension's compiled part into a folder that all of the user's Blenders share, and may remove it while they run.
    So the batch loads its own copy.
    """
    import addon_utils

    from seamwire_batch.assets import AssetError

    def enable(name: str) -> Any:  # noqa: ANN401 - a module
        return addon_utils.enable(name, **({"refresh_handled": True} if name.startswith("bl_ext.") else {}))

    if folder:
        sys.path.insert(0, folder)
    found = {}
    for addon, title in (("seamwire", "Seamwire"), ("seamwire_networks", "Seamwire Networks")):
        installed = [module.__name__ for module in addon_utils.modules() if module.__name__.split(".")[-1] == addon]
        found[addon] = next(filter(None, map(enable, [addon] if folder else installed)), None)
        if found[addon] is None:
            raise AssetError(f"The add-on {title} is not installed in this Blender: name its folder with --addon")
    native = importlib.import_module(f"{found['seamwire'].__name__}.core.base.native")
    if native.IS_EXTENSION:
        with tempfile.TemporaryDirectory() as unpacked:
            native.load_unpacked(Path(unpacked))
    for addon, module in found.items():
        # By one name, however it is installed.
        name = module.__name__
        for part in pkgutil.walk_packages(module.__path__, f"{name}."):
            importlib.import_module(part.name)
        for known in [known for known in sys.modules if known == name or known.startswith(f"{name}.")]:
            sys.modules[f"{addon}{known.removeprefix(name)}"] = sys.modules[known]


def values_for(operator: Any, given: dict[str, str]) -> dict[str, Any]:  # noqa: ANN401 - bpy.ops has no type
    """Return arguments of an operator, read from text by the kinds of its properties; raises AssetError."""
    from seamwire_batch.assets import AssetError

    properties = operator.get_rna_type().properties
    values: dict[str, Any] = {}
    for key, text in given.items():
        if key not in properties or key == "rna_type":
            raise AssetError(f"{operator.idname_py()} has no argument {key}")
        kind = properties[key].type
        try:
            if kind == "BOOLEAN":
                values[key] = {"true": True, "1": True, "false": False, "0": False}[text.lower()]
            elif kind == "INT":
                values[key] = int(text)
            elif kind == "FLOAT":
                values[key] = float(text)
            elif kind == "ENUM" and properties[key].is_enum_flag:
                values[key] = set(text.replace(",", " ").split())
            else:
                values[key] = text
        except (KeyError, ValueError) as error:
            raise AssetError(f"{key}={text}: not what {operator.idname_py()} takes there") from error
    return values


def json_values(given: dict[str, str]) -> dict[str, Any]:
    """Return arguments of a function. Each is read as JSON, or is text if it is not JSON."""
    values: dict[str, Any] = {}
    for key, text in given.items():
        try:
            values[key] = json.loads(text)
        except ValueError:
            values[key] = text
    return values


def _stretch_wanted(operator: Any, options: dict[str, Any]) -> float:  # noqa: ANN401 - bpy.ops has no type
    """Return the stretch in percent that the arguments of Suggest Seamwires ask for."""
    return options.get("distortion", operator.get_rna_type().properties["distortion"].default)


class Run:
    """The work on one asset.

    Parameters
    ----------
    job
        As `jobs.Job` has it.
    """

    def __init__(self, job: dict[str, Any]) -> None:
        self._job = job
        self._folder = Path(job["folder"])
        self.warnings: list[str] = []
        self._stretch_wanted = 0.0
        self._may_stack = False

    def source(self) -> dict[str, Any]:
        """Write the networks of a source asset, one file for each object that has seams, and return their names."""
        from seamwire_batch.assets import AssetError, mesh_objects, open_asset

        open_asset(Path(self._job["asset"]))
        from seamwire.mesh.object_session import ObjectSession

        made: dict[str, str] = {}
        for obj in mesh_objects().readable:
            try:
                source = _network_of(ObjectSession(obj))
            except ValueError:
                continue
            if not source.network.courses:
                continue
            stem = f"source-{len(made)}"
            source.save(self._folder / f"{stem}.json")
            made[obj.name] = stem
        if not made:
            raise AssetError("The source has no seams")
        return {"sources": made}

    def asset(self) -> dict[str, Any]:
        """Open the asset, mark, unwrap, write, and return what it has then."""
        import bpy

        from seamwire_batch.assets import mesh_objects, open_asset, unwrap, write_asset
        from seamwire_batch.contents import contents

        job = self._job
        path = Path(job["asset"])
        open_asset(path)
        before = contents(path)
        objects = self._chosen(mesh_objects())
        options = values_for(bpy.ops.mesh.seamwire_unwrap, job["unwrap"])
        self._may_stack = bool(options.get("stack"))
        for obj in objects:
            with _editing(obj):
                self._mark(obj)
                unwrap(obj, **options)
                self._check_map(obj)
                bpy.ops.mesh.seamwire_store(what="ATTRIBUTE")
        numbers = self._measured(objects)
        self._save_networks(objects)
        bare = self._check_open({obj.name for obj in objects})
        written = self._folder / job["output"]
        write_asset(written)
        if job["pictures"]:
            self._picture(objects)
        self._check_written(written, before, bare)
        return numbers

    # Ways of marking

    def _chosen(self, meshes: MeshObjects) -> list[bpy.types.Object]:
        """Return the objects that get seams: where one network is for one mesh, which one must be clear."""
        from seamwire_networks.carry import Source

        from seamwire_batch.assets import AssetError

        job, objects, skipped = self._job, meshes.found, meshes.skipped
        if job["object"]:
            objects = [obj for obj in objects if obj.name == job["object"]]
            skipped = {obj: why for obj, why in skipped.items() if obj.name == job["object"]}
        if not objects:
            named = f" called {job['object']}" if job["object"] else ""
            whys = ". ".join([*skipped.values()][:_MOST_SKIPPED])
            raise AssetError(whys or f"There is no mesh object{named} with faces in it")
        self.warnings += [f"Skipped: {why}" for why in [*skipped.values()][:_MOST_SKIPPED]]
        if len(skipped) > _MOST_SKIPPED:
            self.warnings.append(f"Skipped: {len(skipped) - _MOST_SKIPPED} other objects")
        if job["way"] == "suggest" or len(objects) == 1:
            return objects
        if job["way"] == "source":
            found = [obj for obj in objects if _plain(obj.name) in map(_plain, job["sources"])]
            if found:
                return found
        if job["way"] == "network":
            name = Source.load(Path(job["network"])).network.origin.name
            found = [obj for obj in objects if _plain(name) in {_plain(obj.name), _plain(obj.data.name)}]
            if len(found) == 1:
                return found
        names = ", ".join(obj.name for obj in objects[:5])
        raise AssetError(f"It has {len(objects)} mesh objects ({names}): say with --object which one gets the seams")

    def _mark(self, obj: bpy.types.Object) -> None:
        import bpy
        import seamwire

        way = self._job["way"]
        if way == "mark":
            done = self._call(obj, seamwire.mark, json_values(self._job["arguments"]))
            self.warnings.extend(f"{obj.name}: {problem}" for problem in done.problems)
            return
        if way == "suggest":
            operator = bpy.ops.mesh.seamwire_suggest
            options = {**values_for(operator, self._job["arguments"]), "unwrap": False}
            self._stretch_wanted = _stretch_wanted(operator, options)
            if not self._call(obj, seamwire.suggest, options):
                self.warnings.append(f"{obj.name}: nothing was marked")
            return
        from seamwire.mesh.object_session import ObjectSession
        from seamwire_networks.carry import add, carry_over

        from seamwire_batch.assets import AssetError

        mesh = ObjectSession(obj)
        self.warnings.extend(f"{obj.name}: {notice.text}" for notice in mesh.notices.take())
        options = {name: self._job[name] for name in ("place", "mirror", "align")}
        found = carry_over(mesh, self._source(obj), pairs=self._job["pairs"], **options)()
        self.warnings += [f"{obj.name}: {problem}" for problem in found.problems]
        if not found.wires:
            raise AssetError(f"{obj.name}: no wire has a place on this mesh")
        add(mesh, found)
        mesh.write(mesh.plan())

    def _source(self, obj: bpy.types.Object) -> Source:
        """Return the network for an object, from a file or from the source asset."""
        from seamwire_networks.carry import Source

        if self._job["way"] == "network":
            return Source.load(Path(self._job["network"]))
        return Source.load(Path(f"{self._stem_of(obj)}.json"), with_mesh=True)

    def _stem_of(self, obj: bpy.types.Object) -> str:
        from seamwire_batch.assets import AssetError

        sources = self._job["sources"]
        named = [stem for name, stem in sources.items() if _plain(name) == _plain(obj.name)]
        if not named and len(sources) == 1:
            named = list(sources.values())
        if len(named) != 1:
            raise AssetError(
                f"{obj.name}: the source has seams on {len(sources)} objects, and none is called like this one"
            )
        return named[0]

    def _call(self, obj: bpy.types.Object, work: Callable[..., Any], options: dict[str, Any]) -> Any:  # noqa: ANN401
        """Call a function of the add-on; raises AssetError with what it could not do."""
        from seamwire_batch.assets import AssetError

        try:
            return work(obj, **options)
        except (ValueError, TypeError) as error:
            raise AssetError(f"{obj.name}: {error}") from error

    # The results

    def _check_open(self, chosen: set[str]) -> int:
        """Raise AssetError if a chosen object has no UV map. Warn of objects that are not written. Return how many meshes have no map."""
        import bpy

        from seamwire_batch.assets import AssetError
        from seamwire_batch.contents import unmapped

        bare = unmapped()
        if chosen & bare:
            raise AssetError(f"{', '.join(sorted(chosen & bare))}: no UV map came out")
        if not self._job["output"].endswith((".blend", ".glb")):
            elsewhere = sorted(name for name in chosen if name not in bpy.context.scene.objects)
            if elsewhere:
                self.warnings.append(f"Not written, because only one scene can be: {', '.join(elsewhere)}")
        return len(bare)

    def _check_written(self, path: Path, before: dict[str, int], bare: int) -> None:
        """Open the written file, which ends the one that is open. Raise AssetError if more meshes than `bare` have no UV map there.

        Warn of data that the asset had `before`, and the written file does not have.
        """
        from seamwire_batch.assets import AssetError, open_asset
        from seamwire_batch.contents import contents, lost, unmapped

        open_asset(path)
        missing = unmapped()
        if len(missing) > bare:
            raise AssetError(f"The written file has no UV map of {', '.join(sorted(missing))}")
        gone = lost(before, contents(path))
        if gone:
            self.warnings.append(f"Lost in the {path.suffix[1:].upper()} file: {', '.join(gone)}")

    def _check_map(self, obj: bpy.types.Object) -> None:
        """Warn of what is wrong with the UV map that an object in edit mode has."""
        from seamwire.core.seams.seam_plan import stretch_of
        from seamwire.mesh.unwrap import faults_of
        from seamwire.mesh.uv_islands import aspect, mapped
        from seamwire.words.reports import in_words, not_reached, percent

        surface = mapped(obj)
        if surface is None:
            return
        hidden, faces = sum(face.hide for face in obj.data.polygons), len(obj.data.polygons)
        if hidden:
            self.warnings.append(f"{obj.name}: {hidden} of {faces} faces are hidden and were not unwrapped")
        told = in_words(faults_of(obj, may_stack=self._may_stack))
        if self._stretch_wanted:
            stretch = 100.0 * stretch_of(surface.energy(aspect(obj)))
            missed = not_reached([stretch], self._stretch_wanted)
            told += [f"stretch {percent(stretch)}, {missed}"] if missed else []
        self.warnings += [f"{obj.name}: {text}" for text in told]

    def _measured(self, objects: list[bpy.types.Object]) -> dict[str, Any]:
        """Return the counts of seams and islands, and how many times longer or larger triangles are in the map on average and at worst."""
        import numpy as np
        from seamwire.mesh import edit_mesh
        from seamwire.mesh.uv_islands import labels_of, stretch_of

        from seamwire_batch.assets import AssetError

        seams = islands = faces = 0
        angles, areas, weights, worst = [], [], [], 0.0
        for obj in objects:
            with _editing(obj):
                arrays = edit_mesh.read(obj)
                labels = labels_of(arrays)
                stretch = stretch_of(obj, arrays)
            seams += len(arrays.seams)
            faces += len(obj.data.polygons)
            islands += int(labels.max(initial=-1)) + 1
            if stretch is not None:
                (angle, weight), (area, _) = (stretch.islands(labels, kind) for kind in ("ANGLE", "AREA"))
                angles.append(angle)
                areas.append(area)
                weights.append(weight)
                worst = max(worst, float(np.maximum(angle, area).max()))
        mean = [0.0, 0.0]
        if weights and np.concatenate(weights).sum() > 0.0:
            mean = [float(np.average(np.concatenate(one), weights=np.concatenate(weights))) for one in (angles, areas)]
        else:
            raise AssetError("It has no UV map to measure")
        return {
            "objects": len(objects),
            "faces": faces,
            "seams": seams,
            "islands": islands,
            "angle": round(2.0 ** mean[0], 4),
            "area": round(2.0 ** mean[1], 4),
            "worst": round(2.0**worst, 4),
        }

    def _save_networks(self, objects: list[bpy.types.Object]) -> None:
        """Write the seams of each object as a network beside the asset: few formats keep seams."""
        from seamwire.mesh.object_session import ObjectSession
        from seamwire.mesh.settings import settings
        from seamwire_networks.carry import network_of, seam_wires

        for number, obj in enumerate(objects):
            with _editing(obj):
                try:
                    mesh = ObjectSession(obj)
                    network = network_of(mesh, settings(), seam_wires(mesh))
                except ValueError:
                    continue
            if not network.courses:
                continue
            name = f"{self._job['name']}.{number}.json" if len(objects) > 1 else f"{self._job['name']}.json"
            (self._folder / name).write_text(network.text(), encoding="utf-8")

    def _picture(self, objects: list[bpy.types.Object]) -> None:
        """Render the objects together; a picture that cannot be made is a warning."""
        from seamwire.core.seams.seam_wires import wires_between
        from seamwire.mesh import edit_mesh
        from seamwire.mesh.uv_islands import labels_of

        from seamwire_batch.pictures import Marks, Scene

        try:
            whole = _joined(objects)
            arrays = edit_mesh.read(whole)
            wires = list(wires_between(arrays.seams, (), arrays.points))
            network = Marks(wires, labels_of(arrays))
            scene = Scene(
                whole,
                network,
                arrays.triangles,
                arrays.polygons,
                size=self._job["size"],
                samples=self._job["samples"],
                seeds=False,
            )
            scene.strip(self._folder / f"{self._job['name']}.png")
        except (RuntimeError, ValueError, OSError) as error:
            self.warnings.append(f"No picture: {str(error).strip()}")


def _network_of(mesh: ObjectSession) -> Source:
    """Return the wires of an object and wires along its other seams, with all that is known of its mesh."""
    from seamwire.mesh.settings import settings
    from seamwire_networks.carry import Source, seam_wires

    return Source.of(mesh, settings(), seam_wires(mesh))


def _plain(name: str) -> str:
    """Return a name without the number that Blender puts behind one that is there twice, and without an ending of a file."""
    head, dot, tail = name.rpartition(".")
    return head if dot and tail.isdigit() else name


@contextmanager
def _editing(obj: bpy.types.Object) -> Iterator[None]:
    """Have an object in Edit Mode, in whichever scene it is; raises AssetError."""
    from seamwire.scripting import editing

    from seamwire_batch.assets import AssetError, shown

    with ExitStack() as stack:
        stack.enter_context(shown(obj))
        try:
            stack.enter_context(editing(obj))
        except ValueError as error:
            raise AssetError(str(error)) from error
        yield


def _joined(objects: list[bpy.types.Object]) -> bpy.types.Object:
    """Return one object made of several, where they are, alone in a new scene."""
    import bmesh
    import bpy

    joined = bmesh.new()
    for obj in objects:
        mesh = obj.data.copy()
        for layer in [layer.name for layer in mesh.uv_layers if layer != mesh.uv_layers.active]:
            mesh.uv_layers.remove(mesh.uv_layers[layer])
        if mesh.uv_layers:
            mesh.uv_layers[0].name = "UVMap"
        mesh.transform(obj.matrix_world)
        joined.from_mesh(mesh)
        bpy.data.meshes.remove(mesh)
    mesh = bpy.data.meshes.new("Whole")
    joined.to_mesh(mesh)
    joined.free()
    mesh.attributes.update()
    whole = bpy.data.objects.new("Whole", mesh)
    scene = bpy.data.scenes.new("Pictures")
    bpy.context.window.scene = scene
    scene.collection.objects.link(whole)
    return whole


def sheet(job: dict[str, Any]) -> dict[str, Any]:
    """Put pictures one above the other, two columns, into one."""
    import numpy as np

    from seamwire_batch.pictures import load, save

    columns: list[list[np.ndarray]] = [[], []]
    for number, path in enumerate(job["pictures"]):
        columns[number % 2].append(load(Path(path))[:, :, :3])
    if not columns[0]:
        return {}
    height = max(len(column) for column in columns)
    blank = np.full_like(columns[0][0], 0.93)
    rows = []
    for row in range(height):
        pair = [column[row] if row < len(column) else blank for column in columns]
        rows.append(np.concatenate(pair, axis=1))
    save(np.concatenate(rows[::-1], axis=0), Path(job["folder"]) / "sheet.png")
    return {}


def main() -> int:
    """Do the job that the last argument names."""
    job = json.loads(Path(sys.argv[sys.argv.index("--") + 1]).read_text(encoding="utf-8"))
    if sys.platform == "linux":
        end_with_parent()
    if job.get("memory"):
        limit_memory(int(job["memory"]))
    began = time.perf_counter()
    result: dict[str, Any] = {"error": None}
    run = None
    from seamwire_batch.assets import AssetError

    try:
        if job["kind"] == "sheet":
            result |= sheet(job)
        else:
            enable_addons(job["addon"])
            run = Run(job)
            result |= run.source() if job["kind"] == "source" else run.asset()
    except (AssetError, ValueError) as error:
        result["error"] = str(error).strip() or type(error).__name__
    except MemoryError:
        result["error"] = "Out of memory"
    except Exception as error:
        traceback.print_exc()
        result["error"] = f"{type(error).__name__}: {str(error).strip()}"
    result["warnings"] = [] if run is None else run.warnings
    result["inside"] = round(time.perf_counter() - began, 3)
    result["megabytes"] = round(peak_memory(), 1)
    folder = Path(job["folder"])
    (folder / "result.part").write_text(json.dumps(result), encoding="utf-8")
    (folder / "result.part").rename(folder / "result.json")
    return 0


if __name__ == "__main__":
    code = main()
    sys.stdout.flush()
    sys.exit(code)
