# SPDX-License-Identifier: GPL-3.0-or-later
"""What wheels are looked through for before they are packed."""

from __future__ import annotations

import platform
import struct
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))

import binaries
import check_wheel

SECTION, STORED = 0x3000, 0x200
"""Where the one section of the test's DLL is in memory, and in the file."""


def wheel(folder: Path, name: str, tag: str, module: bytes) -> Path:
    path = folder / name
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("seamwire_core.cp311-win_amd64.pyd", module)
        archive.writestr("seamwire_core-stubs/__init__.pyi", "")
        archive.writestr("seamwire_core-1.0.dist-info/WHEEL", f"Wheel-Version: 1.0\nTag: {tag}\n")
    return path


def portable(imports: list[str], exports: list[str]) -> bytes:
    """Return a DLL that has nothing but an import and an export table."""
    content = bytearray(20 * (len(imports) + 1) + 40 + 4 * len(exports))

    def add(text: str) -> int:
        content.extend(text.encode() + b"\0")
        return SECTION + len(content) - len(text) - 1

    for index, name in enumerate(imports):
        struct.pack_into("<12xI", content, 20 * index, add(name))
    table = 20 * (len(imports) + 1)
    struct.pack_into("<24xI4xI", content, table, len(exports), SECTION + table + 40)
    for index, name in enumerate(exports):
        struct.pack_into("<I", content, table + 40 + 4 * index, add(name))
    tables = struct.pack("<4I", SECTION + table, 40, SECTION, table)
    options = struct.pack("<H110x", 0x20B) + tables.ljust(128, b"\0")
    section = struct.pack("<8s4I16x", b".rdata", len(content), SECTION, len(content), STORED)
    header = struct.pack("<4sHH12xHH", b"PE\0\0", 0x8664, 1, len(options), 0)
    start = b"MZ".ljust(0x3C, b"\0") + struct.pack("<I", 0x40)
    return (start + header + options + section).ljust(STORED, b"\0") + bytes(content)


def macho(oldest: int, libraries: list[str], looked_up: list[str], signed: bool) -> bytes:
    """Return a library for arm64 that has nothing but load commands and the symbols that it asks for."""
    names = [name.encode().ljust(48, b"\0") for name in libraries]
    commands = [struct.pack("<6I", 0xC, 24 + len(name), 24, 0, 0, 0) + name for name in names]
    commands.append(struct.pack("<6I", 0x32, 24, 1, oldest, oldest, 0))
    if signed:
        commands.append(struct.pack("<4I", 0x1D, 16, 0, 0))
    # The first symbol is in the first of the libraries, the second is its own.
    symbols = [
        ("_malloc", 0x1, 1 << 8),
        ("_own", 0xF, 0),
        *((name, 0x1, 0xFE00 * (i % 2)) for i, name in enumerate(looked_up)),
    ]
    size = sum(map(len, commands)) + 24
    table, texts = b"", b"\0"
    for name, kind, told in symbols:
        table += struct.pack("<IBxH8x", len(texts), kind, told)
        texts += name.encode() + b"\0"
    start = 32 + size
    commands.append(struct.pack("<6I", 0x2, 24, start, len(symbols), start + len(table), len(texts)))
    header = struct.pack("<8I", 0xFEEDFACF, 0x0100000C, 0, 6, len(commands), size, 0, 0)
    return header + b"".join(commands) + table + texts


def test_the_tables_of_a_windows_dll_are_read(tmp_path: Path) -> None:
    path = tmp_path / "python311.dll"
    path.write_bytes(portable(["KERNEL32.dll", "VCRUNTIME140.dll"], ["PyArg_Parse", "Py_Main"]))
    assert binaries.read_portable(path) == (["KERNEL32.dll", "VCRUNTIME140.dll"], ["PyArg_Parse", "Py_Main"])
    path.write_bytes(portable([], []))
    assert binaries.read_portable(path) == ([], [])


@pytest.mark.parametrize("content", [b"\x7fELF" + bytes(100), b"MZ" + bytes(200)])
def test_what_is_no_windows_program_is_refused(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "module.pyd").write_bytes(content)
    with pytest.raises(ValueError, match="no PE file"):
        binaries.read_portable(tmp_path / "module.pyd")


