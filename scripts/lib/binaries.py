# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads what a compiled module asks of its system: Windows' PE files and macOS's Mach-O files, both 64 bit."""

import struct
from pathlib import Path
from typing import NamedTuple


class Portable(NamedTuple):
    """The names in a Windows DLL or program: the DLLs it imports, and its own functions and data."""

    imports: list[str]
    exports: list[str]


class MachO(NamedTuple):
    """The data of a macOS library: the processor, the libraries it loads, the oldest system it runs on, and whether it is signed.

    ``looked_up`` are the symbols that it names no library for: they have to be in the program that loads it.
    """

    machine: str
    libraries: list[str]
    oldest_system: str
    looked_up: list[str]
    is_signed: bool


def read_portable(path: Path) -> Portable:
    """Return the import and export tables of a PE file (PE Format, "The .idata Section", "The .edata Section").

    Raises
    ------
    ValueError
        If the file is not for x86-64.
    """
    data = path.read_bytes()
    (header,) = struct.unpack_from("<I", data, 0x3C) if data[:2] == b"MZ" else (0,)
    signature, machine, sections, options_size = struct.unpack_from("<4sHH12xH", data, header)
    options = header + 24
    if signature != b"PE\0\0" or machine != 0x8664 or struct.unpack_from("<H", data, options) != (0x20B,):
        raise ValueError(f"{path.name} is no PE file for x86-64")
    tables = [struct.unpack_from("<II", data, options + 112 + 8 * table) for table in (0, 1)]
    spans = [struct.unpack_from("<4I", data, options + options_size + 40 * index + 8) for index in range(sections)]

    def place(address: int) -> int:
        for size, start, stored, offset in spans:
            if start <= address < start + max(size, stored):
                return offset + address - start
        raise ValueError(f"{path.name}: nothing is at {address:#x}")

    def text(address: int) -> str:
        start = place(address)
        return data[start : data.index(b"\0", start)].decode()

    (exported, _), (imported, _) = tables
    imports, exports = [], []
    if imported:
        entry = place(imported)
        while name := struct.unpack_from("<12xI", data, entry)[0]:
            imports.append(text(name))
            entry += 20
    if exported:
        count, names = struct.unpack_from("<24xI4xI", data, place(exported))
        exports = [text(name) for name in struct.unpack_from(f"<{count}I", data, place(names))] if count else []
    return Portable(imports, exports)


def read_macho(path: Path) -> MachO:
    """Return what the load commands and the symbols of a Mach-O file tell (<mach-o/loader.h>, <mach-o/nlist.h>).

    Raises
    ------
    ValueError
        If the file is not for one 64-bit processor.
    """
    data = path.read_bytes()
    magic, processor, _, _, commands = struct.unpack_from("<5I", data)
    machines = {0x01000007: "x86_64", 0x0100000C: "arm64"}
    if magic != 0xFEEDFACF or processor not in machines:
        raise ValueError(f"{path.name} is no Mach-O file for x86-64 or arm64")
    libraries, looked_up, oldest, is_signed, at = [], [], "", False, 32
    for _ in range(commands):
        command, size = struct.unpack_from("<II", data, at)
        # LC_LOAD_DYLIB, LC_LOAD_WEAK_DYLIB, LC_REEXPORT_DYLIB
        if command in (0xC, 0x80000018, 0x8000001F):
            start = at + struct.unpack_from("<8xI", data, at)[0]
            libraries.append(data[start : at + size].split(b"\0", 1)[0].decode())
        elif command in (0x24, 0x32):  # LC_VERSION_MIN_MACOSX, LC_BUILD_VERSION
            (version,) = struct.unpack_from("<8xI" if command == 0x24 else "<12xI", data, at)
            oldest = f"{version >> 16}.{version >> 8 & 0xFF}"
        elif command == 0x2:  # LC_SYMTAB
            symbols, count, names, _ = struct.unpack_from("<8x4I", data, at)
            for name, kind, told in struct.iter_unpack("<IBxH8x", data[symbols : symbols + 16 * count]):
                # External, undefined (N_EXT, N_UNDF), from DYNAMIC_LOOKUP_ORDINAL, for which Zig's linker writes 0 here.
                if kind == 0x1 and told >> 8 in (0xFE, 0):
                    looked_up.append(data[names + name : data.index(b"\0", names + name)].decode())
        elif command == 0x1D:  # LC_CODE_SIGNATURE
            is_signed = True
        at += size
    return MachO(machines[processor], libraries, oldest, looked_up, is_signed)
