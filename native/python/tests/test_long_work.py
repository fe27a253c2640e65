# SPDX-License-Identifier: GPL-3.0-or-later
"""Long work lets other threads run, tells how far it is, and can be stopped."""

from __future__ import annotations

import hashlib
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor

import meshes
import numpy as np
import pytest
import seamwire_core as sw

Work = Callable[[Callable | None], object]


@pytest.fixture
def eager_threads() -> Iterator[None]:
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-4)
    yield
    sys.setswitchinterval(interval)


def longest_hold(work: Callable[[], object]) -> float:
    """Seconds of the processor that work used, at most, between two moments at which another Python thread could run."""
    clock = time.pthread_getcpuclockid(threading.get_ident())
    longest = 0.0
    begun, done = threading.Event(), threading.Event()

    def tick() -> None:
        nonlocal longest
        before = time.clock_gettime(clock)
        begun.set()
        while before:
            time.sleep(1e-4)  # one who wakes is let run sooner than one who never sleeps
            # One more once the work is done: where the lock was held all the time, that is the only one.
            last = done.is_set()
            now = time.clock_gettime(clock)
            longest = max(longest, now - before)
            before = 0.0 if last else now

    thread = threading.Thread(target=tick)
    thread.start()
    begun.wait()
    try:
        work()
    finally:
        done.set()
        thread.join()
    return longest


@pytest.fixture(scope="module")
def embedding_of_large(large: sw.Surface, large_metric: sw.Metric) -> sw.Embedding:
    return sw.embed(large, large_metric, max_error=0)


CALLS = (
    "Surface", "principal_curvatures", "feature_metric", "repr of a metric", "embed", "distance_field", "distance_field by heat",
    "edge_wires", "snap", "first_hit", "flatten", "live wire across", "live wire along", "live wire that builds its surface",
    "change of a live wire",
)  # fmt: skip


@pytest.mark.skipif(not hasattr(time, "pthread_getcpuclockid"), reason="no clock of another thread's processor time")
@pytest.mark.parametrize("call", CALLS)
def test_other_threads_run_meanwhile(
    call: str, large: sw.Surface, large_metric: sw.Metric, embedding_of_large: sw.Embedding, eager_threads: None
) -> None:
    """The lock of Python's threads is not held for longer than a millisecond."""
    points, triangles = np.asfortranarray(large.points), large.triangles.astype(np.uint16)
    curvature = sw.principal_curvatures(large)

    def live(along: str) -> None:
        wires = sw.LiveWire(large, along=along)
        wires.seed(0)
        wires.wait()

    def change() -> None:
        changed.set_metric("feature", max_anisotropy=5.0)
        changed.wires(9000)
        changed.wait()  # otherwise the next try competes with what this one leaves running

    if call == "change of a live wire":
        changed = sw.LiveWire(large)
        changed.seed(0)
        changed.wait()
    if call == "snap":
        across = sw.distance_field(embedding_of_large, 0).trace(9000)
    works: dict[str, Callable[[], object]] = {
        "Surface": lambda: sw.Surface(points, triangles),
        "principal_curvatures": lambda: sw.principal_curvatures(large),
        "feature_metric": lambda: sw.feature_metric(large, curvature),
        "repr of a metric": lambda: repr(large_metric),
        "embed": lambda: sw.embed(large, large_metric, max_error=0),
        "distance_field": lambda: sw.distance_field(embedding_of_large, 0),
        "distance_field by heat": lambda: sw.distance_field(embedding_of_large, 0, method="heat"),
        "edge_wires": lambda: sw.edge_wires(large, large_metric, 0),
        "snap": lambda: sw.snap_to_edges(sw.Surface(points, triangles), across),
        "first_hit": lambda: sw.RayTree(points, triangles).first_hit((0.0, 0.0, 9.0), (0.0, 0.0, -1.0)),
        "flatten": lambda: sw.flatten(*meshes.torus(60, 40)),
        "live wire across": lambda: live("surface"),
        "live wire along": lambda: live("edges"),
        "live wire that builds its surface": lambda: sw.LiveWire(points, triangles).wait_for_surface(),
        "change of a live wire": change,
    }
    # The system may stop the other thread for a while too, so one of many tries without such a stop is enough. The tries
    # last a while even if the work is short, because a busy machine stays busy for longer than that.
    give_up = time.monotonic() + 20.0
    tries = 0
    while tries < 30 or time.monotonic() < give_up:
        if longest_hold(works[call]) < 1e-3:
            return
        tries += 1
        time.sleep(0.02)
    # No try succeeds on a very busy machine, not even for work that certainly runs without the lock.
    many = bytes(5_000_000)
    if np.median([longest_hold(lambda: hashlib.sha256(many)) for _ in range(15)]) > 1e-3:
        pytest.skip("this machine is too busy to see a millisecond")
    pytest.fail(f"{call} holds the lock for more than a millisecond")


