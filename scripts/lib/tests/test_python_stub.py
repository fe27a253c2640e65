# SPDX-License-Identifier: GPL-3.0-or-later
"""Types in the module's docstrings, as the stub has them."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))

import python_stub


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("float", "float"),
        ("(n, 3) float64", "NDArray[np.float64]"),
        ("(k + 1,) int32 or None", "NDArray[np.int32] | None"),
        ("(k - 1,) array_like of int", "ArrayLike"),
        ("{'min', 'max'}", 'Literal["min", "max"]'),
        ("{0, 1, 2}", "Literal[0, 1, 2]"),
        ("int, (int, int) or (int, (3,) array_like)", "int | tuple[int, int] | tuple[int, ArrayLike]"),
        ("tuple of LiveEmbedding or None", "tuple[LiveEmbedding | None, ...]"),
        ("list of ((int, int), list of int)", "list[tuple[tuple[int, int], list[int]]]"),
        ("list of (int, (s, 2) int32, bool)", "list[tuple[int, NDArray[np.int32], bool]]"),
    ],
)
def test_types_of_docstrings_become_types_of_python(text: str, expected: str) -> None:
    assert python_stub.python_type(text) == expected


@pytest.mark.parametrize("text", ["", "how many there are", "float: the length", "3"])
def test_other_text_is_no_type(text: str) -> None:
    with pytest.raises(ValueError, match="no type"):
        python_stub.python_type(text)
