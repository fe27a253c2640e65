# SPDX-License-Identifier: GPL-3.0-or-later
"""The package, installed, updated and removed from a remote repository, as users have it who added the repository's address."""

import functools
import http.server
import json
import os
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from blender import Blender, printed
from test_package import LATER, MARK, MARKED, VERSION, later_version, without_traceback

TRIED = {"bpy-4.2", "bpy-5.0", "5.2"}

INDEX = """
from bl_pkg.cli import blender_ext
print("faults:", blender_ext.main(["server-generate", "--repo-dir", {!r}]))
"""

REPOSITORY = """
import bpy
ADDON = "bl_ext.seamwire_repository.seamwire"
bpy.context.preferences.system.use_online_access = True
repos = bpy.context.preferences.extensions.repos
if "seamwire_repository" not in [repo.module for repo in repos]:
    repos.new(name="Seamwire", module="seamwire_repository", remote_url={url!r})
number = [repo.module for repo in repos].index("seamwire_repository")
bpy.ops.extensions.repo_sync(repo_index=number)
"""
"""Adds the repository to a Blender that does not read the settings, and asks it what there is."""


class Quiet(http.server.SimpleHTTPRequestHandler):
    """Serves a folder without a word."""

    def log_message(self, *_: object) -> None:
        """Say nothing."""


class Repository:
    """A repository for extensions in a folder, served on loopback.

    Parameters
    ----------
    folder
        Its packages.
    blender
        The Blender that makes the index, and that uses the repository.
    url
        The address of the index.
    """

    def __init__(self, folder: Path, blender: Blender, url: str) -> None:
        self.folder, self.blender, self.url = folder, blender, url

    def make_index(self) -> None:
        """Let Blender make the static index of all packages in the folder."""
        if self.blender.is_python_module:
            assert printed(self.blender.run(INDEX.format(str(self.folder)), as_set_up=False), "faults") == ["0"]
        else:
            self.blender.start("--command", "extension", "server-generate", f"--repo-dir={self.folder}")

    def add(self) -> None:
        """Add the address to the user's repositories."""
        if not self.blender.is_python_module:
            self.blender.start(
                "--command", "extension", "repo-add", "--name=Seamwire", f"--url={self.url}", "seamwire_repository"
            )

    def act(self, command: tuple[str, ...], code: str) -> None:
        """Do something with it: a command, or code for a Blender without commands."""
        if self.blender.is_python_module:
            without_traceback(self.blender.run(REPOSITORY.format(url=self.url) + code, as_set_up=False))
        else:
            without_traceback(self.blender.start("--online-mode", "--command", "extension", *command))

    def install(self) -> None:
        """Install the newest version and enable it."""
        self.act(
            ("install", "--sync", "--enable", "seamwire"),
            "bpy.ops.extensions.package_install(repo_index=number, pkg_id='seamwire', enable_on_install=True)\n",
        )

    def update(self) -> None:
        """Get newer versions of all that is installed."""
        self.act(("update", "--sync"), "bpy.ops.extensions.package_upgrade_all()\n")

    def remove(self) -> None:
        """Uninstall it."""
        self.act(
            ("remove", "seamwire_repository.seamwire"),
            "bpy.ops.extensions.package_uninstall(repo_index=number, pkg_id='seamwire')\n",
        )

    def run(self, code: str) -> str:
        """Run code with the installed add-on enabled."""
        if not self.blender.is_python_module:
            return without_traceback(self.blender.run('ADDON = "bl_ext.seamwire_repository.seamwire"\n' + code))
        enable = "import addon_utils\nassert addon_utils.enable(ADDON, default_set=True) is not None\n"
        return without_traceback(self.blender.run(REPOSITORY.format(url=self.url) + enable + code, as_set_up=False))

    @property
    def installed(self) -> Path:
        """Where the package's files go."""
        return self.blender.user / "extensions/seamwire_repository/seamwire"


@pytest.fixture
def repository(blender: Blender, tmp_path: Path) -> Iterator[Repository]:
    """A repository without packages."""
    if os.environ["SEAMWIRE_BLENDER_NAME"] not in TRIED:
        pytest.skip("tried in the oldest and newest Blenders with repositories alone, which saves a minute in each")
    folder = tmp_path / "repository"
    folder.mkdir()
    handler = functools.partial(Quiet, directory=str(folder))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield Repository(folder, blender, f"http://127.0.0.1:{server.server_port}/index.json")
        server.shutdown()


def test_it_is_installed_updated_and_removed(repository: Repository, package: Path, tmp_path: Path) -> None:
    (repository.folder / package.name).write_bytes(package.read_bytes())
    repository.make_index()
    (entry,) = json.loads((repository.folder / "index.json").read_text())["data"]
    assert (entry["id"], entry["archive_url"]) == ("seamwire", f"./{package.name}")

    repository.add()
    repository.install()
    output = repository.run(MARK + VERSION)
    assert printed(output, "marked") == [MARKED]
    assert printed(output, "label") != ["Mark Later"]

    (repository.folder / package.name).unlink()
    later = later_version(package, tmp_path)
    (repository.folder / later.name).write_bytes(later.read_bytes())
    repository.make_index()
    repository.update()
    output = repository.run(MARK + VERSION)
    assert printed(output, "marked") == [MARKED]
    assert printed(output, "label") == ["Mark Later"]
    assert f'version = "{LATER}"' in (repository.installed / "blender_manifest.toml").read_text()

    repository.remove()
    assert not repository.installed.exists()
