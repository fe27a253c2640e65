# SPDX-License-Identifier: GPL-3.0-or-later
"""The same work on a Dask cluster, whose workers are killed in the middle."""

from __future__ import annotations

import os
import signal
import threading
import time
from pathlib import Path

import pytest
from place import Place
from seamwire_batch.jobs import Journal

distributed = pytest.importorskip("distributed")


def test_assets_are_done_though_workers_are_killed(tmp_path: Path) -> None:
    contents = {f"{number:02}.obj": "slow" for number in range(10)}
    place = Place(tmp_path, {**contents, "crash.obj": "crash", "fail.obj": "fail"})
    killed: list[int] = []
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, protocol="tcp"
        ) as cluster,
        distributed.Client(cluster) as client,
    ):

        def kill() -> None:
            while len(Journal(place.out).read()) < 2:
                time.sleep(0.02)
            killed.extend(client.run(os.getpid).values())
            os.kill(killed[0], signal.SIGKILL)

        killer = threading.Thread(target=kill)
        killer.start()
        code = place.run("--engine", "dask", "--scheduler", cluster.scheduler_address)
        killer.join()
        assert killed[0] not in client.run(os.getpid).values(), "there is another one in its place"
    assert code == 1
    ends = {name: row["status"] for name, row in place.rows().items()}
    assert ends == {**dict.fromkeys(contents, "done"), "crash.obj": "crashed", "fail.obj": "failed"}
    assert all((place.out / name).read_text() == "SLOW" for name in contents)
    assert len(place.calls()) >= len(ends), "what the killed one was at was done again"
    assert not (place.out / ".parts").exists()


def test_a_scheduler_that_is_not_there_is_said(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    place = Place(tmp_path, {"a.obj": "a"})
    assert place.run("--engine", "dask", "--scheduler", "nonsense://nowhere") == 2
    assert "--scheduler nonsense://nowhere" in capsys.readouterr().err
    assert not place.out.exists()
