# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the reference of the Python module for the documentation site: python scripts/lib/python_reference.py FOLDER.

pdoc takes signatures from the stub file, and texts too. The stub has one sentence for each function, so texts are taken from the module.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pdoc
from pdoc import doc, doc_pyi

_take_from_stub = doc_pyi._patch_doc


def without_signature(text: str) -> str:
    """Return a docstring without the signature that pybind11 writes above it."""
    return re.sub(r"\A\w+\([^\n]*\) -> [^\n]*\n\n", "", text)


def _take_types(target: doc.Doc, stub: doc.Module) -> None:
    text = without_signature(target.docstring)
    _take_from_stub(target, stub)
    if text:
        target.docstring = text


if __name__ == "__main__":
    doc_pyi._patch_doc = _take_types
    pdoc.render.configure(docformat="numpy")
    pdoc.pdoc("seamwire_core", output_directory=Path(sys.argv[1]))
