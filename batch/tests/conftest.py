# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the package importable; no Blender here."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent))
