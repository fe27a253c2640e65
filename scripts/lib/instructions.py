# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds what an x86-64 processor with SSE4.2 alone does not understand: ``instructions.py MODULE... -- OBJECT...``.

MODULEs are linked and have no symbols; OBJECTs are what they were linked from. In an object only functions of a namespace ``avx2`` may have
AVX instructions: the library calls them where the processor has AVX2. A module may have no more of these instructions than all objects
together. An object of LLVM's bitcode has no instructions before it is linked, so only the count of the module covers it.
"""

import re
import subprocess
import sys
from pathlib import Path

FUNCTION = re.compile(r"^[0-9a-f]+ <(.+)>:$")
# Every VEX and EVEX instruction begins with a v, or works on general registers (BMI, AVX-512's masks).
NEWER = re.compile(
    r"\t(?!verr|verw)(v[a-z]\w+|andn|bextr|bls[ir]|blsmsk|bzhi|mulx|pdep|pext|rorx|sarx|shlx|shrx|k[a-z]+[bwdq])[lq]?\s"
)
DISPATCHED = re.compile(r"4avx2\d")
BITCODE = b"BC\xc0\xde"


def count_newer(path: Path) -> dict[str, int]:
    """Return how many instructions above SSE4.2 each function has, by its mangled name."""
    found: dict[str, int] = {}
    function = ""
    # LLVM's reads what is built for Windows and macOS as well.
    command = ["llvm-objdump", "-d", "--no-show-raw-insn", str(path)]
    for line in subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines():
        if match := FUNCTION.match(line):
            function = match[1]
        elif NEWER.search(line + " "):
            found[function] = found.get(function, 0) + 1
    return found


def faults_of_instructions(modules: list[Path], objects: list[Path]) -> list[str]:
    """Return a sentence for each function that has instructions above SSE4.2 and must not."""
    compiled = [path for path in objects if not path.read_bytes().startswith(BITCODE)]
    counts = [(path, function, count) for path in compiled for function, count in count_newer(path).items()]
    faults = [
        f"{path.name}: {function} has {count} instructions above SSE4.2"
        for path, function, count in counts
        if not DISPATCHED.search(function)
    ]
    known = sum(count for _, _, count in counts)
    for module in modules:
        there = sum(count_newer(module).values())
        if there > known:
            faults.append(f"{module.name}: {there - known} instructions above SSE4.2 come from none of its objects")
    return faults


if __name__ == "__main__":
    end = sys.argv.index("--")
    linked, compiled_files = ([Path(name) for name in names] for names in (sys.argv[1:end], sys.argv[end + 1 :]))
    sys.exit("\n".join(faults_of_instructions(linked, compiled_files)) or 0)
