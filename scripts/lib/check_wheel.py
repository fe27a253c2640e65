# SPDX-License-Identifier: GPL-3.0-or-later
"""Knows how wheels and modules are called, and looks whether a wheel holds what its name says.

``check_wheel.py check PLATFORM PYTHON WHEEL``, ``check_wheel.py tag PLATFORM`` (of a wheel), ``check_wheel.py suffix PLATFORM PYTHON`` (of
the module). PLATFORM is as Blender names it, PYTHON such as 3.11. Name, tags in the wheel and the compiled module must agree, and the
module may ask for nothing but the system and that Python. Into the modules of wheels for Linux on x86-64 auditwheel has looked before; it
knows the processor alone that it runs on.
"""

import re
import sys
import tempfile
import zipfile
from pathlib import Path

from binaries import read_macho, read_portable
from elftools.elf.elffile import ELFFile

TAGS = {
    "linux-x64": "manylinux_2_28_x86_64",
    "linux-arm64": "manylinux_2_28_aarch64",
    "windows-x64": "win_amd64",
    "macos-x64": "macosx_11_0_x86_64",
    "macos-arm64": "macosx_11_0_arm64",
}
SUFFIXES = {
    "linux-x64": ".cpython-{0}-x86_64-linux-gnu.so",
    "linux-arm64": ".cpython-{0}-aarch64-linux-gnu.so",
    "windows-x64": ".cp{0}-win_amd64.pyd",
    "macos-x64": ".cpython-{0}-darwin.so",
    "macos-arm64": ".cpython-{0}-darwin.so",
}
PYTHON_SYMBOL = re.compile(r"__?Py")
WINDOWS_SYSTEM = re.compile(r"(api-ms-win-[a-z0-9-]+|kernel32|ntdll|advapi32|user32|shell32|ole32|bcrypt)\.dll", re.I)
LINUX_SYSTEM = re.compile(r"(ld-linux-aarch64|lib(c|m|dl|rt|pthread))\.so\.\d")


def faults_of_elf(module: Path, machine: str, newest: tuple[int, int]) -> list[str]:
    """Return a sentence for each feature that is missing on Linux with that processor and glibc."""
    with module.open("rb") as file:
        elf = ELFFile(file)
        found = elf["e_machine"]
        needed = [tag.needed for tag in elf.get_section_by_name(".dynamic").iter_tags("DT_NEEDED")]
        versions = elf.get_section_by_name(".gnu.version_r")
        asked = {version.name for _, of in versions.iter_versions() for version in of} if versions else set()
    faults = [] if found == machine else [f"it is for {found}"]
    faults += [f"it links {name}" for name in needed if not LINUX_SYSTEM.fullmatch(name)]
    for name in sorted(asked):
        match = re.fullmatch(r"GLIBC_(\d+)\.(\d+)(\.\d+)?", name)
        if match is None or (int(match[1]), int(match[2])) > newest:
            faults.append(f"it asks for {name}")
    return faults


def faults_of_module(module: Path, platform: str, python: str) -> list[str]:
    """Return a sentence for each library that the module asks for and that is not there by itself."""
    if platform == "windows-x64":
        asked = read_portable(module).imports
        own = f"python{python.replace('.', '')}.dll"
        faults = [f"it links {name}" for name in asked if not WINDOWS_SYSTEM.fullmatch(name) and name.lower() != own]
        return faults if own in map(str.lower, asked) else [*faults, f"it does not link {own}"]
    if platform.startswith("macos-"):
        found = read_macho(module)
        faults = [f"it links {name}" for name in found.libraries if name != "/usr/lib/libSystem.B.dylib"]
        machine = TAGS[platform].removeprefix("macosx_11_0_")
        if (found.machine, found.oldest_system) != (machine, "11.0"):
            faults.append(f"it is for {found.machine}, macOS {found.oldest_system}")
        faults += [f"nothing has {name}" for name in found.looked_up if not PYTHON_SYMBOL.match(name)]
        # That processor runs nothing that is not signed, if by nobody.
        return faults if machine != "arm64" or found.is_signed else [*faults, "it is not signed"]
    if platform == "linux-arm64":
        return faults_of_elf(module, "EM_AARCH64", (2, 28))
    return []


def faults_of_wheel(wheel: Path, platform: str, python: str) -> list[str]:
    """Return a sentence for each thing that is not as it must be."""
    version = python.replace(".", "")
    tag = f"cp{version}-cp{version}-{TAGS[platform]}"
    module = f"seamwire_core{SUFFIXES[platform].format(version)}"
    faults = [] if wheel.name.endswith(f"-{tag}.whl") else [f"its name does not end with {tag}"]
    with zipfile.ZipFile(wheel) as archive, tempfile.TemporaryDirectory() as folder:
        (metadata,) = (name for name in archive.namelist() if name.endswith(".dist-info/WHEEL"))
        tags = re.findall(r"^Tag: (\S+)", archive.read(metadata).decode(), re.M)
        if tag not in tags or len(tags) != 1:
            faults.append(f"its tags are {', '.join(tags)}")
        missing = {module, "seamwire_core-stubs/__init__.pyi"}.difference(archive.namelist())
        if missing:
            return [*faults, *(f"{name} is not in it" for name in sorted(missing))]
        return faults + faults_of_module(Path(archive.extract(module, folder)), platform, python)


def main() -> None:
    """Do what the command line says."""
    action, platform, *rest = sys.argv[1:]
    if action == "tag":
        print(TAGS[platform])
        return
    python = rest[0]
    if action == "suffix":
        print(SUFFIXES[platform].format(python.replace(".", "")))
        return
    wheel = rest[1]
    faults = faults_of_wheel(Path(wheel), platform, python)
    if faults:
        sys.exit("".join(f"{Path(wheel).name}: {fault}\n" for fault in faults))


if __name__ == "__main__":
    main()
