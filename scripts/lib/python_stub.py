# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the stub of the Python module: python scripts/lib/python_stub.py >native/python/seamwire_core.pyi.

Names, parameters, defaults and texts are those of the module. Types are those in its docstrings: "(n, 3) float64", "int or None",
"list of (int, int)", "{'min', 'max'}, optional".
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from textwrap import indent

import seamwire_core

HEAD = '''\
# SPDX-License-Identifier: GPL-3.0-or-later
# Made by scripts/lib/python_stub.py.
"""{}
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from os import PathLike
from typing import Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str
'''
CONTAINERS = {"list": "list[{}]", "tuple": "tuple[{}, ...]", "sequence": "Sequence[{}]", "iterable": "Iterable[{}]"}
NAMES = {
    **{name: f"NDArray[np.{name}]" for name in ("float64", "int32", "uint8", "bool_")},
    "path-like": "PathLike[str]",
    "callable": "Callable[[float], bool | None]",
}


def split(text: str, separator: str) -> tuple[str, str]:
    """Return the text before and after the first separator that is not in parentheses or braces."""
    for match in re.finditer(separator, text):
        before = text[: match.start()]
        if all(before.count(opened) == before.count(closed) for opened, closed in ("()", "{}")):
            return before, text[match.end() :]
    return text, ""


def python_type(text: str) -> str:
    """Translate a type in a docstring.

    Raises
    ------
    ValueError
        If it has another form.
    """
    text = re.sub(r"(\([\w +,-]*\) )?array_like( of \w+)?", "ArrayLike", text)  # stubs cannot tell shapes
    text = re.sub(r"\([\w +,-]*\) bool\b", "bool_", text)
    text = re.sub(r"\([\w +,-]*\) (?=float64|int32|uint8)", "", text)
    if container := re.fullmatch(rf"({'|'.join(CONTAINERS)}) of (.+)", text):
        return CONTAINERS[container[1]].format(python_type(container[2]))
    first, others = split(text, ",? or |, ")
    if others:
        return f"{python_type(first)} | {python_type(others)}"
    if text.startswith("{"):
        return f"Literal[{text[1:-1]}]".replace("'", '"')
    if text.startswith("("):
        members, rest = [], text[1:-1]
        while rest:
            member, rest = split(rest, ", ")
            members.append(python_type(member))
        return f"tuple[{', '.join(members)}]"
    if text not in NAMES and not re.fullmatch(r"[A-Za-z]\w*", text):
        raise ValueError(f"no type: {text!r}")
    return NAMES.get(text, text)


def signatures(text: str) -> list[tuple[str, str, str]]:
    """Return parameters, result and docstring of a function, or of each of its overloads, from what pybind11 writes."""
    text = text.partition("Overloaded function.")[2] or text
    parts = re.split(r"(?m)^(?:\d+\. )?\w+\((.*)\) -> (.+)$", text)[1:]
    return list(zip(parts[::3], parts[1::3], parts[2::3], strict=True))


def section(text: str, title: str) -> list[tuple[str, str]]:
    """Return names and type of each entry in a section of a docstring."""
    found = re.search(rf"^{title}\n-+\n((?:.+\n)*)", f"{text}\n", re.MULTILINE)
    lines = found[1].splitlines() if found else []
    return [line.rpartition(" : ")[::2] for line in lines if not line.startswith(" ")]


def parameter_types(text: str, owner: type | None = None) -> dict[str, str]:
    """Return the type of each parameter that a docstring explains, or another one that it refers to."""
    types = parameter_types(owner.__doc__ or "") if owner else {}
    for scope, name in re.findall(r"^    As for (the function )?`(\w+)`", text, re.MULTILINE):
        own = None if scope else getattr(owner, name, None)
        types |= parameter_types((own or getattr(seamwire_core, name)).__doc__)
    for names, kind in section(text, "Parameters"):
        if names:
            types |= dict.fromkeys(names.split(", "), kind)
    return types


def docstring(text: str, margin: str) -> str:
    """Return a text as a docstring."""
    text = text.strip().replace("\\", "\\\\")
    return indent(f'"""{text}\n"""\n' if "\n" in text else f'"""{text}"""\n', margin, str.strip)


def function(name: str, member: object, owner: type | None = None) -> Iterator[str]:
    """Yield the declaration of a function, or of each of its overloads."""
    margin = "    " if owner else ""
    found = signatures(member.__doc__)
    for parameters, result, text in found:
        types = parameter_types(text, owner)
        pieces = []
        for piece in re.split(r", (?=\w+: |\*)", parameters) if parameters else []:
            parameter, default = re.fullmatch(r"(\w+|\*)(?:: .*?)?(?: = (.*))?", piece).groups()
            if parameter in ("self", "*"):
                pieces.append(parameter)
                continue
            kind = "object" if name == "__eq__" else python_type(types[parameter].removesuffix(", optional"))
            pieces.append(f"{parameter}: {kind}" + (" | None" if default == "None" else ""))
            if default:
                pieces[-1] += " = " + default.replace("'", '"')
        returned = [python_type(kind) for _, kind in section(text, "Returns")]
        result = f"tuple[{', '.join(returned)}]" if len(returned) > 1 else (*returned, result)[0]
        line = f"{margin}def {name}({', '.join(pieces)}) -> {result}:"
        if len(line) > 120:
            rows = "".join(f"{margin}    {piece},\n" for piece in pieces)
            line = f"{margin}def {name}(\n{rows}{margin}) -> {result}:"
        if len(found) > 1:
            yield f"{margin}@overload\n"
        yield f"{line}\n{docstring(text, margin + '    ')}" if text.strip() else f"{line} ...\n"


def members(owner: type) -> Iterator[str]:
    """Yield the declarations of a class."""
    if owner.__doc__:
        yield docstring(owner.__doc__, "    ") + "\n"
    types = parameter_types(owner.__doc__ or "")
    for name, member in vars(owner).items():
        if isinstance(member, property):
            kind, explanation = split(member.__doc__ or types[name], r"[:.](?:\s|$)")
            kind = python_type(re.sub(", optional$", " or None", kind))
            yield f"    {name}: {kind}\n" + (docstring(member.__doc__, "    ") if explanation else "")
        elif type(member).__name__ == "instancemethod" and member.__doc__ and name != "__repr__":
            yield from function(name, member, owner)


def stub() -> str:
    """Return the stub."""
    parts = [HEAD.format(seamwire_core.__doc__)]
    for name, thing in vars(seamwire_core).items():
        if name.startswith("_"):
            continue
        if isinstance(thing, type):
            base = "(RuntimeError)" if issubclass(thing, RuntimeError) else ""
            body = "".join(members(thing))
            parts.append(f"class {name}{base}:\n{body}" if body else f"class {name}{base}: ...\n")
        else:
            parts.extend(function(name, thing))
    return "\n".join(parts)


if __name__ == "__main__":
    print(stub(), end="")
