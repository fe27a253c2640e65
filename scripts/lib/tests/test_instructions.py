# SPDX-License-Identifier: GPL-3.0-or-later
"""What the search for instructions of newer processors finds, in what the system's compiler makes."""

from __future__ import annotations

import platform
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))

import instructions

pytestmark = [
    pytest.mark.skipif(platform.machine() != "x86_64", reason="the compiler makes no x86-64 code"),
    pytest.mark.skipif(
        shutil.which("llvm-objdump") is None, reason="llvm is not installed: scripts/setup full installs it"
    ),
]

AVX2 = '__attribute__((target("avx2"))) double sum(const double* of) { return (of[0] + of[1]) * (of[2] + of[3]); }\n'


def compiled(folder: Path, name: str, code: str) -> Path:
    path = folder / f"{name}.o"
    subprocess.run(["g++", "-O2", "-fPIC", "-x", "c++", "-c", "-", "-o", str(path)], input=code, text=True, check=True)
    return path


def linked(folder: Path, objects: list[Path]) -> Path:
    path = folder / "module.so"
    subprocess.run(["g++", "-shared", "-s", "-o", str(path), *map(str, objects)], check=True)
    return path


def test_dispatched_functions_may_have_them(tmp_path: Path) -> None:
    objects = [
        compiled(tmp_path, "kernels", f"namespace avx2 {{ {AVX2} }}"),
        compiled(tmp_path, "plain", "double twice(double x) { return 2 * x; }"),
    ]
    assert instructions.count_newer(objects[0])
    assert not instructions.count_newer(objects[1])
    assert instructions.faults_of_instructions([linked(tmp_path, objects)], objects) == []


def test_other_functions_may_not(tmp_path: Path) -> None:
    objects = [compiled(tmp_path, "other", AVX2)]
    (fault,) = instructions.faults_of_instructions([linked(tmp_path, objects)], objects)
    assert fault.startswith("other.o: _Z3sumPKd has ")


def test_what_comes_from_elsewhere_is_found(tmp_path: Path) -> None:
    library = compiled(tmp_path, "library", AVX2)
    (fault,) = instructions.faults_of_instructions([linked(tmp_path, [library])], [])
    assert fault.endswith("come from none of its objects")
