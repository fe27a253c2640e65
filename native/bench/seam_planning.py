# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams and maps of one model by the library: the planner's, and the artist's seams flattened."""

from __future__ import annotations

import threading
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
import seamwire_core as sw
from uv_maps import Model, UvMap, fan
from uv_pictures import arranged

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Integers = NDArray[np.int64]
    Result = TypeVar("Result")

OURS, TREE, ARTIST = "ours", "tree", "artist"
"""Methods: the plan at the default bound, the first tree of slits, and the artist's seams flattened by the library."""


_POLLING = 0.005
"""Seconds between two looks at the best plan so far."""


def in_own_process(function: Callable[..., Result], *arguments: object) -> Result:
    """Call a function in a fresh process, so that peak memory is its own and a crash ends nothing else.

    Raises BrokenProcessPool if the process dies.
    """
    with ProcessPoolExecutor(max_workers=1, mp_context=get_context("spawn")) as pool:
        return pool.submit(function, *arguments).result()


def triangulated(model: Model) -> Integers:
    """Return the triangles (m, 3) of a model's polygons; quads are cut as Blender cuts them, larger polygons into fans."""
    sizes = np.diff(model.start)
    if sizes.max() > 4:
        return model.corners[fan(model.start)]
    triangles, _ = sw.triangulate(model.points, model.corners.astype(np.int32), sizes.astype(np.int32))
    return triangles.astype(np.int64)


def flattened(model: Model, triangles: Integers, cuts: Integers, info: dict[str, Any]) -> UvMap:
    """Return the map of a model that is cut along edges (k, 2), its islands side by side."""
    flat = sw.flatten(model.points, triangles.astype(np.int32), cuts.astype(np.int32))
    return arranged(UvMap(model.points, triangles, flat.uvs, info | {"is_packed": False}))


def cut_edges(plan: sw.SeamPlan) -> Integers:
    """Return the edges (k, 2) along which a plan's wires cut."""
    chains = [np.asarray(wire.vertices, dtype=np.int64) for wire in plan.wires]
    pairs = [np.stack([chain[:-1], chain[1:]], axis=1) for chain in chains]
    return np.unique(np.sort(np.concatenate([np.zeros((0, 2), dtype=np.int64), *pairs]), axis=1), axis=0)


def artist_map(model: Model) -> UvMap | None:
    """Return the artist's seams flattened by the library, if there are any."""
    if model.artist_seams is None:
        return None
    began, processor = time.perf_counter(), time.process_time()
    uv_map = flattened(model, triangulated(model), model.artist_seams, {})
    uv_map.info.update(sec=time.perf_counter() - began, cpu=time.process_time() - processor)
    return uv_map


def peak_memory() -> float:
    """Return the megabytes that this process needed at most, on Linux.

    A child process inherits the peak that `resource.getrusage` tells from its parent, so this does not use it.
    """
    status = Path("/proc/self/status").read_text()
    return int(status.partition("VmHWM:")[2].split()[0]) / 1024


def planned_maps(
    model: Model, mirror: int | None, bounds: dict[str, float | None], along: str = "edges"
) -> dict[str, UvMap]:
    """Plan the seams of a model, once for each bound, and flatten them.

    Parameters
    ----------
    model
        The model.
    mirror
        The axis to whose normal plane through the origin it is symmetric, or None.
    bounds
        The method's name and its bound on the symmetric Dirichlet energy. None: the planner's default. The first one also
        gives the tree that the planner begins with.
    along
        "edges" or "surface". Wires across the surface are snapped to edges for the map.

    Returns
    -------
    dict
        The map of each method. Its ``info`` has the seconds to the first tree (``first``), and the seconds and the processor
        seconds to the end (``sec``, ``cpu``). ``mem`` is the peak memory in megabytes beyond that at the start, and
        ``is_reached`` whether the planner says that the bound is reached. ``bound`` is that bound, None for the default.
    """
    start_memory, began, processor = peak_memory(), time.perf_counter(), time.process_time()
    triangles = triangulated(model)
    surface = sw.Surface(model.points, triangles.astype(np.int32), model.edges.astype(np.int32))
    planner = sw.SeamPlanner(surface, along=along, front=model.frame.axes[2], mirror=mirror)
    prepared = time.perf_counter() - began, time.process_time() - processor
    maps: dict[str, UvMap] = {}
    for method, bound in bounds.items():
        began, processor = time.perf_counter(), time.process_time()
        with FirstPlan(planner) as first:
            plan = planner.plan(**({} if bound is None else {"distortion": bound}))
        memory = peak_memory() - start_memory
        maps[method] = flattened(model, triangles, cut_edges(plan), {})
        until_tree = prepared[0] + (first.seconds or time.perf_counter() - began)
        maps[method].info.update(
            sec=prepared[0] + time.perf_counter() - began,
            cpu=prepared[1] + time.process_time() - processor,
            first=until_tree,
            mem=memory,
            is_reached=bool(plan.is_reached),
            bound=bound,
        )
        if first.plan is not None and TREE not in maps:
            info = {"sec": until_tree, "first": until_tree}
            maps[TREE] = flattened(model, triangles, cut_edges(first.plan), info)
    return maps


class FirstPlan:
    """Waits on a thread for the first plan that a planner finds while another thread plans.

    Parameters
    ----------
    planner
        The planner. A plan that it has from before does not count.
    """

    def __init__(self, planner: sw.SeamPlanner) -> None:
        self._planner, self._before = planner, planner.best_so_far
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._watch)
        self.plan: sw.SeamPlan | None = None
        self.seconds: float | None = None
        """Seconds from entering to the first plan, or None if the planner showed no plan before its end."""

    def __enter__(self) -> FirstPlan:
        self._began = time.perf_counter()
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended.set()
        self._thread.join()

    def _watch(self) -> None:
        while not self._ended.wait(_POLLING):
            plan = self._planner.best_so_far
            if plan is not None and plan is not self._before:
                self.plan, self.seconds = plan, time.perf_counter() - self._began
                return