LONG = (
    "Surface", "principal_curvatures", "smoothed_curvatures", "feature_metric", "campen_metric", "pottmann_kovacs_metric",
    "concave_metric", "euclidean_metric", "apply_scribbles", "embed", "distance_field", "distance_field by heat", "edge_wires",
    "shortest_cycle", "flatten", "pack_islands",
)  # fmt: skip


@pytest.fixture(params=LONG)
def work(
    request: pytest.FixtureRequest, large: sw.Surface, large_metric: sw.Metric, embedding_of_large: sw.Embedding
) -> Work:
    curvature = sw.principal_curvatures(large)
    corners = large.triangles[:40, 0]
    stroke = sw.Scribble(large.points[corners], vertices=corners)
    return {
        "Surface": lambda progress: sw.Surface(large.points, large.triangles, progress=progress),
        "principal_curvatures": lambda progress: sw.principal_curvatures(large, progress),
        "smoothed_curvatures": lambda progress: sw.smoothed_curvatures(large, curvature, progress=progress),
        "feature_metric": lambda progress: sw.feature_metric(large, curvature, progress=progress),
        "campen_metric": lambda progress: sw.campen_metric(large, curvature, alpha=9.0, progress=progress),
        "pottmann_kovacs_metric": lambda progress: sw.pottmann_kovacs_metric(
            large, curvature, beta=1.0, progress=progress
        ),
        "concave_metric": lambda progress: sw.concave_metric(large, curvature, progress=progress),
        "euclidean_metric": lambda progress: sw.euclidean_metric(large, curvature, progress),
        "apply_scribbles": lambda progress: sw.apply_scribbles(large, large_metric, [stroke], progress=progress),
        "embed": lambda progress: sw.embed(large, large_metric, progress=progress, max_error=0),
        "distance_field": lambda progress: sw.distance_field(embedding_of_large, 0, progress=progress),
        "distance_field by heat": lambda progress: sw.distance_field(
            embedding_of_large, 0, method="heat", progress=progress
        ),
        "edge_wires": lambda progress: sw.edge_wires(large, large_metric, 0, progress=progress),
        "flatten": lambda progress: sw.flatten(*meshes.torus(60, 40), progress=progress),
        "pack_islands": lambda progress: sw.pack_islands(
            large.points[large.triangles][:, :, :2], np.zeros(len(large.triangles), dtype=np.int32), progress=progress
        ),
        "shortest_cycle": lambda progress: sw.shortest_cycle(large, large_metric, large.edges[0], progress=progress),
    }[request.param]


def test_progress_is_a_fraction(work: Work) -> None:
    fractions: list[float] = []
    work(fractions.append)
    assert fractions
    assert all(0 <= f <= 1 for f in fractions)


def test_returning_false_cancels(work: Work) -> None:
    with pytest.raises(sw.Cancelled):
        work(lambda _: False)
    assert issubclass(sw.Cancelled, RuntimeError)
    assert work(lambda _: None) is not None  # and it can be done again


def test_what_the_callback_raises_comes_out(work: Work) -> None:
    class OwnError(Exception):
        pass

    def fail(fraction: float) -> None:
        raise OwnError(fraction)

    with pytest.raises(OwnError) as caught:
        work(fail)
    assert 0 <= caught.value.args[0] <= 1
    with pytest.raises(TypeError):
        work(lambda: None)  # takes no argument


