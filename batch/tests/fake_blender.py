# SPDX-License-Identifier: GPL-3.0-or-later
"""Stands for Blender: does to itself what the asset's content says, and else writes a copy as the result. Notes each call beside itself."""

import ctypes
import json
import os
import sys
import time
from pathlib import Path

job = json.loads(Path(sys.argv[-1]).read_text())
folder = Path(job["folder"])
if job["kind"] == "sheet":
    (folder / "sheet.png").write_bytes(b"".join(Path(path).read_bytes() for path in job["pictures"]))
    result = {"error": None, "warnings": []}
elif job["kind"] == "source":
    (folder / "source-0.json").write_text("{}")
    result = {"error": None, "warnings": [], "sources": {"Shirt": "source-0"}}
else:
    asset = Path(job["asset"])
    with Path(__file__).with_name("calls.txt").open("a", errors="backslashreplace") as calls:
        calls.write(f"{job['name']}\n")
    content = asset.read_text() if asset.is_file() else "fail"
    (folder / job["output"]).write_text("half")
    if content == "crash":
        ctypes.string_at(0)
    if content == "exit":
        sys.exit(3)
    if content == "hang":
        child = os.fork()
        Path(__file__).with_name("pids.txt").write_text(f"{os.getpid()} {child}")
        time.sleep(600)
    if content == "memory":
        print("MemoryError")
        sys.exit(1)
    if content == "slow":
        time.sleep(0.5)
    (folder / job["output"]).write_text(content.upper())
    (folder / f"{job['name']}.png").write_bytes(b"P")
    numbers = {"objects": 1, "faces": 6, "seams": 7, "islands": 1, "angle": 1.1, "area": 1.2, "worst": 1.3}
    errors = {"fail": "It is no good", "need": "Grid: Python: Traceback\nMemoryError: bad allocation"}
    result = {"error": errors.get(content), "warnings": ["a|b"], "megabytes": 9.0, **numbers}
(folder / "result.part").write_text(json.dumps(result))
(folder / "result.part").rename(folder / "result.json")
