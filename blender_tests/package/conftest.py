# SPDX-License-Identifier: GPL-3.0-or-later
"""The packages that were built, and the Blender to try them in.

They are named by SEAMWIRE_PACKAGE, SEAMWIRE_LAB_PACKAGE, SEAMWIRE_NETWORKS_PACKAGE, BLENDER and SEAMWIRE_BLENDER_NAME.
"""

import os
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from blender import Blender

USER = "Анна Müller"
"""The user's folder: many have such letters, and spaces."""


@pytest.fixture(scope="session")
def package() -> Path:
    """The zip that scripts/package made."""
    return Path(os.environ["SEAMWIRE_PACKAGE"])


@pytest.fixture(scope="session")
def other_packages() -> dict[str, Path]:
    """The zips of the other add-ons, by their names."""
    return {f"seamwire_{name}": Path(os.environ[f"SEAMWIRE_{name.upper()}_PACKAGE"]) for name in ("lab", "networks")}


@pytest.fixture
def blender(tmp_path: Path) -> Blender:
    """A Blender that nobody used before."""
    return Blender(Path(os.environ["BLENDER"]), os.environ["SEAMWIRE_BLENDER_NAME"], tmp_path / USER)


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory, package: Path) -> Blender:
    """A Blender with the package installed; tests must leave it so."""
    user = tmp_path_factory.mktemp("installed") / USER
    blender = Blender(Path(os.environ["BLENDER"]), os.environ["SEAMWIRE_BLENDER_NAME"], user)
    blender.install(package)
    return blender