@pytest.fixture
def heeds_control_c() -> Iterator[None]:
    """Listen to Ctrl-C; a shell lets what it runs in the background ignore it, and Python then does so too."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def interrupt_after(seconds: float) -> threading.Timer:
    timer = threading.Timer(seconds, signal.raise_signal, (signal.SIGINT,))
    timer.start()
    return timer


@pytest.mark.usefixtures("heeds_control_c")
def test_control_c_stops_long_work(embedding_of_large: sw.Embedding) -> None:
    timer = interrupt_after(0.03)
    try:
        with pytest.raises(KeyboardInterrupt):
            for seed in range(1000):
                sw.distance_field(embedding_of_large, seed)
    finally:
        timer.join()


def test_what_is_kept_can_be_given_up_and_made_again(large: sw.Surface) -> None:
    curvature = sw.principal_curvatures(large)
    metric = sw.euclidean_metric(large, curvature)
    embedding = sw.embed(large, metric, max_error=0)
    asked: list[float] = []

    def go_on(fraction: float) -> bool:
        asked.append(fraction)
        return False

    with pytest.raises(sw.Cancelled):
        sw.distance_field(embedding, 0, max_distance=0.0, progress=go_on)
    with pytest.raises(sw.Cancelled):
        sw.edge_wires(large, metric, 0, progress=go_on)
    assert asked == [0.0, 0.0], "before the first thing that counts as done"
    assert sw.distance_field(embedding, 0).distances[0] == 0.0
    assert len(sw.edge_wires(large, metric, 0).trace(9).vertices) > 1


def test_progress_may_ask_for_what_is_being_built(large: sw.Surface) -> None:
    metric = sw.feature_metric(large, sw.principal_curvatures(large))
    embedding = sw.embed(large, metric, max_error=0)
    inner: list[object] = []

    def ask(_: float) -> None:
        if not inner:
            inner.append(None)
            inner.append(sw.edge_wires(large, metric, 0).trace(900).vertices)
            inner.append(sw.distance_field(embedding, 0).distances)

    chain = sw.edge_wires(large, metric, 0, progress=ask).trace(900)
    np.testing.assert_array_equal(chain.vertices, inner[1])
    inner.clear()
    embedding = sw.embed(large, metric, max_error=0)
    field = sw.distance_field(embedding, 0, progress=ask)
    np.testing.assert_array_equal(field.distances, inner[2])


def test_who_waits_for_what_another_thread_builds_can_give_up(large: sw.Surface) -> None:
    metric = sw.feature_metric(large, sw.principal_curvatures(large))
    embedding = sw.embed(large, metric, max_error=0)
    for build in (
        lambda p: sw.edge_wires(large, metric, 0, progress=p),
        lambda p: sw.distance_field(embedding, 0, progress=p),
    ):
        begun, may_go_on = threading.Event(), threading.Event()

        def hold(_: float) -> None:
            begun.set()  # noqa: B023
            assert may_go_on.wait(60)  # noqa: B023

        with ThreadPoolExecutor(1) as pool:
            other = pool.submit(build, hold)
            assert begun.wait(60)
            try:
                with pytest.raises(sw.Cancelled):
                    build(lambda _: False)
            finally:
                may_go_on.set()
            assert other.result() is not None


@pytest.mark.usefixtures("heeds_control_c")
def test_control_c_ends_waiting(large: sw.Surface) -> None:
    live = sw.LiveWire(large)
    timer = interrupt_after(0.02)
    try:
        with pytest.raises(KeyboardInterrupt):
            for seed in range(1000):
                live.seed(seed)
                live.wait()
    finally:
        timer.join()


def test_what_is_kept_is_made_once_for_all_threads(surface: sw.Surface, curvature: sw.Curvature) -> None:
    for _ in range(5):
        metric = sw.feature_metric(surface, curvature)
        embedding = sw.embed(surface, metric, max_error=0)
        fresh = sw.Surface(surface.points, surface.triangles)

        def run(seed: int) -> tuple:
            field = sw.distance_field(embedding, seed)  # noqa: B023
            chain = sw.edge_wires(surface, metric, seed).trace(900)  # noqa: B023
            return field.distances, chain.vertices, sw.snap_to_edges(fresh, field.trace(900)), embedding.edges  # noqa: B023

        with ThreadPoolExecutor(8) as pool:
            results = list(pool.map(run, [5] * 16))
        for result in results[1:]:
            for one, other in zip(result, results[0], strict=True):
                np.testing.assert_array_equal(one, other)


def test_a_metric_may_serve_surfaces_of_the_same_size() -> None:
    """The graph kept with a metric belongs to one surface; another surface gets its own."""
    points, triangles = meshes.grid(6)
    one, other = sw.Surface(points, triangles), sw.Surface(points * [1, 2, 1], triangles)
    metric = sw.euclidean_metric(one, sw.principal_curvatures(one))
    lengths = [sw.edge_wires(s, metric, 0, turning=0).trace(6).length for s in (one, other, one)]
    assert lengths == pytest.approx([1, 1, 1])
