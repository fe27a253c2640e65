# SPDX-License-Identifier: GPL-3.0-or-later
"""Packs all add-ons, the tool with wheels of its compiled part: ``pack_addon.py --platform PLATFORM --output FOLDER WHEEL...``.

Makes FOLDER/seamwire-VERSION-PLATFORM.zip, and FOLDER/NAME-VERSION.zip of the other add-ons, each with one folder at its top. So they
install as extensions in Blender 4.2 and later, and as add-ons in Blender 3.4 and later. There the tool unpacks the wheel that fits by
itself.
"""

import argparse
import re
import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).parents[2]
ADDON = ROOT / "addon" / "seamwire"
OTHERS = (ROOT / "addon" / "seamwire_lab", ROOT / "addon" / "seamwire_networks")
"""The add-ons without a compiled part."""
LEFT_OUT = {"__pycache__", "_native", "blender_manifest.toml"}


def manifest(wheels: list[Path], platforms: list[str]) -> str:
    """Return the add-on's manifest with what this package holds and where it runs."""
    text = (ADDON / "blender_manifest.toml").read_text("utf-8")
    lines = ["", "platforms = [", *(f'  "{platform}",' for platform in platforms), "]"]
    lines += ["wheels = [", *(f'  "./wheels/{wheel.name}",' for wheel in wheels), "]"]
    return text.rstrip("\n") + "\n" + "\n".join(lines) + "\n"


def versions() -> dict[str, str]:
    """Return the version as each file that has to tell it does."""
    found = {
        **{
            file: re.search(r'^version = "(.+)"$', (ROOT / file).read_text("utf-8"), re.M)
            for file in ("pyproject.toml", "batch/pyproject.toml")
        },
        "CMakeLists.txt": re.search(
            r"^project\(seamwire VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text("utf-8"), re.M
        ),
    }
    for folder in (ADDON, *OTHERS):
        manifest, code = ((folder / name).read_text("utf-8") for name in ("blender_manifest.toml", "__init__.py"))
        found[f"{folder.name}/blender_manifest.toml"] = re.search(r'^version = "(.+)"$', manifest, re.M)
        found[f"{folder.name}/__init__.py"] = re.search(r'"version": \((\d+), (\d+), (\d+)\)', code)
    missing = [name for name, match in found.items() if match is None]
    if missing:
        sys.exit(f"no version found in {', '.join(missing)}")
    return {name: ".".join(match.groups()) for name, match in found.items()}


def one_version() -> str:
    """Return the version, which must be the same in all files."""
    told = versions()
    if len(set(told.values())) != 1:
        sys.exit("the versions differ: " + ", ".join(f"{name} {version}" for name, version in told.items()))
    return told["pyproject.toml"]


def add_folder(archive: zipfile.ZipFile, folder: Path) -> None:
    """Write the files of an add-on, and the license."""
    # Blender 3.4 removes the version before only if the folder has a separate entry.
    archive.writestr(f"{folder.name}/", b"")
    for file in sorted(folder.rglob("*")):
        inside = file.relative_to(folder.parent)
        if file.is_file() and not LEFT_OUT & set(inside.parts):
            archive.write(file, inside)
    archive.write(ROOT / "LICENSE", f"{folder.name}/LICENSE")


def pack_other(output: Path, folder: Path) -> Path:
    """Write the package of an add-on for all systems and return its path."""
    path = output / f"{folder.name}-{one_version()}.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        add_folder(archive, folder)
        archive.write(folder / "blender_manifest.toml", f"{folder.name}/blender_manifest.toml")
    return path


def pack(output: Path, wheels: list[Path], platforms: list[str]) -> Path:
    """Write the tool's package and return its path."""
    version = one_version()
    others = [wheel.name for wheel in wheels if wheel.name.split("-")[:2] != ["seamwire_core", version]]
    if others:
        sys.exit(f"not wheels of seamwire_core {version}: {', '.join(others)}")
    # No supported Blender has Python 3.12.
    wheels = [wheel for wheel in wheels if "-cp312-" not in wheel.name]
    path = output / f"seamwire-{version}-{'-'.join(platforms)}.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        add_folder(archive, ADDON)
        archive.writestr("seamwire/blender_manifest.toml", manifest(wheels, platforms))
        archive.write(ROOT / "THIRD-PARTY.md", "seamwire/THIRD-PARTY.md")
        for page in sorted((ROOT / "docs" / "guide").glob("*.md")):
            archive.write(page, f"seamwire/guide/{page.name}")
        for wheel in wheels:
            archive.write(wheel, f"seamwire/wheels/{wheel.name}", zipfile.ZIP_STORED)
    return path


def main() -> None:
    """Pack what the command line names."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--platform", action="append", required=True, help="as Blender names it: linux-x64, windows-x64, ..."
    )
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("wheels", nargs="+", type=Path, help="the wheels, or a folder of them")
    arguments = parser.parse_args()
    wheels = [wheel for path in arguments.wheels for wheel in (path.glob("*.whl") if path.is_dir() else [path])]
    if not wheels:
        sys.exit("no wheel to pack")
    print(pack(arguments.output, sorted(wheels), arguments.platform))
    for folder in OTHERS:
        print(pack_other(arguments.output, folder))


if __name__ == "__main__":
    main()