@pytest.mark.parametrize(
    ("imports", "faults"),
    [
        (["KERNEL32.dll", "api-ms-win-crt-heap-l1-1-0.dll", "python311.dll"], []),
        (["libc++.dll", "python311.dll"], ["it links libc++.dll"]),
        (["python313.dll"], ["it links python313.dll", "it does not link python311.dll"]),
    ],
)
def test_a_windows_module_links_its_python_and_the_system_alone(
    tmp_path: Path, imports: list[str], faults: list[str]
) -> None:
    tag = "cp311-cp311-win_amd64"
    path = wheel(tmp_path, f"seamwire_core-1.0-{tag}.whl", tag, portable(imports, ["PyInit_seamwire_core"]))
    assert check_wheel.faults_of_wheel(path, "windows-x64", "3.11") == faults


def test_name_and_tags_have_to_agree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(check_wheel, "faults_of_module", lambda *_: [])
    named = wheel(tmp_path, "seamwire_core-1.0-cp311-cp311-win_amd64.whl", "cp311-cp311-linux_x86_64", b"")
    assert check_wheel.faults_of_wheel(named, "windows-x64", "3.11") == ["its tags are cp311-cp311-linux_x86_64"]
    assert len(check_wheel.faults_of_wheel(named, "windows-x64", "3.13")) == 3, "name, tags, module"


def test_a_wheel_has_types(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(check_wheel, "faults_of_module", lambda *_: [])
    tag = "cp311-cp311-win_amd64"
    path = tmp_path / f"seamwire_core-1.0-{tag}.whl"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("seamwire_core.cp311-win_amd64.pyd", b"")
        archive.writestr("seamwire_core-1.0.dist-info/WHEEL", f"Tag: {tag}\n")
    missing = ["seamwire_core-stubs/__init__.pyi is not in it"]
    assert check_wheel.faults_of_wheel(path, "windows-x64", "3.11") == missing


@pytest.mark.skipif(platform.system() != "Linux", reason="the compiler makes no ELF files")
def test_what_a_linux_module_asks_for_is_read(tmp_path: Path) -> None:
    path = tmp_path / "module.so"
    code = "#include <string>\nstd::string text(int of) { return std::to_string(of) + std::string(99, ' '); }\n"
    subprocess.run(["g++", "-shared", "-fPIC", "-x", "c++", "-", "-o", str(path)], input=code, text=True, check=True)
    faults = check_wheel.faults_of_module(path, "linux-arm64", "3.11")
    assert "it links libstdc++.so.6" in faults
    assert any(fault.startswith("it asks for GLIBCXX_") for fault in faults)
    assert not any("libc.so" in fault for fault in faults)
    assert ("it is for EM_X86_64" in faults) == (platform.machine() == "x86_64")
    plain = "int twice(int x) { return 2 * x; }\n"
    subprocess.run(["gcc", "-shared", "-fPIC", "-x", "c", "-", "-o", str(path)], input=plain, text=True, check=True)
    machine = "EM_X86_64" if platform.machine() == "x86_64" else "EM_AARCH64"
    assert check_wheel.faults_of_elf(path, machine, (2, 28)) == []


SYSTEM = "/usr/lib/libSystem.B.dylib"


@pytest.mark.parametrize(
    ("told", "faults"),
    [
        ({}, []),
        ({"libraries": [SYSTEM, "/usr/lib/libc++.1.dylib"]}, ["it links /usr/lib/libc++.1.dylib"]),
        ({"oldest": 13 << 16}, ["it is for arm64, macOS 13.0"]),
        ({"looked_up": ["_PyErr_Clear", "_tbb_malloc"]}, ["nothing has _tbb_malloc"]),
        ({"signed": False}, ["it is not signed"]),
    ],
)
def test_a_macos_module_asks_for_its_python_and_the_system_alone_and_is_signed(
    tmp_path: Path, told: dict[str, Any], faults: list[str]
) -> None:
    sound = {"oldest": 11 << 16, "libraries": [SYSTEM], "looked_up": ["_PyErr_Clear", "__Py_Dealloc"], "signed": True}
    path = tmp_path / "module.so"
    path.write_bytes(macho(**{**sound, **told}))
    assert check_wheel.faults_of_module(path, "macos-arm64", "3.11") == faults
